#include "experiments/analysis/report/charts/figures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/analysis/report/charts/colors.h"
#include "experiments/analysis/report/charts/svg_chart.h"

namespace talus::analysis {
namespace {

std::string WithUnit(std::string_view title, std::string_view unit) {
  return std::string(title) + (unit.empty() ? "" : " (" + std::string(unit) + ")");
}

SvgAxis AxisOf(const ParameterInfo& p) {
  return {.title = WithUnit(p.symbol, p.unit),
          .low = p.range.low,
          .high = p.range.high,
          .log = p.range.scale == optimizer::Scale::kLog};
}

struct Valued {
  const TrialEvidence* trial = nullptr;
  double objective = 0;
};

std::vector<Valued> ValuedTrials(const ReportData& data) {
  std::vector<Valued> valued;
  const auto column = MetricColumn(data.evidence, data.own().info.metric);
  if (!column) return valued;
  for (const TrialEvidence& t : data.evidence.trials) {
    if (t.state != journal::TrialStatus::kOk || std::isnan(t.metrics[*column])) continue;
    const double value = data.own().info.Value(t.metrics[*column], data.own().reference);
    valued.push_back({&t, data.own().info.per_unit * value});
  }
  return valued;
}

std::string Convergence(const ReportData& data, const std::vector<Valued>& valued) {
  const Criterion& info = data.own().info;
  double top = 0;
  for (const Valued& v : valued) top = std::max(top, v.objective);
  const double last = data.evidence.trials.back().id;
  SvgChart chart({.title = "trial", .low = 0, .high = std::max(1.0, last)},
                 {.title = WithUnit(info.title, info.unit), .low = 0, .high = 1.05 * top});
  std::map<std::string, std::vector<SvgPoint>> by_purpose;
  std::vector<SvgPoint> best, low, high;
  const double noise = std::isnan(data.own().noise_sd) ? 0 : info.per_unit * data.own().noise_sd;
  const auto extend = [&](double x, double y) {
    best.push_back({x, y});
    low.push_back({x, std::max(0.0, y - noise)});
    high.push_back({x, y + noise});
  };
  for (const Valued& v : valued) {
    const double id = v.trial->id;
    by_purpose[v.trial->purpose].push_back({id, v.objective});
    if (!best.empty()) extend(id, best.back().y);
    if (best.empty() || v.objective < best.back().y) extend(id, v.objective);
  }
  if (noise > 0) {
    chart.Band(low, high, {.color = kScatterBand, .opacity = 0.4}, "± scatter of one simulation");
  }
  std::size_t k = 0;
  for (const auto& [purpose, points] : by_purpose) {
    chart.Points(points, {.color = PaletteColor(k++), .width = 6, .opacity = 0.8}, purpose);
  }
  chart.Line(best, {.width = 2}, "best so far");
  const double floor = data.evidence.reference.noise_floor;
  if (info.is_sad && std::isfinite(floor)) {
    chart.Line({{0, floor}, {last, floor}}, {.color = kSoft, .dashed = true},
               "noise floor of the experiment");
  }
  return chart.Text();
}

std::string Outlines(const ReportData& data) {
  double reach = data.evidence.reference.aehp.frame.plate_diameter / 2;
  double top = 0;
  for (const OutlineCurve& outline : data.outlines) {
    for (std::size_t i = 0; i < outline.x.size(); ++i) {
      reach = std::max(reach, std::abs(outline.x[i]));
      top = std::max(top, outline.height[i]);
    }
  }
  SvgChart chart({.title = "distance from the plate's centre (mm)",
                  .low = -1.05e3 * reach,
                  .high = 1.05e3 * reach},
                 {.title = "height (mm)", .low = 0, .high = std::max(1.08e3 * top, 1e-3)}, true);
  for (std::size_t k = 0; k < data.outlines.size(); ++k) {
    std::vector<SvgPoint> points;
    for (std::size_t i = 0; i < data.outlines[k].x.size(); ++i) {
      points.push_back({1e3 * data.outlines[k].x[i], 1e3 * data.outlines[k].height[i]});
    }
    const SvgStyle style{.color = k == 0 ? kInk : PaletteColor(k - 1), .width = k == 0 ? 3 : 1.5};
    chart.Line(points, style, data.outlines[k].title);
  }
  return chart.Text();
}

std::string Slice(const ReportData& data, const ModelSlice& slice) {
  const ParameterInfo& parameter = data.evidence.parameters[slice.parameter];
  const Criterion& info = data.own().info;
  std::vector<SvgPoint> mean, low, high;
  double top = 0;
  const bool has_band = std::isfinite(slice.high.front());
  for (std::size_t i = 0; i < slice.x.size(); ++i) {
    mean.push_back({slice.x[i], slice.mean[i]});
    low.push_back({slice.x[i], slice.low[i]});
    high.push_back({slice.x[i], slice.high[i]});
    top = std::max(top, has_band ? slice.high[i] : slice.mean[i]);
  }
  SvgChart chart(AxisOf(parameter),
                 {.title = WithUnit(info.title, info.unit), .low = 0, .high = 1.05 * top});
  if (has_band) {
    chart.Band(low, high, {.color = PaletteColor(0), .opacity = 0.2}, "90 % band of the mean");
  }
  chart.Line(mean, {.color = PaletteColor(0), .width = 2}, "expected");
  if (data.evidence.conclusion) {
    const double x = data.evidence.conclusion->values[slice.parameter].value;
    chart.Line({{x, 0}, {x, 1.05 * top}}, {.color = kStar}, "recommended");
  }
  return chart.Text();
}

std::string MarginalFigure(const ReportData& data, const Marginal& marginal) {
  const double top = *std::max_element(marginal.density.begin(), marginal.density.end());
  SvgChart chart(AxisOf(data.evidence.parameters[marginal.parameter]),
                 {.title = "posterior density / even density", .low = 0, .high = 1.05 * top});
  std::vector<SvgPoint> points;
  for (std::size_t i = 0; i < marginal.x.size(); ++i) {
    points.push_back({marginal.x[i], marginal.density[i]});
  }
  chart.Line(points, {.color = PaletteColor(0), .width = 2}, "posterior");
  return chart.Text();
}

void AddStar(const ReportData& data, std::size_t i, std::size_t j, SvgChart& chart) {
  if (!data.evidence.conclusion) return;
  const auto& values = data.evidence.conclusion->values;
  chart.Star({values[i].value, values[j].value}, "recommended");
}

// With a posterior the joint regions: 50 % dark, 90 % light, the rest white.
std::string PairFigure(const ReportData& data, const PairMap& pair) {
  SvgChart chart(AxisOf(data.evidence.parameters[pair.i]),
                 AxisOf(data.evidence.parameters[pair.j]));
  const std::size_t num_x = pair.x_edges.size() - 1;
  const double top = *std::max_element(pair.value.begin(), pair.value.end());
  const auto shade = [&](double value) -> std::string {
    if (!data.has_posterior()) return ChanceShade(top > 0 ? value / top : 0);
    return value < 0.5 ? kRegion50 : kRegion90;
  };
  for (std::size_t cell = 0; cell < pair.value.size(); ++cell) {
    if (data.has_posterior() && pair.value[cell] >= 0.9) continue;
    const std::size_t x = cell % num_x;
    const std::size_t y = cell / num_x;
    chart.Cell({.from = {pair.x_edges[x], pair.y_edges[y]},
                .to = {pair.x_edges[x + 1], pair.y_edges[y + 1]}},
               shade(pair.value[cell]));
  }
  AddStar(data, pair.i, pair.j, chart);
  return chart.Text();
}

std::string Scatter(const ReportData& data, const PairMap& pair) {
  SvgChart chart(AxisOf(data.evidence.parameters[pair.i]),
                 AxisOf(data.evidence.parameters[pair.j]));
  std::vector<SvgPoint> all;
  for (const TrialEvidence& t : data.evidence.trials) {
    if (t.state == journal::TrialStatus::kOk) all.push_back({t.values[pair.i], t.values[pair.j]});
  }
  chart.Points(all, {.color = kTrials, .width = 5}, "trials");
  for (std::size_t k = 0; k < data.findings.size(); ++k) {
    std::vector<SvgPoint> best;
    for (const ComparedSet& set : data.findings[k].from_trials.best) {
      best.push_back({set.values[pair.i], set.values[pair.j]});
    }
    if (best.empty()) continue;
    // Smaller from one objective to the next, so that sets that several prefer show all of them.
    const SvgStyle style{.color = PaletteColor(k), .width = 13 - 2 * static_cast<double>(k)};
    chart.Points(best, style, "ten best by " + data.findings[k].info.title);
  }
  AddStar(data, pair.i, pair.j, chart);
  return chart.Text();
}

}  // namespace

std::vector<NamedText> ReportFigures(const ReportData& data) {
  std::vector<NamedText> figures;
  const std::vector<Valued> valued = ValuedTrials(data);
  if (!valued.empty()) figures.push_back({"convergence", Convergence(data, valued)});
  if (!data.outlines.empty()) figures.push_back({"outlines", Outlines(data)});
  const auto& parameters = data.evidence.parameters;
  for (const ModelSlice& slice : data.slices) {
    figures.push_back({"slice_" + parameters[slice.parameter].range.name, Slice(data, slice)});
  }
  for (const Marginal& marginal : data.marginals) {
    figures.push_back(
        {"posterior_" + parameters[marginal.parameter].range.name, MarginalFigure(data, marginal)});
  }
  for (const PairMap& pair : data.pairs) {
    const std::string names = parameters[pair.i].range.name + "_" + parameters[pair.j].range.name;
    figures.push_back({"trials_" + names, Scatter(data, pair)});
    figures.push_back(
        {(data.has_posterior() ? "posterior_" : "tie_chance_") + names, PairFigure(data, pair)});
  }
  return figures;
}

}  // namespace talus::analysis
