#include "experiments/analysis/report/model_views.h"

#include <algorithm>
#include <cmath>

namespace talus::analysis {
namespace {

constexpr int kSlicePoints = 61;
constexpr int kCells = 20;          // of a pair, each way
constexpr int kPairSample = 16384;  // points of the cube: some 40 fall into each cell

double NormalCdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// P[|q - reference| <= limit] or P[q <= limit] for q ~ N(quantity, sd²).
double ChanceBelow(const ObjectivePrediction& p, const ObjectiveFinding& finding, double limit) {
  const double sd = std::max(p.sd, 1e-300);
  if (!finding.info.is_angle) return NormalCdf((limit - p.quantity) / sd);
  return NormalCdf((finding.reference + limit - p.quantity) / sd) -
         NormalCdf((finding.reference - limit - p.quantity) / sd);
}

std::vector<double> Edges(const ParameterInfo& parameter) {
  std::vector<double> edges;
  for (int k = 0; k <= kCells; ++k) {
    edges.push_back(parameter.range.ToNative(static_cast<double>(k) / kCells));
  }
  return edges;
}

std::size_t CellOf(double unit) {
  return static_cast<std::size_t>(std::clamp(static_cast<int>(unit * kCells), 0, kCells - 1));
}

PairChance MakePair(const Evidence& evidence, std::size_t i, std::size_t j,
                    const Eigen::MatrixXd& sample, const std::vector<double>& chances) {
  PairChance pair{.i = i,
                  .j = j,
                  .x_edges = Edges(evidence.parameters[i]),
                  .y_edges = Edges(evidence.parameters[j]),
                  .chance = std::vector<double>(kCells * kCells, 0.0)};
  std::vector<int> counts(pair.chance.size(), 0);
  for (Eigen::Index row = 0; row < sample.rows(); ++row) {
    const std::size_t cell = CellOf(sample(row, static_cast<Eigen::Index>(j))) * kCells +
                             CellOf(sample(row, static_cast<Eigen::Index>(i)));
    pair.chance[cell] += chances[static_cast<std::size_t>(row)];
    ++counts[cell];
  }
  for (std::size_t cell = 0; cell < counts.size(); ++cell) {
    pair.chance[cell] /= std::max(1, counts[cell]);
  }
  return pair;
}

}  // namespace

std::vector<ModelSlice> SliceModel(const Evidence& evidence, const ModelFinding& finding,
                                   const Eigen::VectorXd& point) {
  std::vector<ModelSlice> slices;
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    Eigen::MatrixXd along = point.transpose().replicate(kSlicePoints, 1);
    ModelSlice slice{.parameter = k, .x = {}, .predicted = {}};
    for (int i = 0; i < kSlicePoints; ++i) {
      const double unit = static_cast<double>(i) / (kSlicePoints - 1);
      along(i, static_cast<Eigen::Index>(k)) = unit;
      slice.x.push_back(evidence.parameters[k].range.ToNative(unit));
    }
    slice.predicted = finding.model.Predict(along);
    slices.push_back(std::move(slice));
  }
  return slices;
}

std::vector<PairChance> PairChances(const Evidence& evidence, const ObjectiveFinding& finding) {
  const std::size_t n = evidence.parameters.size();
  if (n < 2) return {};
  const Eigen::MatrixXd sample = EvenSample(kPairSample, static_cast<Eigen::Index>(n));
  const double limit = finding.from_model->there.objective + finding.margin();
  std::vector<double> chances;
  for (const ObjectivePrediction& p : finding.from_model->model.Predict(sample)) {
    chances.push_back(ChanceBelow(p, finding, limit));
  }
  std::vector<PairChance> pairs;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      pairs.push_back(MakePair(evidence, i, j, sample, chances));
    }
  }
  return pairs;
}

}  // namespace talus::analysis
