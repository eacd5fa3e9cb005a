// How much powder the heap test needs: NEBP over mass and day.
//
// The rule: the smallest mass whose heap is
//   formed      it covers the plate (its base is at least 97 % of the plate wide in every run),
//               and no larger mass has a mean NEBP more than 3 % higher: more powder only falls
//               off;
//   repeatable  at least two runs, the standard deviation of their NEBP at most 5 % of its mean,
//               and the means of its days differ by at most 5 %.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "imaging/color_image.h"
#include "imaging/heap/profile.h"

namespace talus::imaging {

struct MassRule {
  double least_base = 0.97;          // base width / plate diameter [-], in (0, 1]
  double largest_gain = 0.03;        // of NEBP by a larger mass [-], >= 0
  double largest_sd = 0.05;          // standard deviation / mean of NEBP over runs [-], >= 0
  double largest_day_change = 0.05;  // range of the days' means / mean [-], >= 0
};

// One run at one mass.
struct MassRun {
  double mass = 0;  // [kg]
  std::string day;
  std::string run;
  double nebp_mm2 = 0;    // [mm²]: photographs of another scale can be compared
  double base_share = 0;  // base width / plate diameter [-]
};

struct DayMean {
  std::string day;
  int num_runs = 0;
  double mean_mm2 = 0;
};

struct MassRow {
  double mass = 0;  // [kg]
  int num_runs = 0;
  double mean_mm2 = 0;
  double sd_mm2 = 0;  // over all its runs; 0 for one
  double least_base = 0;
  std::vector<DayMean> days;
  bool formed = false;
  bool repeatable = false;
  std::string remark;  // why it is not formed or not repeatable, in words
};

struct MassStudy {
  std::vector<MassRow> rows;     // by mass
  std::optional<double> chosen;  // [kg]; none when no mass keeps the rule
};

MassStudy StudyMass(std::span<const MassRun> runs, const MassRule& rule = {});

std::string RuleText(const MassRule& rule);

// Base width / plate diameter of a run's profile, at its half-intensity outline.
double BaseShare(const Profile& profile);

// NEBP over mass: every run, by day, the means with their standard deviations, the chosen mass.
ColorImage DrawMassStudy(std::span<const MassRun> runs, const MassStudy& study);

}  // namespace talus::imaging
