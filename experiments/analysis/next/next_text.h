// The table of what to do next, for people and for programs.
#pragma once

#include <string>

#include "experiments/analysis/next/next_table.h"

namespace talus::analysis {

std::string NextText(const NextTable& table);
// The tests that would teach most, for the end of a campaign; empty where none has been judged.
std::string NextSummary(const NextTable& table);
std::string NextJson(const NextTable& table);

}  // namespace talus::analysis
