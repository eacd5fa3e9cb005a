#include "experiments/analysis/sensitivity/move_shifts.h"

namespace talus::analysis {

MoveShifts ShiftsBetween(const SensitivitySetting& setting,
                         const std::vector<MovedOutputs>& without, const MovedSet& with) {
  MoveShifts found;
  for (std::size_t e = 0; e < without.size(); ++e) {
    const optimizer::ExperimentModel& model = setting.posterior.models()[e];
    if (!ActsOn(setting, *with.move, setting.view.Answered()[e])) {
      const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.num_outputs());
      found.shifts.push_back({.mean = none, .variance = none});
      continue;
    }
    const MovedOutputs made = OutputsOf(setting, with, e);
    found.num_failed += made.num_failed;
    if (made.outputs.rows() == 0 || without[e].outputs.rows() == 0) {
      found.why_not = "none of its simulations of \"" + NameOf(setting.view, e) + "\" succeeded";
      return found;
    }
    found.shifts.push_back(
        ShiftOf(made.outputs, without[e].outputs, model.NoiseAt(setting.scale_factor)));
  }
  return found;
}

std::vector<ShiftField> Everywhere(const Eigen::VectorXd& point, const std::vector<Shift>& shifts) {
  std::vector<ShiftField> fields(shifts.size());
  for (std::size_t e = 0; e < shifts.size(); ++e) fields[e].Add(point, shifts[e]);
  return fields;
}

const std::string& NameOf(const campaign::JointView& view, std::size_t answered) {
  return view.record.experiments[static_cast<std::size_t>(view.Answered()[answered])].name;
}

}  // namespace talus::analysis
