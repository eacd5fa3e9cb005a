#include "experiments/analysis/sensitivity/follow.h"

#include <algorithm>
#include <optional>

namespace talus::analysis {
namespace {

constexpr int kMostFollowed = 6;
// Half ranges: a shift of the outputs is taken to be the same so far about the set that it was
// simulated at.
constexpr double kNear = 0.5;

}  // namespace

void Follower::Follow(const Move& move, FixedMove& foretold) {
  if (!foretold.why_not.empty()) return;
  const int replicates = foretold.replicates;
  std::vector<Place> places{{.point = setting_.point, .without = {}, .with = {}}};
  Eigen::VectorXd next = stated_.Shifted(foretold.answer);
  if (!IsFar(next, places, foretold)) return;
  places[0].without =
      ReadSet(setting_, {.beside = &move, .replicates = BaseReplicates(replicates)});
  places[0].with = ReadSet(setting_, {.move = &move, .replicates = replicates});
  std::optional<Foreteller> informed;
  while (foretold.num_followed < kMostFollowed && IsFar(next, places, foretold)) {
    const std::vector<MovedSet> sets{{.beside = &move, .point = next, .replicates = replicates},
                                     {.move = &move, .point = next, .replicates = replicates}};
    const double takes = CoreTimeOf(setting_, sets);
    if (takes > core_time_) {
      foretold.why_not_followed = "no more processor time is allowed";
      break;
    }
    core_time_ -= takes;
    places.push_back(Simulate(move, next, sets));
    if (!informed) informed.emplace(ForetellerOf(setting_.view));
    informed->Tell(places.back().without);
    const std::vector<ShiftField> shifts = FieldsOf(places, informed->posterior(), foretold);
    if (shifts.empty()) break;
    ++foretold.num_followed;
    const Foretold anew = informed->With(shifts);
    next = anew.answer.point;
    stated_.Compare(anew, foretold);
  }
  foretold.moves_still = IsFar(next, places, foretold);
}

// From all that was simulated.
bool Follower::IsFar(const Eigen::VectorXd& next, const std::vector<Place>& places,
                     const FixedMove& foretold) const {
  return std::ranges::all_of(places, [&](const Place& place) {
    const Eigen::VectorXd half_ranges =
        (next - place.point).cwiseQuotient(stated_.half_ranges).cwiseAbs();
    for (std::size_t i = 0; i < foretold.answer.size(); ++i) {
      const double error = foretold.answer[i].half_ranges_error;
      if (half_ranges[static_cast<Eigen::Index>(i)] > std::max(kNear, kSure * error)) return true;
    }
    return false;
  });
}

// `sets`: without the move and with it.
Follower::Place Follower::Simulate(const Move& move, const Eigen::VectorXd& point,
                                   const std::vector<MovedSet>& sets) {
  if (options_.tell) {
    options_.tell(move.name + " moved, at the answer foretold: " + WorkText(setting_, sets));
  }
  RunMoved(setting_, sets);
  Place place{.point = point,
              .without = ReadSet(setting_, sets.front()),
              .with = ReadSet(setting_, sets.back())};
  tally_.Add(place.without);
  tally_.Add(place.with);
  return place;
}

// In outputs of the posterior. Empty where a set has no simulation that succeeded, which the move
// then says.
std::vector<ShiftField> Follower::FieldsOf(const std::vector<Place>& places,
                                           const optimizer::Posterior& posterior,
                                           FixedMove& foretold) const {
  std::vector<ShiftField> fields(setting_.view.Answered().size());
  for (const Place& place : places) {
    const MoveShifts found = ShiftsBetween(setting_, posterior, place.without, place.with);
    foretold.why_not_followed = found.why_not;
    if (!found.why_not.empty()) return {};
    for (std::size_t e = 0; e < fields.size(); ++e) fields[e].Add(place.point, found.shifts[e]);
  }
  return fields;
}

}  // namespace talus::analysis
