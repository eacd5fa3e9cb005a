#include "experiments/analysis/predict/draws.h"

#include <limits>
#include <optional>

#include "base/error.h"
#include "base/random.h"
#include "experiments/campaign/answer/consider.h"
#include "experiments/campaign/answer/standing_answer.h"

namespace talus::analysis {
namespace {

constexpr int kRounds = 50;  // of Lloyd's; it has long settled for a few dozen cells

// The nearest centre of each draw.
std::vector<Eigen::Index> Cells(const Eigen::MatrixXd& draws, const Eigen::MatrixXd& centres) {
  std::vector<Eigen::Index> cells(static_cast<std::size_t>(draws.rows()));
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    (centres.rowwise() - draws.row(i))
        .rowwise()
        .squaredNorm()
        .minCoeff(&cells[static_cast<std::size_t>(i)]);
  }
  return cells;
}

// Centres moved to the mean of their draws; one that has lost all of them stays.
Eigen::MatrixXd MeansOf(const Eigen::MatrixXd& draws, const std::vector<Eigen::Index>& cells,
                        Eigen::MatrixXd centres) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(centres.rows(), centres.cols());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(centres.rows());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    sums.row(cells[i]) += draws.row(static_cast<Eigen::Index>(i));
    counts[cells[i]] += 1;
  }
  for (Eigen::Index c = 0; c < centres.rows(); ++c) {
    if (counts[c] > 0) centres.row(c) = sums.row(c) / counts[c];
  }
  return centres;
}

Eigen::VectorXd RecommendedPoint(const campaign::JointView& view) {
  const std::optional<campaign::Answer> answer = campaign::StandingAnswer(view.folder.root);
  if (!answer) {
    throw base::ConfigError(view.folder.root.string() +
                            ": has no result yet; without --recommended, draws of what its trials "
                            "say so far are taken");
  }
  return campaign::RecommendedPoint(*answer);
}

}  // namespace

std::vector<Eigen::Index> FarApart(const Eigen::MatrixXd& draws, int count) {
  std::vector<Eigen::Index> rows;
  Eigen::VectorXd distance =
      Eigen::VectorXd::Constant(draws.rows(), std::numeric_limits<double>::infinity());
  Eigen::Index next = 0;
  for (int i = 0; i < count && i < draws.rows() && distance[next] > 0; ++i) {
    rows.push_back(next);
    distance = distance.cwiseMin((draws.rowwise() - draws.row(next)).rowwise().norm());
    distance.maxCoeff(&next);
  }
  return rows;
}

WeightedDraws ChooseDraws(const Eigen::MatrixXd& draws, int count, std::uint64_t seed) {
  Eigen::MatrixXd centres = draws(FarApart(draws, count), Eigen::all);
  std::vector<Eigen::Index> cells = Cells(draws, centres);
  for (int round = 0; round < kRounds; ++round) {
    centres = MeansOf(draws, cells, std::move(centres));
    std::vector<Eigen::Index> moved = Cells(draws, centres);
    if (moved == cells) break;
    cells = std::move(moved);
  }
  WeightedDraws chosen;
  for (Eigen::Index c = 0; c < centres.rows(); ++c) {
    std::vector<Eigen::Index> inside;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] == c) inside.push_back(static_cast<Eigen::Index>(i));
    }
    if (inside.empty()) continue;
    base::Random random(seed, base::Stream("predicted draws"), static_cast<std::uint64_t>(c));
    const Eigen::RowVectorXd taken = draws.row(inside[random.Below(inside.size())]);
    chosen.points.emplace_back(taken.data(), taken.data() + taken.size());
    chosen.weights.push_back(static_cast<double>(inside.size()) /
                             static_cast<double>(draws.rows()));
  }
  return chosen;
}

Eigen::MatrixXd PosteriorDraws(const campaign::JointView& view) {
  constexpr int kDraws = 1000;
  return campaign::AnsweringStrategy(view)->Sample().Draws(kDraws, view.spec.seed);
}

WeightedDraws PosteriorSets(const campaign::JointView& view, int count) {
  return ChooseDraws(PosteriorDraws(view), count, view.spec.seed);
}

Eigen::VectorXd OneSet(const campaign::JointView& view, const PredictOptions& options) {
  if (options.recommended) return RecommendedPoint(view);
  return campaign::Filled(campaign::ReadSet(view.space, options.set),
                          *campaign::StrategyOf(view, view.Answered()));
}

}  // namespace talus::analysis
