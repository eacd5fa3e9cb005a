#include "experiments/analysis/next/next_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/json/json_text.h"
#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/analysis/next/test_design.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::analysis {
namespace {

using base::ShortNumber;

// A range's width as people read it: "0.12", or "× 3" of a logarithmic one.
std::string WidthText(const NextTable& table, std::size_t parameter, double width) {
  const journal::ParameterRecord& p = table.parameters[parameter];
  if (table.scales[parameter] == optimizer::Scale::kLog) {
    return "× " + base::ShortNumber(std::pow(p.high / p.low, width), 2);
  }
  return base::ShortNumber(width * (p.high - p.low), 2);
}

std::string SetText(const std::vector<double>& values) {
  return "(" + base::Joined(values, ", ", [](double v) { return ShortNumber(v); }) + ")";
}

// Seen from the campaign's folder, which may be moved.
std::filesystem::path PictureName(const NextCandidate& c) {
  return c.picture.parent_path().filename() / c.picture.filename();
}

std::string ApartText(const NextCandidate& c) {
  std::string text =
      "         tells apart best " + SetText(c.apart[0]) + " and " + SetText(c.apart[1]);
  for (const ToldApart& number : c.numbers) {
    text += "; " + rigs::SpokenName(number.metric) + " " +
            rigs::ShownNumber(number.metric, number.first) + " and " +
            rigs::ShownNumber(number.metric, number.second);
  }
  if (!c.picture.empty()) text += ": " + std::filesystem::proximate(c.picture).string();
  return text + "\n";
}

std::string CostText(const NextCandidate& c) {
  if (c.num_simulations == 0) return "no simulations";
  std::string text = base::Counted(c.num_simulations, "simulation") + ", ";
  if (c.num_made > 0) {
    text += std::to_string(c.num_made) + " of them made in " +
            base::DurationText(c.core_time_made) +
            (c.num_failed > 0 ? ", " + std::to_string(c.num_failed) + " failed" : "") + ", ";
  }
  return text + base::DurationText(c.core_time) + " of core time";
}

// ", which depends on restitution, mass": what it was discounted for.
std::string DependsText(const NextCandidate& c) {
  if (c.unknowns.empty()) return "";
  return ", which depends on " + base::Joined(c.unknowns, ", ", &NextUnknown::name);
}

const char* KindName(NextKind kind) {
  switch (kind) {
    case NextKind::kMoreRuns:
      return "more_runs";
    case NextKind::kMoreSimulations:
      return "more_simulations";
    case NextKind::kFinerGrains:
      return "finer_grains";
    case NextKind::kNumber:
      return "number";
    case NextKind::kDirect:
      return "direct";
    case NextKind::kTest:
      return "test";
  }
  return "";
}

// Widths in the goal's unit, "± 0.012".
std::string GoalWidthText(const NextGoal& goal, double half_width) {
  return "± " + rigs::ShownNumber(goal.number, half_width, 2);
}

std::string GoalText(const NextGoal& goal) {
  const rigs::ObservableInfo* known = rigs::FindObservable(goal.number);
  std::string text =
      "goal: " + (known == nullptr ? goal.number : known->key) + " of " + goal.process +
      ", which the parameters leave open to " + GoalWidthText(goal, goal.half_width) +
      " (90 %), by " + base::Counted(goal.num_draws, "draw") + " in " +
      base::Counted(goal.num_runs, "run") + "; a surrogate over them, for scale factor " +
      ShortNumber(goal.scale_factor) + ", is off by " +
      rigs::ShownNumber(goal.number, goal.left_out_error, 2) + " at a draw left out\n";
  if (!(goal.half_width > goal.left_out_error)) {
    text +=
        "  note: that is no more than the surrogate's error: any set that fits will do for this "
        "process\n";
  }
  return text;
}

// It cannot be simulated; `what` says why.
bool IsImpossible(const NextCandidate& c) {
  return c.kind == NextKind::kTest && c.num_simulations == 0;
}

// Simulations of its design that are still to be made tell what it would teach.
bool NeedsSimulations(const NextCandidate& c) {
  return c.kind == NextKind::kTest && !c.learning && !IsImpossible(c) && c.num_made < kDesignSize;
}

// "   18 %", "   <1 %": as wide for every share.
std::string ShareText(double share) {
  const std::string percent = share < 0.01 ? "<1" : std::to_string(std::lround(100 * share));
  return std::string(5 - percent.size(), ' ') + percent + " %";
}

std::string CandidateText(const NextTable& table, const NextCandidate& c) {
  if (IsImpossible(c)) return "     -   " + c.name + ": " + c.what + "\n";
  const std::string step = "  " + c.name + ": " + c.what + "; " + CostText(c) + "\n";
  if (!c.learning) return (NeedsSimulations(c) ? "     ? " : "     - ") + step;
  return ShareText(c.remaining) + step + "         expected to leave " +
         (table.goal ? GoalWidthText(*table.goal, c.learning->goal_half_width) + " of the goal, "
                     : "") +
         WidthsText(table, c.learning->width) + " (" + ShortNumber(c.learning->bits, 2) +
         " bits)\n" + (c.apart.empty() ? "" : ApartText(c));
}

// "the cheapest, rough plate, takes about 32 s of core time (`talus next DIR --simulate --budget
// "60 s"`": why tests are not simulated, without its closing bracket. "" where no test can be.
std::string CheapestText(const NextTable& table) {
  const NextCandidate* cheapest = nullptr;
  for (const NextCandidate& c : table.candidates) {
    if (c.kind != NextKind::kTest || !(c.core_time_to_judge > 0)) continue;
    if (cheapest == nullptr || c.core_time_to_judge < cheapest->core_time_to_judge) cheapest = &c;
  }
  if (cheapest == nullptr) return "";
  // A whole half minute more, so that an estimate that is a little short still pays for it.
  const double budget = 30 * std::ceil(1.2 * cheapest->core_time_to_judge / 30);
  return "the cheapest, " + cheapest->name + ", takes about " +
         base::DurationText(cheapest->core_time_to_judge) + " of core time (`talus next DIR" +
         table.asked + " --simulate --budget \"" + ShortNumber(budget) + " s\"`";
}

// Says what would tell the candidates that stand as "?".
std::string UnknownText(const NextTable& table) {
  const std::string cheapest = table.has_simulated ? CheapestText(table) : "";
  if (cheapest.empty()) {
    return "?: `talus next DIR" + table.asked +
           " --simulate` runs the few simulations that tell what a test would teach, `--budget` "
           "says in how much core time\n";
  }
  return "?: the core time was too short for it; " + cheapest + ")\n";
}

nlohmann::ordered_json WidthsJson(const NextTable& table, const Eigen::VectorXd& width) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < table.parameters.size(); ++i) {
    json[table.parameters[i].name] = width[static_cast<Eigen::Index>(i)];
  }
  return json;
}

// null where what it teaches is not known.
void AddLearning(const NextTable& table, const NextCandidate& c, nlohmann::ordered_json& json) {
  for (const char* key : {"remaining", "bits", "width_90"}) json[key] = nullptr;
  if (table.goal) json["goal_half_width_90"] = nullptr;
  if (!c.learning) return;
  json["remaining"] = c.remaining;
  json["bits"] = c.learning->bits;
  json["width_90"] = WidthsJson(table, c.learning->width);
  if (table.goal) json["goal_half_width_90"] = c.learning->goal_half_width;
}

nlohmann::ordered_json CandidateJson(const NextTable& table, const NextCandidate& c) {
  nlohmann::ordered_json json{{"kind", KindName(c.kind)},
                              {"name", c.name},
                              {"what", c.what},
                              {"num_simulations", c.num_simulations},
                              {"core_time_s", c.core_time},
                              {"num_made", c.num_made},
                              {"num_failed", c.num_failed},
                              {"core_time_made_s", c.core_time_made},
                              {"needs_simulations", NeedsSimulations(c)}};
  AddLearning(table, c, json);
  if (c.bits_if_known) json["bits_if_known"] = *c.bits_if_known;
  for (const NextUnknown& unknown : c.unknowns) {
    json["depends_on"].push_back({{"name", unknown.name},
                                  {"from", unknown.from},
                                  {"to", unknown.to},
                                  {"shift_in_errors", unknown.shift}});
  }
  if (!c.apart.empty()) json["told_apart"] = c.apart;
  for (const ToldApart& number : c.numbers) {
    json["told_apart_by"].push_back(
        {{"name", number.metric}, {"values", {number.first, number.second}}});
  }
  if (!c.picture.empty()) json["picture"] = PictureName(c).string();
  return json;
}

}  // namespace

std::string WidthsText(const NextTable& table, const Eigen::VectorXd& width) {
  std::string text;
  for (std::size_t i = 0; i < table.parameters.size(); ++i) {
    text += (i == 0 ? "" : ", ") + table.parameters[i].name + " " +
            WidthText(table, i, width[static_cast<Eigen::Index>(i)]);
  }
  return text;
}

std::string SpreadText(const NextTable& table, const optimizer::ExpectedLearning& learning) {
  return base::JoinedUpTo(table.parameters.size(), ", ", [&](std::size_t i) {
    const auto at = static_cast<Eigen::Index>(i);
    return table.parameters[i].name + " " + WidthText(table, i, learning.width[at]) + " (" +
           WidthText(table, i, learning.narrow[at]) + " … " +
           WidthText(table, i, learning.wide[at]) + ")";
  });
}

std::string NextText(const NextTable& table) {
  std::string text = table.goal ? GoalText(*table.goal) : "";
  text += "width of the joint 90 % ranges now: " + WidthsText(table, table.width) + "\n";
  if (table.simulate_first > 0) {
    text += "first: more simulations, as the campaign's warnings ask (`talus resume DIR " +
            ("--add-simulations " + std::to_string(table.simulate_first)) + "`)\n";
  }
  text += std::string("what each step is expected to leave of ") +
          (table.goal ? "the goal's width" : "their volume") + "\n";
  bool unknown = false;
  for (const NextCandidate& c : table.candidates) {
    text += CandidateText(table, c);
    unknown |= NeedsSimulations(c);
  }
  return text + (unknown ? UnknownText(table) : "");
}

std::string NextSummary(const NextTable& table) {
  constexpr int kMost = 3;
  std::string text;
  int shown = 0;
  for (const NextCandidate& c : table.candidates) {
    if (c.kind != NextKind::kTest || !c.learning || shown == kMost) continue;
    text += (shown++ == 0 ? "  further tests     " : "                    ") + c.name +
            DependsText(c) + ": expected to leave " + WidthsText(table, c.learning->width) + "\n";
  }
  if (shown == 0) {
    const std::string cheapest = CheapestText(table);
    if (cheapest.empty()) return "";
    return "  further tests     none could be simulated in that time: " + cheapest +
           ", or a larger next.share in the spec)\n";
  }
  return text + "                    (width of the joint 90 % ranges now: " +
         WidthsText(table, table.width) + "; `talus next DIR` lists all)\n";
}

std::string NextJson(const NextTable& table) {
  nlohmann::ordered_json json{{"after_trial", table.last_trial},
                              {"asked", table.asked},
                              {"simulate_first", table.simulate_first},
                              {"width_90", WidthsJson(table, table.width)}};
  if (table.goal) {
    json["goal"] = {
        {"process", table.goal->process},           {"observable", table.goal->number},
        {"half_width_90", table.goal->half_width},  {"left_out_error", table.goal->left_out_error},
        {"scale_factor", table.goal->scale_factor}, {"num_draws", table.goal->num_draws},
        {"num_runs", table.goal->num_runs},         {"core_time_s", table.goal->core_time}};
  }
  json["candidates"] = nlohmann::ordered_json::array();
  for (const NextCandidate& c : table.candidates) {
    json["candidates"].push_back(CandidateJson(table, c));
  }
  return base::JsonText(json, 2) + "\n";
}

}  // namespace talus::analysis
