// Where a strategy may look: the unit cube, less what constraints forbid; or a list of candidates,
// or levels of single parameters, within it. And what a posterior starts from there.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "base/problems.h"
#include "optimizer/space/prior.h"

namespace talus::optimizer {

inline constexpr int kMaxParameters = 6;

// A coordinate that is searched since some evaluations were made, all of these at one value.
struct AddedCoordinate {
  Eigen::Index coordinate = 0;
  double at = 0;
};

struct Domain {
  int num_parameters = 3;                     // 1 … kMaxParameters
  std::vector<Eigen::VectorXd> guesses = {};  // points to be evaluated first, unit cube
  std::function<bool(const Eigen::VectorXd&)> feasible = {};  // empty: the whole cube
  // The only points there are, one a row; empty: any point.
  Eigen::MatrixXd candidates = {};
  // The only values of a coordinate, ascending, one list a parameter; an empty list: any value. No
  // lists at all: any value of any parameter.
  std::vector<std::vector<double>> levels = {};
  Prior prior = {};
  std::vector<Eigen::Index> nuisances = {};  // coordinates that are not asked for, ascending
  std::vector<AddedCoordinate> added = {};

  // Sizes, and that all lies in the unit cube; `feasible` is not asked.
  void Validate(base::Problems& problems) const;

  bool Contains(const Eigen::VectorXd& point) const {
    return (point.array() >= 0).all() && (point.array() <= 1).all() &&
           (!feasible || feasible(point));
  }
  bool IsList() const { return candidates.rows() > 0; }
  bool IsContinuous() const { return !IsList() && levels.empty(); }
  bool HasLevels(Eigen::Index coordinate) const {
    return !levels.empty() && !levels[static_cast<std::size_t>(coordinate)].empty();
  }

  // Whether it is of the time before a coordinate was searched.
  bool IsBeforeAdded(const Eigen::VectorXd& point) const;
  std::vector<Eigen::Index> Asked() const;  // the coordinates that are no nuisances, ascending

  // The nearest candidate, or the point with each coordinate at its nearest level.
  Eigen::VectorXd Snap(const Eigen::VectorXd& point) const;
};

}  // namespace talus::optimizer
