// A prediction on the terminal and as a table.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/predict/prediction.h"
#include "experiments/journal/records.h"

namespace talus::analysis {

std::string PredictionText(const Prediction& prediction,
                           const std::vector<journal::ParameterRecord>& parameters);

// What people call a number: "angle".
std::string NumberTitle(const PredictedNumber& number);

// One line for a number: "43.8 deg, 90 % of runs in 42.9 … 44.6".
std::string NumberText(const PredictedNumber& number);

// "without a value in 2 runs: the drum carries the powder round"; empty where all have one.
std::string SilentText(const PredictedNumber& number);

// draws.csv: a draw a line, with its weight, its set and the mean of every number.
std::string DrawsCsv(const Prediction& prediction,
                     const std::vector<journal::ParameterRecord>& parameters);

}  // namespace talus::analysis
