#include "experiments/campaign/answer/answer.h"

#include <algorithm>

#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/plain_number.h"
#include "experiments/journal/objective.h"
#include "experiments/journal/record_json.h"

namespace talus::campaign {

std::string AnswerJson(const Answer& answer) {
  return base::JsonText(base::ToJson(answer), 2) + "\n";
}

Answer ParseAnswer(const std::string& text) {
  return journal::ParseRecord<Answer>(text, "the result");
}

const ResultStanding* StandingOf(const Answer& answer, std::string_view experiment) {
  if (!answer.posterior) return nullptr;
  const auto& all = answer.posterior->experiments;
  const auto found = std::ranges::find(all, experiment, &ResultStanding::name);
  return found == all.end() ? nullptr : &*found;
}

const ResultCandidate* ConfirmedSet(const Answer& answer) {
  const auto& all = answer.confirmed;
  return all.empty() || all.front().role != CandidateRole::kRecommended ? nullptr : &all.front();
}

const ResultConfirmed* ConfirmedOf(const Answer& answer, std::string_view experiment) {
  const ResultCandidate* set = ConfirmedSet(answer);
  if (set == nullptr) return nullptr;
  const auto& all = set->experiments;
  const auto found = std::ranges::find(all, experiment, &ResultConfirmed::name);
  return found == all.end() || found->num_trials == 0 ? nullptr : &*found;
}

Eigen::VectorXd UnitPoint(const Answer& answer, const std::vector<double>& values) {
  Eigen::VectorXd point(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    point[static_cast<Eigen::Index>(i)] = answer.parameters[i].Range().ToUnit(values[i]);
  }
  return point;
}

Eigen::VectorXd RecommendedPoint(const Answer& answer) {
  std::vector<double> values;
  for (const ResultParameter& p : answer.parameters) values.push_back(p.value);
  return UnitPoint(answer, values);
}

bool IsRecommended(const Answer& answer, const std::vector<double>& values) {
  constexpr double kSame = 1e-9;
  if (values.size() != answer.parameters.size()) return false;
  const Eigen::VectorXd off = UnitPoint(answer, values) - RecommendedPoint(answer);
  return off.lpNorm<Eigen::Infinity>() <= kSame;
}

bool MinimisesSad(const Answer& answer) {
  return answer.objective == journal::InfoOf(journal::Objective::kSad).ValueKey();
}

bool HasAlarm(const Answer& answer, std::initializer_list<AlarmKind> kinds) {
  return std::ranges::any_of(answer.warnings, [&](const Alarm& alarm) {
    return std::ranges::find(kinds, alarm.kind) != kinds.end();
  });
}

bool IsDoubt(AlarmKind kind) {
  return kind == AlarmKind::kImplausible || kind == AlarmKind::kDisagree ||
         kind == AlarmKind::kMisses || kind == AlarmKind::kSearchMisses ||
         kind == AlarmKind::kConfirmationFailed;
}

bool IsDoubtful(const Answer& answer) {
  return std::ranges::any_of(answer.warnings, [](const Alarm& a) { return IsDoubt(a.kind); });
}

bool AsksForSimulations(const Answer& answer) {
  return HasAlarm(answer, {AlarmKind::kSearchMisses, AlarmKind::kWorseThanPredicted,
                           AlarmKind::kWorseThanObserved, AlarmKind::kPoorModel,
                           AlarmKind::kExtrapolated, AlarmKind::kUnlearntScaleFactor});
}

std::string ImplausibilityText(const ResultStanding& standing) {
  constexpr double kMuch = 2;  // below that a reader who divides comes near
  std::string text = base::PlainNumber(standing.implausibility, 2);
  if (standing.caution < kMuch) return text;
  return text + ", with the prediction's ± counted " + base::PlainNumber(standing.caution, 2) +
         " times, as few simulations are at the smallest scale factor";
}

int MoreSimulations(const Answer& answer) {
  const int num_more = answer.unsettled ? answer.unsettled->num_more : 0;
  if (AsksForSimulations(answer)) return std::max(num_more, kMoreSimulations);  // as the alarms say
  return num_more > 0 ? num_more : kMoreSimulations;
}

}  // namespace talus::campaign
