#include "experiments/campaign/spec/plausible_stresses.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text/number_text.h"
#include "base/units.h"
#include "experiments/campaign/spec/known_number.h"
#include "experiments/rigs/shear_cell/yield_line.h"

namespace talus::campaign {
namespace {

using rigs::Observable;

// The shear over the normal stress: smooth beads have 0.2, and cohesion adds several normal
// stresses where these are low.
constexpr double kMostRatio = 20;
constexpr double kLeastRatio = 1 / kMostRatio;
// A cohesion with its error, over the least normal stress: no cell tells it from none.
constexpr double kNoCohesion = 5e-3;
constexpr double kFarOff = 10 * base::kDegree;  // of two angles, beyond their errors [rad]

// A shear stress that is given, with its normal stress.
struct Sheared {
  std::string key;
  std::size_t index = 0;  // in rig.stresses
  double normal = 0;      // [Pa]
  KnownNumber shear;
};

std::vector<Sheared> ShearedOf(const ExperimentSpec& e) {
  const std::vector<double>& stresses = e.rig->shear_cell.stresses;
  const std::optional<KnownNumber> given[] = {KnownOf<Observable::kShearStress1>(e.numbers),
                                              KnownOf<Observable::kShearStress2>(e.numbers),
                                              KnownOf<Observable::kShearStress3>(e.numbers)};
  std::vector<Sheared> all;
  for (std::size_t i = 0; i < std::min(std::size(given), stresses.size()); ++i) {
    if (!given[i] || !(stresses[i] > 0)) continue;
    all.push_back({"shear_stress_" + std::to_string(i + 1), i, stresses[i], *given[i]});
  }
  return all;
}

std::string Pascals(double stress) { return base::ShortNumber(stress) + " Pa"; }

// "in Pa, 0.00095 of its normal stress, 200 Pa (rig.stresses[0]): is it in kPa? write "0.19 kPa""
std::string SlipText(double stress, double ratio, const std::string& normal) {
  const std::string text = "in Pa, " + base::ShortNumber(ratio, 3) + " of " + normal;
  if (ratio > 1) return text + ": was kPa meant for one of the two? write its unit";
  return text + ": was kPa meant? write \"" + base::ShortNumber(stress) + " kPa\"";
}

void CheckRatios(const std::vector<Sheared>& all, const std::string& prefix,
                 base::Problems& problems) {
  for (const Sheared& one : all) {
    const double ratio = one.shear.value / one.normal;
    problems.Require(ratio >= kLeastRatio && ratio <= kMostRatio, prefix + one.key, one.shear.value,
                     SlipText(one.shear.value, ratio,
                              "its normal stress, " + Pascals(one.normal) + " (rig.stresses[" +
                                  std::to_string(one.index) + "])"));
  }
}

// One of 0.2 ± 0.01 Pa is of a cell that tells a millionth of its stresses.
void CheckCohesion(const ExperimentSpec& e, const std::string& prefix, base::Problems& problems) {
  const auto cohesion = KnownOf<Observable::kCohesion>(e.numbers);
  const std::vector<double>& stresses = e.rig->shear_cell.stresses;
  if (!cohesion || stresses.empty() || !(stresses.front() > 0)) return;
  const bool is_too_much = cohesion->value > kMostRatio * stresses.back();
  const double most = cohesion->value + kContradiction * cohesion->error;
  const bool is_too_exact = cohesion->value > 0 && most < kNoCohesion * stresses.front();
  const double normal = is_too_much ? stresses.back() : stresses.front();
  problems.Require(!is_too_much && !is_too_exact, prefix + "cohesion", cohesion->value,
                   SlipText(cohesion->value, cohesion->value / normal,
                            std::string("the ") + (is_too_much ? "largest" : "least") +
                                " normal stress, " + Pascals(normal) + " (rig.stresses)"));
}

// More pressure, more friction.
void CheckOrder(const std::vector<Sheared>& all, const std::string& prefix,
                base::Problems& problems) {
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Sheared& before = all[i - 1];
    const Sheared& here = all[i];
    const double error = std::hypot(before.shear.error, here.shear.error);
    problems.Require(here.shear.value + kContradiction * error >= before.shear.value,
                     prefix + here.key, here.shear.value,
                     "in Pa, is below " + before.key + ", " + Pascals(before.shear.value) +
                         ", while the normal stress rises from " + Pascals(before.normal) + " to " +
                         Pascals(here.normal) + ": give them in the order of rig.stresses");
  }
}

// Slope of the least-squares line as an angle [rad], with the error that the stresses' have on it:
// var(b) = Σ (xᵢ - x̄)² sᵢ²/(Σ (xᵢ - x̄)²)², and dφ = db/(1 + b²).
std::optional<KnownNumber> AngleOf(const std::vector<Sheared>& all) {
  std::vector<rigs::StressPoint> points;
  double mean = 0;
  for (const Sheared& one : all) {
    points.push_back({.normal = one.normal, .shear = one.shear.value});
    mean += one.normal / static_cast<double>(all.size());
  }
  const auto line = rigs::YieldLineOf(points);
  if (!line) return std::nullopt;
  double square = 0;
  double variance = 0;
  for (const Sheared& one : all) {
    const double away = one.normal - mean;
    square += away * away;
    variance += away * away * one.shear.error * one.shear.error;
  }
  return KnownNumber{.value = std::atan(line->slope),
                     .error = std::sqrt(variance) / square / (1 + line->slope * line->slope)};
}

void CheckAngle(const ExperimentSpec& e, const std::vector<Sheared>& all, const std::string& prefix,
                base::Problems& problems) {
  const auto stated = KnownOf<Observable::kFrictionAngle>(e.numbers);
  const auto line = AngleOf(all);
  if (!stated || !line) return;
  const double error = std::hypot(stated->error, line->error);
  const auto degrees = [](double angle) {
    return base::ShortNumber(angle / base::kDegree, 3) + " deg";
  };
  problems.Require(std::abs(stated->value - line->value) <= kFarOff + kContradiction * error,
                   prefix + "internal_friction_angle",
                   "is " + degrees(stated->value) +
                       ", but the line through the shear stresses "
                       "over rig.stresses rises by " +
                       degrees(line->value) + ": one of them is wrong");
}

}  // namespace

void CheckStresses(const ExperimentSpec& experiment, const std::string& prefix,
                   base::Problems& problems) {
  if (rigs::KindOf(experiment.rig) != rigs::RigKind::kShearCell) return;
  const std::size_t before = problems.size();
  const std::vector<Sheared> all = ShearedOf(experiment);
  CheckRatios(all, prefix, problems);
  CheckCohesion(experiment, prefix, problems);
  if (problems.size() > before) return;  // in one unit first
  CheckOrder(all, prefix, problems);
  CheckAngle(experiment, all, prefix, problems);
}

}  // namespace talus::campaign
