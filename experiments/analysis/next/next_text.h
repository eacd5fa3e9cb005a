// The table of what to do next, for people and for programs.
#pragma once

#include <string>

#include "experiments/analysis/next/next_table.h"

namespace talus::analysis {

// "sliding_friction 0.12, surface_energy × 3": widths in the unit cube, as people read them.
std::string WidthsText(const NextTable& table, const Eigen::VectorXd& width);
// "sliding_friction 0.12 (0.05 … 0.3)": with what a tenth of the sets leave less of, and a tenth
// more.
std::string SpreadText(const NextTable& table, const optimizer::ExpectedLearning& learning);

std::string NextText(const NextTable& table);
// The tests that would teach most, for the end of a campaign; empty where none has been judged.
std::string NextSummary(const NextTable& table);
std::string NextJson(const NextTable& table);

}  // namespace talus::analysis
