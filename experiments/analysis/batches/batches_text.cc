#include "experiments/analysis/batches/batches_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text/csv.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/analysis/report/charts/svg_chart.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::analysis {
namespace {

using base::ShortNumber;

std::string RangeText(const BatchRange& range) {
  return ShortNumber(range.median) + " (median; 90 % in " + ShortNumber(range.low) + " … " +
         ShortNumber(range.high) + ")";
}

std::string WithUnit(const std::string& text, const BatchParameter& p) {
  return text + (p.unit.empty() ? "" : " " + p.unit);
}

// "sliding_friction  0.4 (90 % in …) → 0.6 (…); difference 0.2 (…), larger than 0.07 with …".
std::string ParameterText(const BatchParameter& p, std::size_t batch) {
  const BatchDifference& d = p.differences[batch - 1];
  const std::string change =
      (p.IsLog() ? "× " : "") + (p.IsLog() ? RangeText(d.range) : WithUnit(RangeText(d.range), p));
  return p.name + (p.is_nuisance ? " (not asked for)" : "") + "  " + RangeText(p.batches.front()) +
         " → " + WithUnit(RangeText(p.batches[batch]), p) + "; difference " + change +
         ", either way larger than " + ChangeText(p, d.matters) + " with probability " +
         ShortNumber(d.probability, 2);
}

std::string TogetherText(const BatchTogether& together) {
  return "all parameters together  a difference of zero lies " +
         std::string(together.is_found ? "outside" : "inside") +
         " their joint 90 % region (credible level " + ShortNumber(together.level, 3) + ")";
}

std::string PicturesText(const BatchPictures& p) {
  if (!p.absent.empty()) return "not compared: " + p.absent;
  const bool differ = IsBeyondChance(p.probability);
  const bool can_tell = IsBeyondChance(1.0 / p.num_arrangements);
  return ShortNumber(p.sad_mm2) + " mm² between the mean profiles, " +
         (differ     ? "beyond the scatter of the runs"
          : can_tell ? "within the scatter of the runs"
                     : "of which so few runs cannot say whether it is chance; four each can") +
         " (probability by chance " + ShortNumber(p.probability, 2) + ", " +
         std::to_string(p.num_arrangements) + " arrangements)";
}

std::string NumberText(const BatchNumber& n) {
  return n.experiment + "  " + rigs::SpokenName(n.name) + " differs by " + DifferenceText(n) +
         ", probability by chance " + ShortNumber(n.probability, 2);
}

}  // namespace

std::string ChangeText(const BatchParameter& p, double change) {
  return p.IsLog() ? "× " + ShortNumber(change) : ShortNumber(change);
}

std::string DifferenceText(const BatchNumber& n) {
  const rigs::ShownUnit unit = rigs::ShownUnitOf(rigs::UnitOfObservable(n.name));
  return ShortNumber(unit.per_unit * n.difference) + " ± " +
         ShortNumber(unit.per_unit * n.standard_error, 2) +
         (unit.text.empty() ? "" : " " + unit.text);
}

std::string BatchesText(const BatchComparison& c) {
  std::string text = "compared with " + c.batches.front() + "\n";
  for (const std::string& engine : c.other_engines) text += "  warning: " + engine + "\n";
  for (std::size_t b = 1; b < c.batches.size(); ++b) {
    text += "  " + c.batches[b] + ": " + c.verdicts[b - 1].text + "\n";
    for (const BatchParameter& p : c.parameters) text += "    " + ParameterText(p, b) + "\n";
    if (NumAsked(c) > 1) text += "    " + TogetherText(c.together[b - 1]) + "\n";
    for (const BatchPictures& p : c.pictures) {
      if (p.batch == c.batches[b]) text += "    " + p.experiment + "  " + PicturesText(p) + "\n";
    }
    for (const BatchNumber& n : c.numbers) {
      if (n.batch == c.batches[b]) text += "    " + NumberText(n) + "\n";
    }
    if (NumMeasured(c, c.batches[b]) > 1) {
      text += "    all that was measured together  " +
              ShortNumber(c.verdicts[b - 1].measured_by_chance, 2) + " by chance\n";
    }
  }
  for (const std::string& warning : c.warnings) text += "  warning: " + warning + "\n";
  return text;
}

std::string BatchesCsv(const BatchComparison& c) {
  base::Csv csv;
  csv.Heads({"batch", "parameter", "unit", "scale", "median", "low_90", "high_90", "difference",
             "difference_low_90", "difference_high_90", "matters", "probability_larger"})
      .EndRow();
  for (std::size_t b = 0; b < c.batches.size(); ++b) {
    for (const BatchParameter& p : c.parameters) {
      const BatchRange& r = p.batches[b];
      csv.Cell(c.batches[b])
          .Cell(p.name)
          .Cell(p.unit)
          .Cell(p.scale)
          .Cells({r.median, r.low, r.high});
      if (b > 0) {
        const BatchDifference& d = p.differences[b - 1];
        csv.Cells({d.range.median, d.range.low, d.range.high, d.matters, d.probability});
      } else {
        csv.Cells(std::vector<double>(5, std::nan("")));
      }
      csv.EndRow();
    }
  }
  return csv.Take();
}

namespace {

// What would matter, down and up from the first batch's median.
std::pair<double, double> Limits(const BatchParameter& p) {
  const double median = p.batches.front().median;
  if (p.differences.empty()) return {median, median};
  const double matters = p.differences.front().matters;
  if (p.IsLog()) return {median / matters, median * matters};
  return {median - matters, median + matters};
}

// The ranges of all batches and these limits, a tenth wider.
SvgAxis AxisOf(const BatchParameter& p) {
  auto [low, high] = Limits(p);
  for (const BatchRange& r : p.batches) {
    low = std::min(low, r.low);
    high = std::max(high, r.high);
  }
  SvgAxis axis{.title = p.name + (p.unit.empty() ? "" : " (" + p.unit + ")"), .log = p.IsLog()};
  if (axis.log) {
    const double factor = high > low ? std::pow(high / low, 0.1) : 2;
    axis.low = low / factor;
    axis.high = high * factor;
  } else {
    const double margin = high > low ? 0.1 * (high - low) : 1;
    axis.low = low - margin;
    axis.high = high + margin;
  }
  return axis;
}

}  // namespace

std::string BatchesSvg(const BatchComparison& c, const BatchParameter& p) {
  const BatchRange& first = p.batches.front();
  const auto [least, most] = Limits(p);
  SvgChart chart({.title = "batch",
                  .low = 0.5,
                  .high = static_cast<double>(c.batches.size()) + 0.5,
                  .whole = true},
                 AxisOf(p));
  const double from = 0.5;
  const double to = static_cast<double>(c.batches.size()) + 0.5;
  chart.Band({{from, first.low}, {to, first.low}}, {{from, first.high}, {to, first.high}},
             {.color = kSoft, .opacity = 0.15}, "90 % of the first batch");
  for (const double limit : {least, most}) {
    chart.Line({{from, limit}, {to, limit}}, {.color = kSoft, .width = 1, .dashed = true},
               limit < first.median ? "what would matter" : "");
  }
  std::vector<SvgPoint> medians;
  for (std::size_t b = 0; b < p.batches.size(); ++b) {
    const auto x = static_cast<double>(b + 1);
    chart.Line({{x, p.batches[b].low}, {x, p.batches[b].high}}, {.color = kSoft},
               b == 0 ? "90 %" : "");
    medians.push_back({x, p.batches[b].median});
  }
  chart.Points(medians, {.color = PaletteColor(0), .width = 7}, "median");
  return chart.Text();
}

}  // namespace talus::analysis
