// A comparison of batches as people read it: on the terminal, as a table, as a page.
#pragma once

#include <string>

#include "experiments/analysis/batches/batches.h"

namespace talus::analysis {

std::string BatchesText(const BatchComparison& comparison);
// "0.12", of a logarithmic parameter "× 1.3".
std::string ChangeText(const BatchParameter& parameter, double change);
std::string DifferenceText(const BatchNumber& number);      // "-5 ± 1.4 mg"
std::string BatchesCsv(const BatchComparison& comparison);  // a batch and parameter a line
// A parameter over the batches, for quality control: the first one's 90 % as a band, and dashed
// what would matter either way.
std::string BatchesSvg(const BatchComparison& comparison, const BatchParameter& parameter);
// All of it as one HTML page that opens offline.
std::string BatchesPage(const BatchComparison& comparison);

}  // namespace talus::analysis
