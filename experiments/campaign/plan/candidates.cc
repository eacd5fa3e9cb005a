#include "experiments/campaign/plan/candidates.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace talus::campaign {
namespace {

constexpr double kDifferent = 0.05;  // between two candidates, in the unit cube

// The draw nearest to the mean of those whose place along the direction is in [low, high].
Eigen::VectorXd MiddleOf(const Eigen::MatrixXd& points, const Eigen::VectorXd& place, double low,
                         double high) {
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(points.cols());
  double count = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (place[i] < low || place[i] > high) continue;
    mean += points.row(i);
    count += 1;
  }
  Eigen::Index nearest = 0;
  (points.rowwise() - mean / count).rowwise().squaredNorm().minCoeff(&nearest);
  return points.row(nearest);
}

}  // namespace

bool AreNear(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() < kDifferent;
}

std::vector<Eigen::VectorXd> RepresentativeSets(const Eigen::MatrixXd& points,
                                                const Eigen::VectorXd& recommended,
                                                const std::vector<Eigen::Index>& asked) {
  // Shares of the points between which each end is taken: beyond them is the posterior's tail.
  constexpr double kOuter = 0.04;
  constexpr double kInner = 0.12;
  if (points.rows() < 10) return {recommended};
  const Eigen::MatrixXd places = points(Eigen::all, asked);
  const Eigen::MatrixXd centred = places.rowwise() - places.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(centred.transpose() * centred);
  Eigen::VectorXd along = axes.eigenvectors().rightCols(1);
  Eigen::Index largest = 0;
  along.cwiseAbs().maxCoeff(&largest);
  if (along[largest] < 0) along = -along;
  const Eigen::VectorXd place = centred * along;
  std::vector<double> sorted(place.data(), place.data() + place.size());
  std::sort(sorted.begin(), sorted.end());
  const auto last = static_cast<double>(sorted.size() - 1);
  const auto at = [&](double share) { return sorted[static_cast<std::size_t>(share * last)]; };
  if (at(1 - kOuter) - at(kOuter) < kWideRange) return {recommended};
  return {MiddleOf(points, place, at(kOuter), at(kInner)), recommended,
          MiddleOf(points, place, at(1 - kInner), at(1 - kOuter))};
}

std::vector<Candidate> CandidatesOf(const optimizer::Answer& answer, const EqualSets& equal,
                                    const ConfirmOptions& options) {
  std::vector<Candidate> candidates;
  const auto add = [&](const Eigen::VectorXd& point, CandidateRole role) {
    const auto near = [&](const Candidate& other) { return AreNear(other.point, point); };
    if (std::ranges::none_of(candidates, near)) candidates.push_back({point, role});
  };
  add(answer.point, CandidateRole::kRecommended);
  if (!answer.posterior) return candidates;
  for (const optimizer::PosteriorBranch& branch : answer.posterior->branches) {
    if (static_cast<int>(candidates.size()) < options.candidates) {
      add(branch.point, CandidateRole::kBranch);
    }
  }
  if (!options.ends) return candidates;
  for (const Eigen::VectorXd& set : RepresentativeSets(equal.region, answer.point, equal.asked)) {
    add(set, CandidateRole::kEnd);
  }
  return candidates;
}

}  // namespace talus::campaign
