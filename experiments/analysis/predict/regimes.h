// Whether a process shears the powder as the tests did that it was calibrated by.
//
//   I = γ̇ d √(ρ/P)                       inertial number, P and γ̇ as in rigs/phased/regime.h
//   Bo = F_po/(m g)                       Bond number, F_po the pull-off force of two grains
//   t_c γ̇,  t_c = 2.87 (m*²/(R* Y*² γ̇ d))^(1/5)     Hertz's contact duration over 1/γ̇
//
// d and ρ of the powder's own grains: where coarse ones were simulated, their I is divided by the
// scale factor, as γ̇ and P are those of the bulk.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/predict/prediction.h"
#include "experiments/rigs/case/case.h"
#include "experiments/rigs/phased/regime.h"

namespace talus::analysis {

// What our engine has left in the result of a bulk test; none where it sheared nothing, or where
// another engine or version has run it.
std::optional<rigs::Regime> RegimeIn(const std::filesystem::path& trial);

// Medians over runs of one case, one at least.
FlowRegime DescribeRegime(const std::string& name, const std::vector<rigs::Regime>& runs,
                          const rigs::Case& rig_case);

// The scale factor of a campaign (of one or more) that is nearest in ratio to that of the process:
// grains of another size are sheared otherwise, and by which power of their size differs from rig
// to rig.
double NearestScaleFactor(const std::vector<double>& of_campaign, double of_process);

// A line for people on each regime of the process that lies beyond all tests by a factor of 3 or
// more. "drum shears at an inertial number of 0.1, your tests at most at 0.003: …".
std::vector<std::string> RegimeWarnings(const std::vector<FlowRegime>& regimes);

}  // namespace talus::analysis
