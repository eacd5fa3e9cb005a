#include "experiments/analysis/search/search_page.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/text/csv.h"
#include "base/text/markup.h"
#include "base/text/number_text.h"
#include "experiments/analysis/report/charts/colors.h"
#include "experiments/analysis/report/charts/svg_chart.h"
#include "experiments/analysis/report/page/plain_page.h"
#include "experiments/trials/optimize/optimize_folder.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;

struct SearchFigure {
  std::string name;     // of the file, without ending
  std::string caption;  // plain text
  std::string svg;
};

// The evaluation of the lowest value; null while none has succeeded.
const SearchEvaluation* BestOf(const SearchFolder& search) {
  const SearchEvaluation* best = nullptr;
  for (const SearchEvaluation& one : search.evaluations) {
    if (one.value && (best == nullptr || *one.value < *best->value)) best = &one;
  }
  return best;
}

// The range of the values, a twentieth wider on each side, and by more than rounding.
SvgAxis ValueAxis(const SearchFolder& search) {
  SvgAxis axis{.title = "value"};
  std::optional<double> low, high;
  for (const SearchEvaluation& one : search.evaluations) {
    if (!one.value) continue;
    low = std::min(low.value_or(*one.value), *one.value);
    high = std::max(high.value_or(*one.value), *one.value);
  }
  const double rounding = 1e-6 * std::max(std::abs(*low), std::abs(*high));
  const double margin = *high > *low ? std::max(0.05 * (*high - *low), rounding) : 0.5;
  axis.low = *low - margin;
  axis.high = *high + margin;
  return axis;
}

SearchFigure Convergence(const SearchFolder& search) {
  const double last = search.evaluations.back().number;
  SvgChart chart({.title = "evaluation", .low = 0, .high = last + 1}, ValueAxis(search));
  std::vector<SvgPoint> values, best;
  for (const SearchEvaluation& one : search.evaluations) {
    if (!one.value) continue;
    const double number = one.number;
    values.push_back({number, *one.value});
    if (!best.empty()) best.push_back({number, best.back().y});
    best.push_back({number, best.empty() ? *one.value : std::min(best.back().y, *one.value)});
  }
  best.push_back({last, best.back().y});
  chart.Line(best, {.color = PaletteColor(0), .width = 2}, "lowest so far");
  chart.Points(values, {.width = 6, .opacity = 0.6}, "value");
  return {.name = "convergence",
          .caption = "The value of each evaluation, and the lowest so far.",
          .svg = chart.Text()};
}

SearchFigure Along(const SearchFolder& search, std::size_t k) {
  const SearchParameter& parameter = search.parameters[k];
  const SvgAxis y = ValueAxis(search);
  SvgChart chart(
      {.title = parameter.name, .low = parameter.low, .high = parameter.high, .log = parameter.log},
      y);
  std::string caption = "Every evaluation's value against " + parameter.name;
  if (search.answer && std::isfinite(search.answer->parameters[k].low)) {
    const ParameterAnswer& answer = search.answer->parameters[k];
    const SvgPoint from{answer.low, y.low};
    const SvgPoint to{answer.high, y.high};
    chart.Cell({.from = from, .to = to}, kAccentPale);
    caption += "; shaded its credible range, 90 % for all parameters together";
  }
  std::vector<SvgPoint> points;
  for (const SearchEvaluation& one : search.evaluations) {
    if (one.value) points.push_back({one.values[k], *one.value});
  }
  chart.Points(points, {.width = 6, .opacity = 0.6});
  if (const SearchEvaluation* best = BestOf(search)) {
    chart.Star({best->values[k], *best->value}, "lowest");
  }
  return {.name = "along_" + parameter.name, .caption = caption + ".", .svg = chart.Text()};
}

// Convergence, and for each parameter the values against it with its credible range. None while no
// evaluation has succeeded.
std::vector<SearchFigure> SearchFigures(const SearchFolder& search) {
  if (BestOf(search) == nullptr) return {};
  std::vector<SearchFigure> figures{Convergence(search)};
  for (std::size_t k = 0; k < search.parameters.size(); ++k) figures.push_back(Along(search, k));
  return figures;
}

// A dash where there is no number.
std::string Print(double x, int digits = 4) {
  return std::isfinite(x) ? base::ShortNumber(x, digits) : "–";
}

// Digits that tell the values apart: those of a large value that changes little are many.
int ValueDigits(const SearchFolder& search) {
  constexpr double kMost = 12;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const SearchEvaluation& one : search.evaluations) {
    if (!one.value) continue;
    low = std::min(low, *one.value);
    high = std::max(high, *one.value);
  }
  if (!(high > low)) return 4;
  const double shared = std::log10(std::max(std::abs(low), std::abs(high)) / (high - low));
  return static_cast<int>(std::min(kMost, 4 + std::ceil(std::max(0.0, shared))));
}

// Why the last evaluation failed, where the first eight, or all, have: the command is wrong then.
// Null else.
const std::string* AllFailed(const SearchFolder& search) {
  const int enough = std::min(trials::kHopeless, std::max(1, search.most_evaluations));
  const bool are_enough = std::cmp_greater_equal(search.evaluations.size(), enough);
  if (!are_enough || BestOf(search) != nullptr) return nullptr;
  return &search.evaluations.back().failure;
}

std::string Standing(const SearchFolder& search) {
  const auto count = static_cast<std::size_t>(search.evaluations.size());
  const auto num_failed = std::count_if(search.evaluations.begin(), search.evaluations.end(),
                                        [](const SearchEvaluation& one) { return !one.value; });
  std::string text = std::to_string(count) + " of at most " +
                     std::to_string(search.most_evaluations) + " evaluations, " +
                     std::to_string(num_failed) + " failed. ";
  if (const std::string* reason = AllFailed(search)) {
    return text + "All have failed, the last: " + *reason + ".";
  }
  if (!search.answer) return text + "The search has not ended.";
  return text + "Ended: " + search.answer->stopped + ".";
}

std::string AnswerTable(const SearchFolder& search) {
  std::string table = "<table>" + HtmlRow({"parameter", "recommended", "90 % from", "to",
                                           "Sobol index, first", "total", "best evaluation"},
                                          "th");
  const SearchEvaluation* best = BestOf(search);
  for (std::size_t k = 0; k < search.parameters.size(); ++k) {
    const ParameterAnswer& answer = search.answer->parameters[k];
    table += HtmlRow({search.parameters[k].name, Print(answer.recommended), Print(answer.low),
                      Print(answer.high), Print(answer.sobol_first), Print(answer.sobol_total),
                      best ? Print(best->values[k]) : "–"});
  }
  return table + "</table>\n";
}

std::string Answer(const SearchFolder& search) {
  if (AllFailed(search) != nullptr) {
    return "<p>" +
           WithCode("There is none: mend the command; the same `talus optimize` asks it again.") +
           "</p>\n";
  }
  if (!search.answer) {
    return "<p>" +
           WithCode(
               "There is none before the search ends. The same `talus optimize` goes on with "
               "it.") +
           "</p>\n";
  }
  const SearchAnswer& answer = *search.answer;
  std::string text = AnswerTable(search);
  const int digits = ValueDigits(search);
  text += "<p>Predicted value " + Print(answer.predicted_value, digits) + " ± " +
          Print(answer.predicted_sd) + " (standard deviation); " +
          (answer.noise_sd == 0 ? "evaluations without noise. "
                                : "noise sd of one evaluation " + Print(answer.noise_sd) + ". ");
  if (const SearchEvaluation* best = BestOf(search)) {
    text += "Lowest value seen: " + Print(*best->value, digits) + ", by evaluation " +
            std::to_string(best->number) + ". ";
  }
  text += "Share of the ranges that ties with the recommendation: " + Print(answer.tied_volume) +
          ".</p>\n<p class=\"note\">" + base::MarkupText(answer.model) + "</p>\n";
  for (const std::string& warning : answer.warnings) {
    text += "<p class=\"notice\">" + WithCode(warning) + "</p>\n";
  }
  return text;
}

std::vector<std::string> Head(const SearchFolder& search) {
  std::vector<std::string> head{"evaluation"};
  for (const SearchParameter& parameter : search.parameters) head.push_back(parameter.name);
  head.insert(head.end(), {"value", "failed"});
  return head;
}

std::string EvaluationTable(const SearchFolder& search) {
  std::string table = "<table>" + HtmlRow(Head(search), "th");
  const int digits = ValueDigits(search);
  for (const SearchEvaluation& one : search.evaluations) {
    std::vector<std::string> cells{std::to_string(one.number)};
    for (const double value : one.values) cells.push_back(Print(value));
    cells.push_back(one.value ? Print(*one.value, digits) : "");
    cells.push_back(one.failure);
    table += HtmlRow(cells);
  }
  return table + "</table>\n";
}

std::string EvaluationCsv(const SearchFolder& search) {
  base::Csv csv;
  for (const std::string& name : Head(search)) csv.Cell(name);
  csv.EndRow();
  for (const SearchEvaluation& one : search.evaluations) {
    csv.Cell(one.number).Cells(one.values).Cell(one.value.value_or(std::nan("")));
    csv.Cell(one.failure).EndRow();
  }
  return csv.Take();
}

std::string Charts(const std::vector<SearchFigure>& figures) {
  if (figures.empty()) return "<p>No evaluation has succeeded.</p>\n";
  std::string text = "<div class=\"grid two\">\n";
  for (const SearchFigure& figure : figures) {
    text += HtmlFigure(figure.svg, figure.caption);
  }
  return text + "</div>\n";
}

}  // namespace

std::string SearchPage(const SearchFolder& search) {
  const std::string sections =
      HtmlSection("answer", "Answer", Answer(search)) +
      HtmlSection("charts", "Values", Charts(SearchFigures(search))) +
      HtmlSection("evaluations", "Evaluations", HtmlScrolling(EvaluationTable(search)));
  return PageText({.kind = "Search report",
                   .title = search.name,
                   .standing = Standing(search),
                   .sections = sections});
}

fs::path WriteSearchReport(const SearchFolder& search, const fs::path& folder) {
  base::ClaimOutputFolder(folder, "report");
  fs::create_directories(folder / "figures");
  fs::create_directories(folder / "tables");
  for (const SearchFigure& figure : SearchFigures(search)) {
    base::WriteFileAtomically(folder / "figures" / (figure.name + ".svg"), figure.svg);
  }
  base::WriteFileAtomically(folder / "tables" / "evaluations.csv", EvaluationCsv(search));
  base::WriteFileAtomically(folder / "report.html", SearchPage(search));
  return folder / "report.html";
}

}  // namespace talus::analysis
