#include "experiments/analysis/search/search_figures.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "experiments/analysis/report/charts/colors.h"
#include "experiments/analysis/report/charts/svg_chart.h"

namespace talus::analysis {
namespace {

// The range of the values, a twentieth wider on each side.
SvgAxis ValueAxis(const SearchFolder& search) {
  SvgAxis axis{.title = "value"};
  std::optional<double> low, high;
  for (const SearchEvaluation& one : search.evaluations) {
    if (!one.value) continue;
    low = std::min(low.value_or(*one.value), *one.value);
    high = std::max(high.value_or(*one.value), *one.value);
  }
  const double margin = *high > *low ? 0.05 * (*high - *low) : 0.5;
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

}  // namespace

const SearchEvaluation* BestOf(const SearchFolder& search) {
  const SearchEvaluation* best = nullptr;
  for (const SearchEvaluation& one : search.evaluations) {
    if (one.value && (best == nullptr || *one.value < *best->value)) best = &one;
  }
  return best;
}

std::vector<SearchFigure> SearchFigures(const SearchFolder& search) {
  if (BestOf(search) == nullptr) return {};
  std::vector<SearchFigure> figures{Convergence(search)};
  for (std::size_t k = 0; k < search.parameters.size(); ++k) figures.push_back(Along(search, k));
  return figures;
}

}  // namespace talus::analysis
