#include "experiments/analysis/sensitivity/move_shifts.h"

namespace talus::analysis {
namespace {

// Those that ended well, one a row; NaN where a number is undefined.
Eigen::MatrixXd OutputsOf(const optimizer::ExperimentModel& model,
                          const std::vector<Simulated>& simulated) {
  Eigen::MatrixXd outputs(0, model.num_outputs());
  for (const Simulated& one : simulated) {
    if (!one.has_ended) continue;
    outputs.conservativeResize(outputs.rows() + 1, Eigen::NoChange);
    outputs.bottomRows(1) =
        model.OutputsOf(one.observation.field, one.observation.scalars).transpose();
  }
  return outputs;
}

}  // namespace

MoveShifts ShiftsBetween(const SensitivitySetting& setting, const optimizer::Posterior& posterior,
                         const SimulatedSet& without, const SimulatedSet& with) {
  MoveShifts found;
  for (std::size_t e = 0; e < with.size(); ++e) {
    const optimizer::ExperimentModel& model = posterior.models()[e];
    if (with[e].empty()) {
      const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.num_outputs());
      found.shifts.push_back({.mean = none, .variance = none});
      continue;
    }
    const Eigen::MatrixXd moved = OutputsOf(model, with[e]);
    const Eigen::MatrixXd base = OutputsOf(model, without[e]);
    if (moved.rows() == 0 || base.rows() == 0) {
      found.why_not = "none of its simulations of \"" + NameOf(setting.view, e) + "\" succeeded";
      return found;
    }
    found.shifts.push_back(ShiftOf(moved, base, model.NoiseAt(setting.scale_factor)));
    if (!found.shifts.back().is_known.any()) {
      found.why_not = "none of its simulations of \"" + NameOf(setting.view, e) +
                      "\" shows anything of what was measured there";
      return found;
    }
  }
  return found;
}

std::vector<ShiftField> Everywhere(const Eigen::VectorXd& point, const std::vector<Shift>& shifts) {
  std::vector<ShiftField> fields(shifts.size());
  for (std::size_t e = 0; e < shifts.size(); ++e) fields[e].Add(point, shifts[e]);
  return fields;
}

const std::string& NameOf(const campaign::JointView& view, std::size_t answered) {
  return view.NameOf(view.Answered()[answered]);
}

}  // namespace talus::analysis
