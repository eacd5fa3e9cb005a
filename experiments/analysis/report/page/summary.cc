#include "experiments/analysis/report/page/summary.h"

#include <algorithm>
#include <cmath>

#include "base/text/base64.h"
#include "base/text/counted.h"
#include "base/text/joined.h"
#include "base/text/markup.h"
#include "base/text/number_text.h"
#include "experiments/analysis/compare/profile_pictures.h"
#include "experiments/analysis/report/charts/colors.h"
#include "experiments/analysis/report/charts/svg_chart.h"
#include "experiments/analysis/report/page/plain_page.h"
#include "experiments/analysis/report/views/answer_words.h"

namespace talus::analysis {
namespace {

// More would not fit on the sheet; the report has all.
constexpr std::size_t kMostAlarms = 5;
constexpr std::size_t kMostFits = 8;
constexpr std::size_t kMostPairs = 2;      // experiments whose heaps are shown
constexpr std::size_t kMostLetters = 260;  // of an alarm

constexpr const char* kStyle = R"(
@page { size: A4; margin: 11mm; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 188mm; color: #1d2730; background: #fff;
  font: 1em/1.35 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Liberation Sans", sans-serif; }
h1 { margin: 0; font-size: 1.6em; } h2 { margin: 3mm 0 1mm; font-size: 1.1em; }
p { margin: 1mm 0; } ul { margin: 0; padding-left: 4.5mm; }
.soft { color: #55626d; } .bad { color: #a3260f; font-weight: 600; } .good { color: #17663a; font-weight: 600; }
.heaps { display: flex; gap: 4mm; margin: 2mm 0; } .heaps figure { flex: 1; min-width: 0; margin: 0; }
.heaps img { width: 100%; height: 30mm; object-fit: contain; border: .3mm solid #dfe4e8; }
figcaption { font-size: .85em; color: #55626d; }
.two { display: flex; gap: 6mm; } .two > div { flex: 1; min-width: 0; } .two > div:first-child { flex: 1.25; }
td { overflow-wrap: anywhere; } td.good, td.bad, td.open { white-space: nowrap; } .two svg { width: 100%; height: auto; max-height: 62mm; }
table { border-collapse: collapse; width: 100%; } th, td { padding: .6mm 2mm .6mm 0; text-align: left; border-bottom: .2mm solid #dfe4e8; }
.alarms { border: .3mm solid #efcf94; background: #fff4de; padding: 1.5mm 3mm; margin: 2mm 0; }
footer { margin: 3mm 0 0; font-size: .8em; color: #55626d; }
)";

std::string Element(const std::string& tag, const std::string& content,
                    const std::string& attributes = "") {
  return "<" + tag + (attributes.empty() ? "" : " " + attributes) + ">" + content + "</" + tag +
         ">\n";
}

std::string Text(const std::string& tag, const std::string& text,
                 const std::string& attributes = "") {
  return Element(tag, base::MarkupText(text), attributes);
}

std::string Image(const Picture& picture, const std::string& caption) {
  return Element("figure", "<img alt=\"" + base::MarkupText(caption) +
                               "\" src=\"data:image/png;base64," + base::Base64(picture.png) +
                               "\">" + Text("figcaption", caption));
}

// The heap as photographed or as measured on average, and as simulated.
std::string Heaps(const ReportData& data) {
  const std::string name = data.evidence.experiments.at(data.evidence.experiment);
  if (!data.overlay.photographs.empty()) {
    return Image(data.overlay.photographs.front(), name + ", photographed") +
           Image(data.overlay.simulated, name + ", simulated: " + data.overlay.simulated.title);
  }
  if (data.pictures.size() < 2) return "";
  const TrialEvidence* trial = ConfirmingTrial(data.evidence);
  const auto confirming = std::ranges::find_if(data.pictures, [&](const Picture& picture) {
    return trial != nullptr && picture.name == AnhpName(*trial);
  });
  const Picture& simulated = confirming != data.pictures.end() ? *confirming : data.pictures[1];
  return Image(data.pictures.front(), name + ", measured, average profile") +
         Image(simulated, name + ", simulated, average profile");
}

// Measured and simulated heaps of the first experiments that have any.
std::string AllHeaps(const ReportData& data) {
  std::string heaps = Heaps(data);
  std::size_t num_pairs = heaps.empty() ? 0 : 1;
  for (const ReportData& other : data.others) {
    const std::string more = num_pairs < kMostPairs ? Heaps(other) : "";
    heaps += more;
    num_pairs += more.empty() ? 0 : 1;
  }
  return heaps.empty() ? "" : Element("div", heaps, "class=\"heaps\"");
}

// "0.123", "3 × 10⁻⁵"; nothing known: "–".
std::string ShownOrDash(double value) {
  return std::isfinite(value) ? WithPowers(base::ShortNumber(value, 3)) : "–";
}

std::string ParameterTable(const Evidence& evidence) {
  std::string rows =
      "<tr><th>Parameter</th><th>Recommended</th><th>90 % range*</th>"
      "<th>Searched</th></tr>\n";
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    const campaign::ResultParameter& p = evidence.answer->parameters[k];
    const ParameterInfo& info = evidence.parameters[k];
    const std::string unit = info.unit.empty() ? "" : " " + info.unit;
    const std::string name = info.range.name == info.symbol ? "" : " (" + info.range.name + ")";
    const std::string asked = info.range.is_nuisance ? ", not asked for" : "";
    rows += Element(
        "tr", Text("td", info.symbol + name + asked) +
                  Text("td", ShownOrDash(p.value) + unit,
                       asked.empty() ? "style=\"font-weight:650\"" : "") +
                  Text("td", ShownOrDash(p.credible_low) + " to " + ShownOrDash(p.credible_high) +
                                 (p.prior ? " (prior " + p.prior->text + ")" : "")) +
                  Text("td", ShownOrDash(p.searched_low) + " to " + ShownOrDash(p.searched_high)));
  }
  return Element("table", rows) +
         Text("p",
              evidence.all_asked_for()
                  ? "* for all parameters together"
                  : "* for all parameters asked for together; of one not asked for, by itself",
              "class=\"soft\"");
}

// The region over the two parameters that it ties closest, as the page has it.
std::string Region(const ReportData& data) {
  const auto closest = ClosestPair(data);
  if (!closest) return "";
  const PairMap& pair = data.pairs[*closest];
  const auto axis = [&](std::size_t k) {
    const ParameterInfo& p = data.evidence.parameters[k];
    return SvgAxis{.title = p.symbol + (p.unit.empty() ? "" : " (" + p.unit + ")"),
                   .low = p.range.low,
                   .high = p.range.high,
                   .log = p.range.scale == optimizer::Scale::kLog};
  };
  SvgChart chart(axis(pair.i), axis(pair.j));
  const std::size_t columns = pair.x_edges.size() - 1;
  for (std::size_t c = 0; c < pair.value.size(); ++c) {
    if (pair.value[c] >= optimizer::kRegionLevel) continue;
    const std::size_t x = c % columns, y = c / columns;
    chart.Cell({{pair.x_edges[x], pair.y_edges[y]}, {pair.x_edges[x + 1], pair.y_edges[y + 1]}},
               pair.value[c] < 0.5 ? kRegion50 : kRegion90);
  }
  const auto& values = data.evidence.answer->parameters;
  chart.Star({values[pair.i].value, values[pair.j].value}, "recommended");
  return Text("h2", "Joint region: 50 % dark, 90 % light") + chart.Text();
}

std::string Fits(const Evidence& evidence) {
  std::string rows;
  for (std::size_t i = 0; i < std::min(evidence.fit.size(), kMostFits); ++i) {
    const FitRow& row = evidence.fit[i];
    const bool yes = row.meets == campaign::Meets::kYes, no = row.meets == campaign::Meets::kNo;
    const std::string name = row.experiment + ", " + row.what + (row.held_out ? ", held out" : "");
    rows += Element("tr", Text("td", name) +
                              Text("td",
                                   yes  ? "fits"
                                   : no ? "misses"
                                        : "open",
                                   yes  ? "class=\"good\""
                                   : no ? "class=\"bad\""
                                        : "class=\"open\"") +
                              Text("td", row.simulated.empty() ? "not simulated" : row.simulated) +
                              Text("td", row.measured));
  }
  if (rows.empty()) return "";
  if (evidence.fit.size() > kMostFits) {
    rows += Element(
        "tr",
        Text("td", "and " + std::to_string(evidence.fit.size() - kMostFits) + " more on the page",
             "colspan=\"4\""));
  }
  return Text("h2", "How well it fits") +
         Element("table",
                 "<tr><th>Measurement</th><th></th><th>Simulated</th><th>Measured</th>"
                 "</tr>\n" +
                     rows);
}

// As much of a text as the sheet has room for, cut between words.
std::string Shortened(const std::string& text) {
  if (text.size() <= kMostLetters) return text;
  std::string kept = text.substr(0, text.rfind(' ', kMostLetters));
  // No command is cut, for it would be typed.
  if (std::ranges::count(kept, '`') % 2 != 0)
    kept.resize(kept.find_last_not_of(" (", kept.rfind('`') - 1) + 1);
  return kept + " …";
}

std::string Alarms(const Evidence& evidence) {
  const std::vector<std::string> words = AlarmWords(evidence);
  if (words.empty()) return "";
  std::string list;
  for (std::size_t i = 0; i < std::min(words.size(), kMostAlarms); ++i) {
    list += Element("li", WithCode(Shortened(words[i])));
  }
  if (words.size() > kMostAlarms) {
    list += Text("li", std::to_string(words.size() - kMostAlarms) + " more in the report");
  }
  return Element("div", Text("strong", "Before you use it") + Element("ul", list),
                 "class=\"alarms\"");
}

std::string Conditions(const campaign::Answer& answer) {
  std::string list;
  for (const std::string& words : ConditionWords(answer.conditions)) list += Text("li", words);
  return Text("h2", "It holds for") + Element("ul", list);
}

std::string Foot(const ReportData& data) {
  const campaign::Answer& answer = *data.evidence.answer;
  std::string text = base::Counted(answer.cost.num_trials, "simulation") + ", " +
                     ShownOrDash(answer.cost.core_hours) + " core hours";
  for (const campaign::ResultReused& reused : answer.reused) {
    text += ", reused: " + ReusedText(reused);
  }
  for (const NamedText& version : data.evidence.versions) {
    if (version.name == "talus that wrote this report" || version.name == "its commit" ||
        version.name == "written" || version.name == "hash of the spec") {
      text += " · " + version.name + ": " + version.text;
    }
  }
  return Text("footer", text + " · all else: report.html");
}

// Lines of so many letters that a text takes.
double LinesOf(const std::string& text, double letters) {
  return std::ceil(static_cast<double>(text.size()) / letters);
}

// What is long is set smaller, so that the sheet stays one: both lines and letters shrink with it.
double FontSize(const Evidence& evidence) {
  constexpr double kUsual = 9.4;     // [pt]
  constexpr double kSmallest = 6.2;  // [pt]
  constexpr double kRoom = 25;       // lines of the usual size, beside pictures and headings
  double lines = 2.0 * static_cast<double>(evidence.parameters.size()) +
                 2.0 * static_cast<double>(std::min(evidence.fit.size(), kMostFits + 1));
  for (const std::string& sentence : HeadlineWords(evidence)) lines += LinesOf(sentence, 100);
  const std::vector<std::string> alarms = AlarmWords(evidence);
  for (std::size_t i = 0; i < std::min(alarms.size(), kMostAlarms); ++i) {
    lines += LinesOf(Shortened(alarms[i]), 105);
  }
  for (const std::string& words : ConditionWords(evidence.answer->conditions)) {
    lines += LinesOf(words, 52);
  }
  return std::clamp(kUsual * std::sqrt(kRoom / lines), kSmallest, kUsual);
}

}  // namespace

std::string SummaryPage(const ReportData& data) {
  const Evidence& evidence = data.evidence;
  if (!evidence.answer) return "";
  const std::string headline = base::Joined(HeadlineWords(evidence), " ");
  const std::string name = base::MarkupText(evidence.name);
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + name +
         " – summary</title><style>html { font-size: " + base::ShortNumber(FontSize(evidence), 3) +
         "pt; }" + kStyle + "</style></head><body>\n<h1>" + name + "</h1>\n" +
         Text("p", headline, "style=\"font-weight:600\"") + Text("p", UseWords(*evidence.answer)) +
         AllHeaps(data) + Alarms(evidence) + Text("h2", "Calibrated parameters") +
         ParameterTable(evidence) +
         Element("div", Element("div", Conditions(*evidence.answer)) + Element("div", Region(data)),
                 "class=\"two\"") +
         Fits(evidence) + Foot(data) + "</body></html>\n";
}

}  // namespace talus::analysis
