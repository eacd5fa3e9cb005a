#include "optimizer/space/domain.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

// Rounding on the way to the unit cube may put a bound just outside.
bool IsInCube(double coordinate) {
  return coordinate >= -surrogate::kSamePoint && coordinate <= 1 + surrogate::kSamePoint;
}

template <class Coordinates>
bool AreInCube(const Coordinates& coordinates) {
  return std::all_of(coordinates.begin(), coordinates.end(), IsInCube);
}

constexpr const char* kOutsideCube = "lies outside the unit cube: give coordinates from 0 to 1";

std::string ForEachParameter(Eigen::Index count, std::string_view things, int num_parameters) {
  return "has " + std::to_string(count) + " " + std::string(things) + " for " +
         std::to_string(num_parameters) + " parameters: give one for each";
}

std::string ItemPath(std::string_view list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

void ValidateGuesses(const Domain& domain, base::Problems& problems) {
  for (std::size_t i = 0; i < domain.guesses.size(); ++i) {
    const Eigen::VectorXd& guess = domain.guesses[i];
    problems.Require(guess.size() == domain.num_parameters, ItemPath("guesses", i),
                     ForEachParameter(guess.size(), "coordinates", domain.num_parameters));
    problems.Require(AreInCube(guess), ItemPath("guesses", i), kOutsideCube);
  }
}

void ValidateCandidates(const Domain& domain, base::Problems& problems) {
  if (!domain.IsList()) return;
  problems.Require(domain.candidates.cols() == domain.num_parameters, "candidates",
                   ForEachParameter(domain.candidates.cols(), "columns", domain.num_parameters));
  for (Eigen::Index i = 0; i < domain.candidates.rows(); ++i) {
    problems.Require(AreInCube(domain.candidates.row(i)),
                     ItemPath("candidates", static_cast<std::size_t>(i)), kOutsideCube);
  }
}

void ValidateLevelLists(const Domain& domain, base::Problems& problems) {
  const auto num_lists = static_cast<Eigen::Index>(domain.levels.size());
  problems.Require(num_lists == 0 || num_lists == domain.num_parameters, "levels",
                   ForEachParameter(num_lists, "lists", domain.num_parameters) +
                       ", an empty one where it may have any value");
  for (std::size_t k = 0; k < domain.levels.size(); ++k) {
    problems.Require(AreInCube(domain.levels[k]), ItemPath("levels", k), kOutsideCube);
    problems.Require(std::ranges::is_sorted(domain.levels[k]), ItemPath("levels", k),
                     "must be ascending");
  }
}

void ValidateMarks(const Domain& domain, base::Problems& problems) {
  const auto is_coordinate = [&](Eigen::Index k) { return k >= 0 && k < domain.num_parameters; };
  problems.Require(std::ranges::all_of(domain.nuisances, is_coordinate) &&
                       std::ranges::is_sorted(domain.nuisances),
                   "nuisances", "must be indices of parameters, ascending");
  problems.Require(std::ranges::all_of(domain.added, is_coordinate, &AddedCoordinate::coordinate),
                   "added", "must have indices of parameters");
}

}  // namespace

void Domain::Validate(base::Problems& problems) const {
  problems.RequireFromTo("num_parameters", num_parameters, 1, kMaxParameters);
  ValidateGuesses(*this, problems);
  ValidateCandidates(*this, problems);
  ValidateLevelLists(*this, problems);
  ValidateMarks(*this, problems);
}

bool Domain::IsBeforeAdded(const Eigen::VectorXd& point) const {
  return std::any_of(added.begin(), added.end(), [&](const AddedCoordinate& a) {
    return std::abs(point[a.coordinate] - a.at) <= surrogate::kSamePoint;
  });
}

std::vector<Eigen::Index> Domain::Asked() const {
  std::vector<Eigen::Index> asked;
  for (Eigen::Index k = 0; k < num_parameters; ++k) {
    if (!std::binary_search(nuisances.begin(), nuisances.end(), k)) asked.push_back(k);
  }
  return asked;
}

Eigen::VectorXd Domain::Snap(const Eigen::VectorXd& point) const {
  if (IsList()) {
    Eigen::Index nearest = 0;
    (candidates.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    return candidates.row(nearest);
  }
  Eigen::VectorXd snapped = point;
  for (Eigen::Index k = 0; k < point.size(); ++k) {
    if (!HasLevels(k)) continue;
    const std::vector<double>& allowed = levels[static_cast<std::size_t>(k)];
    snapped[k] = *std::min_element(allowed.begin(), allowed.end(), [&](double a, double b) {
      return std::abs(a - point[k]) < std::abs(b - point[k]);
    });
  }
  return snapped;
}

}  // namespace talus::optimizer
