#include "experiments/campaign/verdict.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/text/number_text.h"

namespace talus::campaign {
namespace {

constexpr double kTied = 0.8;   // correlation above which two parameters are known together only
constexpr double kWide = 0.25;  // share of a searched range above which it is no point

// Three digits: a verdict is no table.
std::string Short(double value) { return base::ShortNumber(value, 3); }

std::string Percent(double share) { return base::ShortNumber(100 * share, 2) + " %"; }

std::string SetText(const VerdictBasis& basis, const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += (i == 0 ? "(" : ", ") + basis.names[i] + " " + Short(values[i]);
  }
  return text + ")";
}

double WidthOf(const VerdictBasis& basis, std::size_t i) {
  const optimizer::Parameter& p = basis.parameters[i];
  return p.ToUnit(basis.high[i]) - p.ToUnit(basis.low[i]);
}

std::string RangeText(const VerdictBasis& basis, std::size_t i) {
  return basis.names[i] + " in " + Short(basis.low[i]) + " to " + Short(basis.high[i]);
}

std::string RangesText(const VerdictBasis& basis) {
  std::string text;
  for (std::size_t i = 0; i < basis.names.size(); ++i) {
    text += (i == 0 ? "" : ", ") + RangeText(basis, i);
  }
  return text;
}

// With the recommended values where there is one set to look at.
std::string PointText(const VerdictBasis& basis) {
  std::string text = "The measurements determine a point: ";
  if (basis.sets.size() != 1) return text + RangesText(basis);
  for (std::size_t i = 0; i < basis.names.size(); ++i) {
    text += (i == 0 ? "" : ", ") + basis.names[i] + " " + Short(basis.sets[0][i]) +
            " (90 %: " + Short(basis.low[i]) + " to " + Short(basis.high[i]) + ")";
  }
  return text;
}

std::string SeparateText(const VerdictBasis& basis) {
  std::string text =
      "The measurements allow " + std::to_string(basis.branches.size()) + " separate answers";
  for (std::size_t b = 0; b < basis.branches.size(); ++b) {
    text += (b == 0 ? ": " : ", ") + Percent(basis.branches[b].share) + " of the posterior round " +
            SetText(basis, basis.branches[b].values);
  }
  return text;
}

std::string CurveText(const VerdictBasis& basis, std::pair<std::size_t, std::size_t> pair) {
  // What is known given the other: the narrower of the two.
  auto [given, known] = pair;
  if (WidthOf(basis, known) > WidthOf(basis, given)) std::swap(given, known);
  std::string text = "The measurements determine " + basis.names[known] + " given " +
                     basis.names[given] + ", not both";
  if (basis.sets.size() < 2) return text + ": " + RangesText(basis);
  return text + ": sets from " + SetText(basis, basis.sets.front()) + " to " +
         SetText(basis, basis.sets.back()) + " fit equally";
}

std::string RegionText(const VerdictBasis& basis) {
  std::string open;
  for (std::size_t i = 0; i < basis.names.size(); ++i) {
    if (WidthOf(basis, i) < kWide) continue;
    open += (open.empty() ? "" : ", ") + RangeText(basis, i) + " (" +
            Percent(std::min(1.0, WidthOf(basis, i))) + " of its searched range)";
  }
  return "The measurements leave a region, not a point: " + open;
}

VerdictKind KindOf(const VerdictBasis& basis) {
  if (basis.branches.size() > 1) return VerdictKind::kSeparate;
  bool wide = false;
  for (std::size_t i = 0; i < basis.names.size(); ++i) wide = wide || WidthOf(basis, i) >= kWide;
  if (!wide) return VerdictKind::kPoint;
  const auto pair = TiedPair(basis.correlation);
  const bool is_curve =
      pair && std::max(WidthOf(basis, pair->first), WidthOf(basis, pair->second)) >= kWide;
  return is_curve ? VerdictKind::kCurve : VerdictKind::kRegion;
}

std::string TextOf(VerdictKind kind, const VerdictBasis& basis) {
  switch (kind) {
    case VerdictKind::kSeparate:
      return SeparateText(basis);
    case VerdictKind::kCurve:
      return CurveText(basis, *TiedPair(basis.correlation));
    case VerdictKind::kRegion:
      return RegionText(basis);
    case VerdictKind::kPoint:
      break;
  }
  return PointText(basis);
}

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

std::optional<std::pair<std::size_t, std::size_t>> TiedPair(
    const std::vector<std::vector<double>>& correlation) {
  std::optional<std::pair<std::size_t, std::size_t>> pair;
  double most = kTied;
  for (std::size_t i = 0; i < correlation.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!(std::abs(correlation[i][j]) >= most)) continue;
      most = std::abs(correlation[i][j]);
      pair = {j, i};
    }
  }
  return pair;
}

std::optional<ResultVerdict> VerdictOf(const VerdictBasis& basis) {
  const auto known = [](double x) { return std::isfinite(x); };
  if (!std::ranges::all_of(basis.low, known) || !std::ranges::all_of(basis.high, known)) {
    return std::nullopt;
  }
  const VerdictKind kind = KindOf(basis);
  const std::string region = basis.branches.empty() ? "sets within the scatter fill about "
                                                    : "the joint 90 % region fills about ";
  return ResultVerdict{.kind = kind,
                       .text = TextOf(kind, basis) + "; " + region + Percent(basis.region_volume) +
                               " of the searched ranges."};
}

std::vector<Eigen::VectorXd> RepresentativeSets(const Eigen::MatrixXd& points,
                                                const Eigen::VectorXd& recommended) {
  // Shares of the points between which each end is taken: beyond them is the posterior's tail.
  constexpr double kOuter = 0.04;
  constexpr double kInner = 0.12;
  if (points.rows() < 10) return {recommended};
  const Eigen::MatrixXd centred = points.rowwise() - points.colwise().mean();
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
  if (at(1 - kOuter) - at(kOuter) < kWide) return {recommended};
  return {MiddleOf(points, place, at(kOuter), at(kInner)), recommended,
          MiddleOf(points, place, at(1 - kInner), at(1 - kOuter))};
}

}  // namespace talus::campaign
