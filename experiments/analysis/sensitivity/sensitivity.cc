#include "experiments/analysis/sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/not_known.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/analysis/sensitivity/follow.h"
#include "experiments/analysis/sensitivity/shift.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/fit.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/trials/engines/template_folder.h"

namespace talus::analysis {

bool AnswerShift::Exceeds() const {
  return std::abs(half_ranges) > 1 && std::abs(half_ranges) > kSure * half_ranges_error;
}

bool AnswerShift::IsWithin() const {
  return std::abs(half_ranges) + kSure * half_ranges_error <= 1;
}

bool FixedMove::IsByChance() const {
  return !outputs.empty() && std::ranges::none_of(outputs, [](const OutputShift& output) {
    const double squares = std::pow(output.shift / output.noise, 2);
    return squares > 0 &&
           !talus::analysis::IsByChance(output.num_modes * squares, output.num_modes);
  });
}

bool FixedMove::Exceeds(const AnswerShift& shift) const { return shift.Exceeds() && !IsByChance(); }

bool FixedMove::Exceeds() const {
  return std::ranges::any_of(answer, [&](const AnswerShift& shift) { return Exceeds(shift); });
}

bool FixedMove::IsTold(const AnswerShift& shift) const {
  return Exceeds(shift) || shift.IsWithin();
}

bool FixedMove::IsTold() const {
  return !why_not.empty() || Exceeds() || std::ranges::all_of(answer, &AnswerShift::IsWithin);
}

double FixedMove::MostHalfRanges() const {
  double most = -1;
  for (const AnswerShift& shift : answer) most = std::max(most, std::abs(shift.half_ranges));
  return most;
}

bool FixedMove::FitsNoSet() const { return implausibility > campaign::kImplausible; }

bool SensitivityTable::FitsNoSet() const { return implausibility > campaign::kImplausible; }

namespace {

using campaign::JointView;

class Study {
 public:
  Study(const JointView& view, const SensitivityOptions& options)
      : view_(view),
        options_(options),
        foreteller_(ForetellerOf(view)),
        answer_(foreteller_.Recommend()),
        setting_{.view = view,
                 .point = answer_.point,
                 .scale_factor = FactorOf(view, options),
                 .parts = options.parts},
        stated_(StatedAnswerOf(view.space, answer_)),
        moves_(MovesOf(view, options, setting_)),
        tallies_(moves_.size()),
        core_time_(options.core_time - FirstCoreTime()),
        follower_(setting_, stated_, options_, core_time_) {}

  SensitivityTable Run() {
    SensitivityTable table = Head();
    for (const Move& move : moves_) table.moves.push_back(Unknown(move));
    for (int replicates = kFirstReplicates; replicates <= options_.most_replicates;
         replicates *= 2) {
      if (!Round(replicates, table)) break;
    }
    for (std::size_t i = 0; i < moves_.size(); ++i) follower_.Follow(moves_[i], table.moves[i]);
    CountAll(table);
    std::stable_sort(table.moves.begin(), table.moves.end(),
                     [](const FixedMove& a, const FixedMove& b) {
                       return a.MostHalfRanges() > b.MostHalfRanges();
                     });
    return table;
  }

  // Processor time of the first simulations of all moves [s].
  double FirstCoreTime() const {
    std::vector<MovedSet> sets{{.replicates = BaseReplicates(kFirstReplicates)}};
    for (const Move& move : moves_) {
      if (!Unknown(move).why_not.empty()) continue;  // it is not simulated
      sets.push_back({.move = &move, .replicates = kFirstReplicates});
    }
    return CoreTimeOf(setting_, sets);
  }

 private:
  static double FactorOf(const JointView& view, const SensitivityOptions& options) {
    const std::vector<double> levels = view.spec.coarse_graining.Levels();
    if (!options.scale_factor) return levels.front();
    if (std::ranges::find(levels, *options.scale_factor) != levels.end()) {
      return *options.scale_factor;
    }
    const auto text = [](double level) { return base::ShortNumber(level); };
    throw base::ConfigError("--scale-factor: the campaign has none of " +
                            text(*options.scale_factor) + ", but " +
                            base::Joined(levels, ", ", text));
  }

  // The move, as the first experiment has it that it changes.
  static Move MoveOfAny(const JointView& view, const std::vector<rigs::Case>& experiments,
                        const std::string& name, const std::string& value) {
    for (std::size_t i = 0; i + 1 < experiments.size(); ++i) {
      try {
        return MoveTo(view, experiments[i], name, value);
      } catch (const base::ConfigError&) {
        continue;  // another may have another value, or take it
      }
    }
    return MoveTo(view, experiments.back(), name, value);
  }

  static std::vector<Move> MovesOf(const JointView& view, const SensitivityOptions& options,
                                   const SensitivitySetting& setting) {
    std::vector<rigs::Case> experiments;
    for (const int e : view.Answered()) experiments.push_back(MovedCase(setting, {}, e, 0));
    if (options.moves.empty()) return UsualMoves(view, experiments);
    std::vector<Move> moves;
    for (const auto& [name, value] : options.moves) {
      moves.push_back(MoveOfAny(view, experiments, name, value));
    }
    return moves;
  }

  SensitivityTable Head() const {
    SensitivityTable table{.scale_factor = setting_.scale_factor, .last_trial = view_.LastEnded()};
    for (const optimizer::ExperimentStanding& standing : answer_.posterior->experiments) {
      table.implausibility = std::max(table.implausibility, standing.implausibility);
    }
    const std::vector<double> values = campaign::FreeValues(view_.space, answer_.point);
    const std::vector<int> free = view_.space.Free();
    for (std::size_t i = 0; i < free.size(); ++i) {
      const optimizer::Parameter& p = view_.space.parameters[static_cast<std::size_t>(free[i])];
      table.parameters.push_back({.name = p.name,
                                  .unit = campaign::UnitOf(p.name),
                                  .value = values[i],
                                  .low = p.ToNative(answer_.credible[i].low),
                                  .high = p.ToNative(answer_.credible[i].high)});
    }
    return table;
  }

  // Another engine is asked only for what its templates take.
  bool IsTaken(const Move& move) const {
    const campaign::EngineOptions& engine = view_.spec.engine;
    if (engine.kind != campaign::EngineKind::kCommand) return true;
    const trials::TemplateFolder templates(*engine.command.templates);
    return std::ranges::any_of(move.placeholders, [&](const std::string& name) {
      return templates.Uses(engine.command, name);
    });
  }

  FixedMove Unknown(const Move& move) const {
    FixedMove unknown{.name = move.name, .from = move.from, .to = move.to};
    if (!IsTaken(move)) {
      unknown.why_not = "the engine's templates do not take it";
      return unknown;
    }
    for (const int e : view_.Answered()) {
      if (unknown.why_not.empty()) {
        unknown.why_not = WhyNotMoved(move, MovedCase(setting_, {}, e, 0));
      }
    }
    return unknown;
  }

  // Simulates and judges what is not told yet; whether there was anything.
  bool Round(int replicates, SensitivityTable& table) {
    std::vector<MovedSet> sets{{.replicates = BaseReplicates(replicates)}};
    std::string names;
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      if (table.moves[i].replicates > 0 && table.moves[i].IsTold()) continue;
      if (!table.moves[i].why_not.empty()) continue;
      sets.push_back({.move = &moves_[i], .replicates = replicates});
      names += (names.empty() ? "" : ", ") + moves_[i].name;
    }
    if (sets.size() == 1) return false;
    if (replicates > kFirstReplicates) {
      const double takes = CoreTimeOf(setting_, sets) / 2;  // half of them have been made
      if (takes > core_time_) return false;
      core_time_ -= takes;
    }
    if (options_.tell) {
      options_.tell(names + " moved, " + std::to_string(replicates) +
                    " times in each experiment: " + WorkText(setting_, sets));
    }
    RunMoved(setting_, sets);
    ReadBase(sets.front());
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      const auto set =
          std::ranges::find_if(sets, [&](const MovedSet& s) { return s.move == &moves_[i]; });
      if (set != sets.end()) Judge(*set, tallies_[i], table.moves[i]);
    }
    return true;
  }

  void ReadBase(const MovedSet& set) {
    base_ = ReadSet(setting_, set);
    for (std::size_t e = 0; e < base_.size(); ++e) {
      if (std::ranges::any_of(base_[e], &Simulated::has_ended)) continue;
      throw base::Error("none of the simulations of \"" + NameOf(view_, e) +
                        "\" at the recommended set succeeded; see " +
                        SensitivityFolder(view_.folder.root).string());
    }
  }

  void Judge(const MovedSet& set, Tally& tally, FixedMove& move) {
    const SimulatedSet moved = ReadSet(setting_, set);
    tally = {};
    tally.Add(moved);
    move.replicates = set.replicates;
    move.num_failed = tally.num_failed;
    move.outputs.clear();
    const MoveShifts found = ShiftsBetween(setting_, foreteller_.posterior(), base_, moved);
    move.why_not = found.why_not;
    if (!found.why_not.empty()) return;
    for (std::size_t e = 0; e < base_.size(); ++e) {
      if (!moved[e].empty()) AddOutputs(e, found.shifts[e], move);
    }
    stated_.Compare(foreteller_.With(Everywhere(setting_.point, found.shifts)), move);
  }

  void AddOutputs(std::size_t e, const Shift& shift, FixedMove& move) {
    const optimizer::ExperimentModel& model = foreteller_.posterior().models()[e];
    const Eigen::VectorXd variance = model.NoiseAt(setting_.scale_factor);
    const auto& scalars = view_.references[static_cast<std::size_t>(view_.Answered()[e])].scalars();
    const Eigen::Index num_modes = variance.size() - static_cast<Eigen::Index>(scalars.size());
    if (num_modes > 0) {
      const Eigen::ArrayXd noise = variance.head(num_modes).array();
      move.outputs.push_back(
          {.experiment = NameOf(view_, e),
           .output = "image",
           .shift = std::sqrt((shift.mean.head(num_modes).array().square() / noise).mean()),
           .noise = std::sqrt((shift.variance.head(num_modes).array() / noise).mean()),
           .num_modes = static_cast<int>(num_modes)});
    }
    for (std::size_t s = 0; s < scalars.size(); ++s) {
      const Eigen::Index k = num_modes + static_cast<Eigen::Index>(s);
      const double known = shift.is_known[k] ? 1 : base::kNotKnown;
      move.outputs.push_back({.experiment = NameOf(view_, e),
                              .output = scalars[s].name,
                              .shift = known * shift.mean[k] / std::sqrt(variance[k]),
                              .noise = known * std::sqrt(shift.variance[k] / variance[k]),
                              .num_modes = 1});
    }
  }

  void CountAll(SensitivityTable& table) const {
    Tally base;
    base.Add(base_);
    std::vector<Tally> all = tallies_;
    all.insert(all.end(), {base, follower_.tally()});
    for (const Tally& tally : all) {
      table.num_simulations += tally.num_simulations;
      table.core_time += tally.core_time;
    }
  }

  const JointView& view_;
  const SensitivityOptions& options_;
  Foreteller foreteller_;
  optimizer::Answer answer_;
  SensitivitySetting setting_;
  StatedAnswer stated_;
  std::vector<Move> moves_;
  std::vector<Tally> tallies_;  // of each move at the recommended set
  double core_time_;            // left after the first simulations [s]
  Follower follower_;
  SimulatedSet base_{};  // as recommended
};

}  // namespace

SensitivityTable FindSensitivity(const JointView& view, const SensitivityOptions& options) {
  Study study(view, options);
  const std::filesystem::path folder = SensitivityFolder(view.folder.root);
  std::filesystem::create_directories(folder);
  const campaign::CampaignLock lock(folder);  // its simulations are one process's at a time
  return study.Run();
}

double FirstCoreTime(const JointView& view, const SensitivityOptions& options) {
  return Study(view, options).FirstCoreTime();
}

}  // namespace talus::analysis
