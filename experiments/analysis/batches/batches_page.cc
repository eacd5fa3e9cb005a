#include <string>
#include <vector>

#include "base/text/joined.h"
#include "base/text/markup.h"
#include "base/text/number_text.h"
#include "experiments/analysis/batches/batches_text.h"
#include "experiments/analysis/report/page/plain_page.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::analysis {
namespace {

std::string InRange(const BatchRange& range) {
  return base::ShortNumber(range.median) + " (" + base::ShortNumber(range.low) + " … " +
         base::ShortNumber(range.high) + ")";
}

std::string Change(const BatchParameter& p, const BatchRange& range) {
  return (p.IsLog() ? "× " : "") + InRange(range);
}

std::string Verdicts(const BatchComparison& c) {
  std::string list = "<ul>\n";
  for (const std::string& engine : c.other_engines) {
    list += "<li>Warning: " + WithCode(engine) + "</li>\n";
  }
  for (std::size_t b = 1; b < c.batches.size(); ++b) {
    list += "<li><strong>" + base::MarkupText(c.batches[b]) +
            "</strong>: " + base::MarkupText(c.verdicts[b - 1].text) +
            " (of all parameters together a difference of zero has the credible level " +
            base::ShortNumber(c.together[b - 1].level, 2) +
            "; all that was measured together differs so by chance with probability " +
            base::ShortNumber(c.verdicts[b - 1].measured_by_chance, 2) + ")</li>\n";
  }
  for (const std::string& warning : c.warnings) {
    list += "<li>Warning: " + WithCode(warning) + "</li>\n";
  }
  return list + "</ul>\n";
}

std::string Charts(const BatchComparison& c) {
  std::string text = "<div class=\"grid two\">\n";
  for (const BatchParameter& p : c.parameters) {
    text += HtmlFigure(BatchesSvg(c, p), p.name + " of each batch with its 90 %.");
  }
  text += "</div>\n<p class=\"note\">Batches: ";
  const auto numbered = [&](std::size_t b) {
    return std::to_string(b + 1) + " " + base::MarkupText(c.batches[b]);
  };
  return text + base::JoinedUpTo(c.batches.size(), ", ", numbered) + ".</p>\n";
}

std::string DifferenceTable(const BatchComparison& c) {
  std::string table =
      "<table>" + HtmlRow({"parameter", "unit", "batch", "median (90 %)", "difference (90 %)",
                           "what would matter", "probability that it is larger"},
                          "th");
  for (const BatchParameter& p : c.parameters) {
    for (std::size_t b = 0; b < c.batches.size(); ++b) {
      std::vector<std::string> cells{p.name + (p.is_nuisance ? " (not asked for)" : ""), p.unit,
                                     c.batches[b], InRange(p.batches[b])};
      if (b > 0) {
        const BatchDifference& d = p.differences[b - 1];
        cells.insert(cells.end(), {Change(p, d.range), ChangeText(p, d.matters),
                                   base::ShortNumber(d.probability, 2)});
      } else {
        cells.insert(cells.end(), 3, "–");
      }
      table += HtmlRow(cells);
    }
  }
  return table + "</table>\n";
}

std::string PictureTable(const BatchComparison& c) {
  std::string table = "<table>" + HtmlRow({"batch", "experiment", "SAD of the mean profiles, mm²",
                                           "probability by chance", "arrangements of the runs"},
                                          "th");
  for (const BatchPictures& p : c.pictures) {
    if (p.absent.empty()) {
      table += HtmlRow({p.batch, p.experiment, base::ShortNumber(p.sad_mm2),
                        base::ShortNumber(p.probability, 2), std::to_string(p.num_arrangements)});
    } else {
      table += HtmlRow({p.batch, p.experiment, "not compared: " + p.absent, "–", "–"});
    }
  }
  return table + "</table>\n";
}

std::string NumberTable(const BatchComparison& c) {
  std::string table =
      "<table>" +
      HtmlRow({"batch", "experiment", "number", "difference", "probability by chance"}, "th");
  for (const BatchNumber& n : c.numbers) {
    table += HtmlRow({n.batch, n.experiment, rigs::SpokenName(n.name), DifferenceText(n),
                      base::ShortNumber(n.probability, 2)});
  }
  return table + "</table>\n";
}

}  // namespace

std::string BatchesPage(const BatchComparison& c) {
  std::string sections = HtmlSection("verdicts", "Do they differ?", Verdicts(c));
  sections += HtmlSection("charts", "Parameters over the batches", Charts(c));
  sections += HtmlSection("differences", "Differences", HtmlScrolling(DifferenceTable(c)));
  if (!c.pictures.empty()) {
    sections += HtmlSection("photographs", "Photographs", HtmlScrolling(PictureTable(c)));
  }
  if (!c.numbers.empty()) {
    sections += HtmlSection("numbers", "Numbers measured", HtmlScrolling(NumberTable(c)));
  }
  return PageText({.kind = "Batches",
                   .title = std::to_string(c.batches.size()) + " batches of a powder",
                   .standing = "Each is compared with " + c.batches.front() + ".",
                   .sections = sections});
}

}  // namespace talus::analysis
