#include "experiments/analysis/sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text/counted.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/analysis/sensitivity/fixed_point.h"
#include "experiments/analysis/sensitivity/moved_trials.h"
#include "experiments/analysis/sensitivity/shift.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/trials/engines/template_folder.h"
#include "optimizer/posterior/measured_shift.h"

namespace talus::analysis {

constexpr double kSure = 2;  // standard errors
// Half ranges: a shift of the outputs is taken to be the same so far about the set that it was
// simulated at.
constexpr double kNear = 0.5;

bool AnswerShift::Exceeds() const {
  return std::abs(half_ranges) > 1 && std::abs(half_ranges) > kSure * half_ranges_error;
}

bool AnswerShift::IsTold() const {
  return Exceeds() || std::abs(half_ranges) + kSure * half_ranges_error <= 1;
}

bool FixedMove::Exceeds() const { return std::ranges::any_of(answer, &AnswerShift::Exceeds); }

bool FixedMove::IsTold() const {
  return !why_not.empty() || Exceeds() || std::ranges::all_of(answer, &AnswerShift::IsTold);
}

double FixedMove::MostHalfRanges() const {
  double most = -1;
  for (const AnswerShift& shift : answer) most = std::max(most, std::abs(shift.half_ranges));
  return most;
}

namespace {

using campaign::JointView;

class Study {
 public:
  Study(const JointView& view, const SensitivityOptions& options)
      : view_(view),
        options_(options),
        strategy_(campaign::AnsweringStrategy(view)),
        answer_(strategy_->Recommend()),
        setting_{.view = view,
                 .posterior = strategy_->Model(),
                 .point = answer_.point,
                 .scale_factor = FactorOf(view, options),
                 .parts = options.parts},
        half_ranges_(HalfRanges(answer_)),
        moves_(MovesOf(view, options, MovedCase(setting_, {}, view.Answered().front(), 0))) {}

  SensitivityTable Run() {
    response_ = optimizer::ResponseToMeasured(setting_.posterior,
                                              strategy_->Sample().Draws(kDraws, view_.spec.seed));
    SensitivityTable table = Head();
    for (const Move& move : moves_) table.moves.push_back(Unknown(move));
    for (int replicates = kFirstReplicates; replicates <= options_.most_replicates;
         replicates *= 2) {
      if (!Round(replicates, table)) break;
    }
    for (std::size_t i = 0; i < moves_.size(); ++i) Follow(moves_[i], table.moves[i]);
    CountAll(table);
    std::stable_sort(table.moves.begin(), table.moves.end(),
                     [](const FixedMove& a, const FixedMove& b) {
                       return a.MostHalfRanges() > b.MostHalfRanges();
                     });
    return table;
  }

  const SensitivitySetting& setting() const { return setting_; }
  const std::vector<Move>& moves() const { return moves_; }
  // Common to all moves, so that more of them pay.
  static int BaseReplicates(int replicates) { return 2 * replicates; }

 private:
  static constexpr int kDraws = 1000;
  static constexpr int kMostFollowed = 2;

  static Eigen::VectorXd HalfRanges(const optimizer::Answer& answer) {
    Eigen::VectorXd half(answer.point.size());
    for (Eigen::Index k = 0; k < half.size(); ++k) {
      const optimizer::Range& range = answer.credible[static_cast<std::size_t>(k)];
      half[k] = (range.high - range.low) / 2;
    }
    return half;
  }

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

  static std::vector<Move> MovesOf(const JointView& view, const SensitivityOptions& options,
                                   const rigs::Case& rig_case) {
    if (options.moves.empty()) return UsualMoves(view, rig_case);
    std::vector<Move> moves;
    for (const auto& [name, value] : options.moves) {
      moves.push_back(MoveTo(view, rig_case, name, value));
    }
    return moves;
  }

  SensitivityTable Head() const {
    SensitivityTable table{.scale_factor = setting_.scale_factor};
    for (const journal::TrialRecord& trial : view_.trials) {
      if (trial.status != journal::TrialStatus::kRunning) table.last_trial = trial.id;
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
    if (options_.tell) {
      options_.tell(base::Counted(replicates, "simulation") + " each of " + names);
    }
    RunMoved(setting_, sets);
    ReadBase(sets.front());
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      const auto set =
          std::ranges::find_if(sets, [&](const MovedSet& s) { return s.move == &moves_[i]; });
      if (set != sets.end()) Judge(*set, table.moves[i]);
    }
    return true;
  }

  void ReadBase(const MovedSet& set) {
    base_.clear();
    for (std::size_t e = 0; e < view_.Answered().size(); ++e) {
      base_.push_back(OutputsOf(setting_, set, e));
      if (base_.back().outputs.rows() > 0) continue;
      throw base::Error("none of the simulations of \"" + NameOf(e) +
                        "\" at the recommended set succeeded; see " +
                        SensitivityFolder(view_.folder.root).string());
    }
  }

  const std::string& NameOf(std::size_t answered) const {
    const auto e = static_cast<std::size_t>(view_.Answered()[answered]);
    return view_.record.experiments[e].name;
  }

  void Judge(const MovedSet& set, FixedMove& move) const {
    move.replicates = set.replicates;
    move.num_failed = 0;
    move.outputs.clear();
    const std::optional<std::vector<Shift>> shifts =
        ShiftsBy(set, base_, move.num_failed, move.why_not);
    if (!shifts) return;
    for (std::size_t e = 0; e < base_.size(); ++e) {
      if (ActsOn(setting_, *set.move, view_.Answered()[e])) AddOutputs(e, (*shifts)[e], move);
    }
    move.answer = ShiftsOfAnswer(With(*shifts), *shifts);
  }

  // By experiment; none where one has no simulation that succeeded, which `why_not` then says.
  std::optional<std::vector<Shift>> ShiftsBy(const MovedSet& set,
                                             const std::vector<MovedOutputs>& base, int& num_failed,
                                             std::string& why_not) const {
    std::vector<Shift> shifts;
    for (std::size_t e = 0; e < base.size(); ++e) {
      const optimizer::ExperimentModel& model = setting_.posterior.models()[e];
      if (!ActsOn(setting_, *set.move, view_.Answered()[e])) {
        const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.num_outputs());
        shifts.push_back({.mean = none, .variance = none});
        continue;
      }
      const MovedOutputs made = OutputsOf(setting_, set, e);
      num_failed += made.num_failed;
      if (made.outputs.rows() == 0 || base[e].outputs.rows() == 0) {
        why_not = "none of its simulations of \"" + NameOf(e) + "\" succeeded";
        return std::nullopt;
      }
      shifts.push_back(
          ShiftOf(made.outputs, base[e].outputs, model.NoiseAt(setting_.scale_factor)));
    }
    return shifts;
  }

  void AddOutputs(std::size_t e, const Shift& shift, FixedMove& move) const {
    const optimizer::ExperimentModel& model = setting_.posterior.models()[e];
    const Eigen::VectorXd single = model.Predict(setting_.point.transpose()).single;
    const auto& scalars = view_.references[static_cast<std::size_t>(view_.Answered()[e])].scalars();
    const Eigen::Index num_modes = single.size() - static_cast<Eigen::Index>(scalars.size());
    if (num_modes > 0) {
      const Eigen::ArrayXd noise = single.head(num_modes).array();
      move.outputs.push_back(
          {.experiment = NameOf(e),
           .output = "image",
           .shift = std::sqrt((shift.mean.head(num_modes).array().square() / noise).mean()),
           .noise = std::sqrt((shift.variance.head(num_modes).array() / noise).mean())});
    }
    for (std::size_t s = 0; s < scalars.size(); ++s) {
      const Eigen::Index k = num_modes + static_cast<Eigen::Index>(s);
      move.outputs.push_back({.experiment = NameOf(e),
                              .output = scalars[s].name,
                              .shift = shift.mean[k] / std::sqrt(single[k]),
                              .noise = std::sqrt(shift.variance[k] / single[k])});
    }
  }

  // A shift depends on the set. Where the answer goes far, the shift is simulated anew at the
  // answer foretold, until it leads to where it was simulated.
  void Follow(const Move& move, FixedMove& foretold) {
    if (!foretold.why_not.empty()) return;
    FixedPoint fixed_point(half_ranges_);
    Eigen::VectorXd at = setting_.point;
    Eigen::VectorXd next = at;
    for (std::size_t i = 0; i < foretold.answer.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      next[k] += half_ranges_[k] * foretold.answer[i].half_ranges;
    }
    next = fixed_point.Next(at, next);
    while (foretold.num_followed < kMostFollowed && IsFar(next - at, foretold)) {
      at = next;
      const std::optional<std::vector<Shift>> shifts = ShiftsAt(at, move, foretold);
      // Nothing stands there: the shift at the last set is what is known.
      if (!shifts) return;
      ++foretold.num_followed;
      optimizer::AnswerIfMeasured answer = With(*shifts);
      next = fixed_point.Next(at, answer.point).cwiseMax(0).cwiseMin(1);
      answer.point = next;
      foretold.answer = ShiftsOfAnswer(answer, *shifts);
    }
  }

  bool IsFar(const Eigen::VectorXd& step, const FixedMove& foretold) const {
    const Eigen::VectorXd half_ranges = step.cwiseQuotient(half_ranges_).cwiseAbs();
    for (std::size_t i = 0; i < foretold.answer.size(); ++i) {
      if (half_ranges[static_cast<Eigen::Index>(i)] >
          std::max(kNear, kSure * foretold.answer[i].half_ranges_error)) {
        return true;
      }
    }
    return false;
  }

  std::optional<std::vector<Shift>> ShiftsAt(const Eigen::VectorXd& point, const Move& move,
                                             const FixedMove& foretold) {
    const MovedSet base{.beside = &move, .point = point, .replicates = foretold.replicates};
    const MovedSet moved{.move = &move, .point = point, .replicates = foretold.replicates};
    if (options_.tell) {
      options_.tell(base::Counted(2 * base.replicates, "simulation") +
                    " each at the answer foretold for " + move.name);
    }
    RunMoved(setting_, {base, moved});
    std::vector<MovedOutputs> without(base_.size());
    for (std::size_t e = 0; e < base_.size(); ++e) {
      if (!ActsOn(setting_, move, view_.Answered()[e])) continue;
      without[e] = OutputsOf(setting_, base, e);
      followed_.push_back(without[e]);
      followed_.push_back(OutputsOf(setting_, moved, e));
    }
    int num_failed = 0;
    std::string why_not;
    return ShiftsBy(moved, without, num_failed, why_not);
  }

  optimizer::AnswerIfMeasured With(const std::vector<Shift>& shifts) const {
    std::vector<Eigen::VectorXd> less;
    for (const Shift& shift : shifts) less.emplace_back(-shift.mean);
    return strategy_->IfMeasured(less);
  }

  std::vector<AnswerShift> ShiftsOfAnswer(const optimizer::AnswerIfMeasured& found,
                                          const std::vector<Shift>& shifts) const {
    Eigen::VectorXd variance(response_.cols());
    Eigen::Index left = 0;
    for (const Shift& shift : shifts) {
      variance.segment(left, shift.variance.size()) = shift.variance;
      left += shift.variance.size();
    }
    const Eigen::VectorXd error = (response_.cwiseAbs2() * variance).cwiseSqrt();
    const std::vector<int> free = view_.space.Free();
    std::vector<AnswerShift> answer;
    for (std::size_t i = 0; i < free.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const optimizer::Parameter& p = view_.space.parameters[static_cast<std::size_t>(free[i])];
      const double half = half_ranges_[k];
      answer.push_back({.parameter = p.name,
                        .from = p.ToNative(answer_.point[k]),
                        .to = p.ToNative(found.point[k]),
                        .standard_error = (p.ToNative(std::min(1.0, found.point[k] + error[k])) -
                                           p.ToNative(std::max(0.0, found.point[k] - error[k]))) /
                                          2,
                        .low = p.ToNative(found.credible[i].low),
                        .high = p.ToNative(found.credible[i].high),
                        .half_ranges = (found.point[k] - answer_.point[k]) / half,
                        .half_ranges_error = error[k] / half});
    }
    return answer;
  }

  void CountAll(SensitivityTable& table) const {
    const auto count = [&](const MovedOutputs& made) {
      table.num_simulations += static_cast<int>(made.outputs.rows()) + made.num_failed;
      table.core_time += made.core_time;
    };
    for (const MovedOutputs& made : base_) count(made);
    for (const MovedOutputs& made : followed_) count(made);
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      const MovedSet set{.move = &moves_[i], .replicates = table.moves[i].replicates};
      for (std::size_t e = 0; e < view_.Answered().size(); ++e) {
        if (ActsOn(setting_, moves_[i], view_.Answered()[e])) count(OutputsOf(setting_, set, e));
      }
    }
  }

  const JointView& view_;
  const SensitivityOptions& options_;
  std::unique_ptr<optimizer::PosteriorStrategy> strategy_;
  optimizer::Answer answer_;
  SensitivitySetting setting_;
  Eigen::VectorXd half_ranges_;  // of the stated ranges, unit cube
  std::vector<Move> moves_;
  Eigen::MatrixXd response_;
  std::vector<MovedOutputs> base_{};      // of the experiments, as recommended
  std::vector<MovedOutputs> followed_{};  // at answers foretold
};

}  // namespace

SensitivityTable FindSensitivity(const JointView& view, const SensitivityOptions& options) {
  return Study(view, options).Run();
}

double FirstCoreTime(const JointView& view, const SensitivityOptions& options) {
  const Study study(view, options);
  campaign::CoreTime core_time(view.spec);
  core_time.Of(view.trials);
  double seconds = 0;
  for (const int e : view.Answered()) {
    int count = Study::BaseReplicates(kFirstReplicates);
    for (const Move& move : study.moves()) {
      if (ActsOn(study.setting(), move, e)) count += kFirstReplicates;
    }
    seconds += count * core_time.OfOne(e, study.setting().scale_factor);
  }
  return seconds;
}

}  // namespace talus::analysis
