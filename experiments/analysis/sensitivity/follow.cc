#include "experiments/analysis/sensitivity/follow.h"

#include <algorithm>

#include "base/text/counted.h"

namespace talus::analysis {
namespace {

constexpr int kMostFollowed = 6;
// Half ranges: a shift of the outputs is taken to be the same so far about the set that it was
// simulated at.
constexpr double kNear = 0.5;

// The recommended set, or another, without the move and with it.
MovedSet Without(const Move& move, const std::optional<Eigen::VectorXd>& point, int replicates) {
  if (!point) return {.replicates = BaseReplicates(replicates)};
  return {.beside = &move, .point = point, .replicates = replicates};
}

MovedSet With(const Move& move, const std::optional<Eigen::VectorXd>& point, int replicates) {
  return {.move = &move, .point = point, .replicates = replicates};
}

}  // namespace

void Follower::Follow(const Move& move, FixedMove& foretold) {
  if (!foretold.why_not.empty()) return;
  std::vector<Eigen::VectorXd> points{setting_.point};
  Eigen::VectorXd next = stated_.Shifted(foretold.answer);
  std::optional<Foreteller> informed;
  while (foretold.num_followed < kMostFollowed && IsFar(next, points, foretold)) {
    const std::vector<MovedSet> sets{Without(move, next, foretold.replicates),
                                     With(move, next, foretold.replicates)};
    core_time_ += CoreTimeOf(setting_, sets);
    if (core_time_ > options_.most_followed_core_time) {
      foretold.why_not_followed = "no more processor time is allowed";
      break;
    }
    if (!informed) informed.emplace(ForetellerOf(setting_.view));
    points.push_back(next);
    Simulate(move, sets, *informed);
    const std::vector<ShiftField> shifts = FieldsOf(move, points, informed->posterior(), foretold);
    if (shifts.empty()) break;
    ++foretold.num_followed;
    const Foretold anew = informed->With(shifts);
    next = anew.answer.point;
    stated_.Compare(anew, foretold);
  }
  foretold.moves_still = IsFar(next, points, foretold);
}

// From all that was simulated.
bool Follower::IsFar(const Eigen::VectorXd& next, const std::vector<Eigen::VectorXd>& points,
                     const FixedMove& foretold) const {
  return std::ranges::all_of(points, [&](const Eigen::VectorXd& at) {
    const Eigen::VectorXd half_ranges = (next - at).cwiseQuotient(stated_.half_ranges).cwiseAbs();
    for (std::size_t i = 0; i < foretold.answer.size(); ++i) {
      const double error = foretold.answer[i].half_ranges_error;
      if (half_ranges[static_cast<Eigen::Index>(i)] > std::max(kNear, kSure * error)) return true;
    }
    return false;
  });
}

// `sets`: without the move and with it.
void Follower::Simulate(const Move& move, const std::vector<MovedSet>& sets, Foreteller& informed) {
  if (options_.tell) {
    options_.tell(base::Counted(2 * sets.front().replicates, "simulation") +
                  " each at the answer foretold for " + move.name);
  }
  RunMoved(setting_, sets);
  const std::vector<int> answered = setting_.view.Answered();
  for (std::size_t e = 0; e < answered.size(); ++e) {
    if (!ActsOn(setting_, move, answered[e])) continue;
    informed.Tell(ObservationsOf(setting_, sets.front(), e));
    for (const MovedSet& set : sets) simulated_.push_back(OutputsOf(setting_, set, e));
  }
}

// In outputs of the posterior, from all simulations of the move at these sets, the first of which
// is the recommended one. Empty where a set has none that succeeded, which the move then says.
std::vector<ShiftField> Follower::FieldsOf(const Move& move,
                                           const std::vector<Eigen::VectorXd>& points,
                                           const optimizer::Posterior& posterior,
                                           FixedMove& foretold) const {
  const SensitivitySetting setting{.view = setting_.view,
                                   .posterior = posterior,
                                   .point = setting_.point,
                                   .scale_factor = setting_.scale_factor,
                                   .parts = setting_.parts};
  const std::vector<int> answered = setting.view.Answered();
  std::vector<ShiftField> fields(answered.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<Eigen::VectorXd> other = i > 0 ? std::optional(points[i]) : std::nullopt;
    std::vector<MovedOutputs> without(answered.size());
    for (std::size_t e = 0; e < answered.size(); ++e) {
      if (!ActsOn(setting, move, answered[e])) continue;
      without[e] = OutputsOf(setting, Without(move, other, foretold.replicates), e);
    }
    const MoveShifts found =
        ShiftsBetween(setting, without, With(move, other, foretold.replicates));
    foretold.why_not_followed = found.why_not;
    if (!found.why_not.empty()) return {};
    for (std::size_t e = 0; e < fields.size(); ++e) fields[e].Add(points[i], found.shifts[e]);
  }
  return fields;
}

}  // namespace talus::analysis
