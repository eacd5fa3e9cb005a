#include "experiments/analysis/report/views/model_views.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/student_factor.h"
#include "experiments/analysis/report/views/posterior_density.h"

namespace talus::analysis {
namespace {

constexpr int kSlicePoints = 61;
constexpr int kMarginalCells = 60;
constexpr int kRegionCells = 120;  // of a pair, each way

std::vector<double> Along(const ParameterInfo& parameter, int num_cells, double offset) {
  const int count = offset == 0 ? num_cells + 1 : num_cells;
  std::vector<double> values;
  for (int k = 0; k < count; ++k)
    values.push_back(parameter.range.ToNative((k + offset) / num_cells));
  return values;
}

PairMap MapOf(const Evidence& evidence, std::size_t i, std::size_t j, int num_cells) {
  return {.i = i,
          .j = j,
          .x_edges = Along(evidence.parameters[i], num_cells, 0),
          .y_edges = Along(evidence.parameters[j], num_cells, 0),
          .value = {}};
}

// Every pair of columns that is asked for, as a map whose values `fill` works out.
template <class Fill>
std::vector<PairMap> EachPair(const Evidence& evidence, const Eigen::MatrixXd& points,
                              int num_cells, Fill&& fill) {
  std::vector<PairMap> maps;
  const std::size_t n = evidence.parameters.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (evidence.parameters[i].range.is_nuisance || evidence.parameters[j].range.is_nuisance) {
        continue;
      }
      maps.push_back(MapOf(evidence, i, j, num_cells));
      Eigen::MatrixXd two(points.rows(), 2);
      two << points.col(static_cast<Eigen::Index>(i)), points.col(static_cast<Eigen::Index>(j));
      maps.back().value = fill(two);
    }
  }
  return maps;
}

// Where the draws lie with some room, from and to of the unit interval.
std::pair<double, double> SpanOf(const Eigen::VectorXd& draws) {
  constexpr double kRoom = 0.25;
  const double room = kRoom * (draws.maxCoeff() - draws.minCoeff());
  return {std::max(0.0, draws.minCoeff() - room), std::min(1.0, draws.maxCoeff() + room)};
}

// With two parameters the map is the region itself, as the model has it: a sum of kernels is a
// little larger. Its cells lie where the draws do, since a region may be as thin as a hundredth of
// the plane.
PairMap RegionMap(const Evidence& evidence) {
  const ModelEvidence& model = *evidence.model;
  PairMap map{.i = 0, .j = 1, .x_edges = {}, .y_edges = {}, .value = {}};
  Eigen::MatrixXd middles(kRegionCells * kRegionCells, 2);
  for (const int k : {0, 1}) {
    const auto [from, to] = SpanOf(model.draws.col(k));
    const auto at = [from = from, to = to](double cell) {
      return from + (to - from) * cell / kRegionCells;
    };
    for (int edge = 0; edge <= kRegionCells; ++edge) {
      (k == 0 ? map.x_edges : map.y_edges)
          .push_back(evidence.parameters[static_cast<std::size_t>(k)].range.ToNative(at(edge)));
    }
    for (int cell = 0; cell < middles.rows(); ++cell) {
      middles(cell, k) = at((k == 0 ? cell % kRegionCells : cell / kRegionCells) + 0.5);
    }
    map.plane *= to - from;
  }
  const Eigen::VectorXd levels = model.credible_levels(middles);
  map.value.assign(levels.begin(), levels.end());
  return map;
}

// Points with their credible levels, one a row.
struct Levelled {
  Eigen::MatrixXd points;
  Eigen::VectorXd levels;
};

// The draws, and what a uniform sample finds inside the region. The draws come from a sequence that
// fills the cube evenly and leaves stripes on some planes of four and more parameters.
Levelled ShadowPoints(const ModelEvidence& model) {
  constexpr Eigen::Index kTried = 1 << 13;
  constexpr Eigen::Index kMost = 2000;
  base::Random random(1, base::Stream("shadow of the region"));
  const Eigen::MatrixXd tried = Eigen::MatrixXd::NullaryExpr(
      kTried, model.draws.cols(), [&](Eigen::Index, Eigen::Index) { return random.Uniform(); });
  const Eigen::VectorXd levels = model.credible_levels(tried);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < kTried && std::ssize(inside) < kMost; ++i) {
    if (levels[i] <= optimizer::kRegionLevel) inside.push_back(i);
  }
  const Eigen::Index count = model.draws.rows() + std::ssize(inside);
  Levelled all{.points = Eigen::MatrixXd(count, model.draws.cols()),
               .levels = Eigen::VectorXd(count)};
  all.points << model.draws, tried(inside, Eigen::all);
  all.levels << model.credible_levels(model.draws), levels(inside);
  return all;
}

}  // namespace

std::vector<ModelSlice> SliceModel(const Evidence& evidence, const Eigen::VectorXd& point) {
  std::vector<ModelSlice> slices;
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    Eigen::MatrixXd along = point.transpose().replicate(kSlicePoints, 1);
    ModelSlice slice{.parameter = k, .x = {}, .mean = {}, .low = {}, .high = {}};
    for (int i = 0; i < kSlicePoints; ++i) {
      const double unit = static_cast<double>(i) / (kSlicePoints - 1);
      along(i, static_cast<Eigen::Index>(k)) = unit;
      slice.x.push_back(evidence.parameters[k].range.ToNative(unit));
    }
    const optimizer::Moments predicted = evidence.model->predict(along);
    for (int i = 0; i < kSlicePoints; ++i) {
      const double reach = base::kNormal90 * predicted.sd[i];
      slice.mean.push_back(predicted.mean[i]);
      slice.low.push_back(std::isnan(reach) ? reach : std::max(0.0, predicted.mean[i] - reach));
      slice.high.push_back(predicted.mean[i] + reach);
    }
    slices.push_back(std::move(slice));
  }
  return slices;
}

std::vector<Marginal> Marginals(const Evidence& evidence) {
  std::vector<Marginal> marginals;
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    const auto density_of = [&](const Eigen::MatrixXd& draws) {
      return MarginalDensity(draws.col(static_cast<Eigen::Index>(k)), kMarginalCells,
                             static_cast<int>(draws.cols()));
    };
    const ModelEvidence& model = *evidence.model;
    const bool uniform = model.prior_draws.rows() == 0;
    marginals.push_back({.parameter = k,
                         .x = Along(evidence.parameters[k], kMarginalCells, 0.5),
                         .density = density_of(model.draws),
                         .prior = uniform ? std::vector<double>(kMarginalCells, 1)
                                          : density_of(model.prior_draws)});
  }
  return marginals;
}

std::vector<PairMap> PosteriorPairs(const Evidence& evidence) {
  if (evidence.parameters.size() == 2 && evidence.all_asked_for()) return {RegionMap(evidence)};
  const Levelled shadow = ShadowPoints(*evidence.model);
  return EachPair(evidence, shadow.points, kRegionCells, [&](const Eigen::MatrixXd& two) {
    return ProjectedLevels(two, shadow.levels, kRegionCells);
  });
}

}  // namespace talus::analysis
