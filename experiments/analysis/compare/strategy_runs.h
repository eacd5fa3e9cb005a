// Campaigns on one experiment held against each other: how many simulations each strategy needed.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/compare/evidence.h"

namespace talus::analysis {

struct StrategyRun {
  std::string campaign;      // folder
  std::string strategy;      // its kind
  std::vector<double> best;  // least objective after so many simulations + 1; kUndefined before any
  double core_hours = 0;     // of these simulations
};

// All by the objective of the first. The confirmation does not count. Throws ConfigError when a
// campaign is about another experiment or searches other parameters.
std::vector<StrategyRun> CompareStrategies(const std::vector<std::string>& campaigns,
                                           const std::vector<Evidence>& evidence);

// The best after 10, 20, 40, … simulations, and how many came within `margin` of the best of all.
std::string StrategiesText(const std::vector<StrategyRun>& runs, double margin);
std::string StrategiesCsv(const std::vector<StrategyRun>& runs);

}  // namespace talus::analysis
