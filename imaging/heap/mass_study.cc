#include "imaging/heap/mass_study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "imaging/heap/outline.h"

namespace talus::imaging {
namespace {

std::string Percent(double share) {
  std::ostringstream text;
  text.precision(3);
  text << 100 * share << " %";
  return text.str();
}

MassRow Summarise(std::span<const MassRun> runs) {
  MassRow row{
      .mass = runs.front().mass, .least_base = runs.front().base_share, .days = {}, .remark = {}};
  std::map<std::string, DayMean> days;
  for (const MassRun& run : runs) {
    row.num_runs += 1;
    row.mean_mm2 += run.nebp_mm2;
    row.least_base = std::min(row.least_base, run.base_share);
    DayMean& day = days.try_emplace(run.day, DayMean{.day = run.day}).first->second;
    day.num_runs += 1;
    day.mean_mm2 += run.nebp_mm2;
  }
  row.mean_mm2 /= row.num_runs;
  double squares = 0;
  for (const MassRun& run : runs) squares += std::pow(run.nebp_mm2 - row.mean_mm2, 2);
  if (row.num_runs > 1) row.sd_mm2 = std::sqrt(squares / (row.num_runs - 1));
  for (auto& [name, day] : days) {
    day.mean_mm2 /= day.num_runs;
    row.days.push_back(day);
  }
  return row;
}

double DayChange(const MassRow& row) {
  const auto [low, high] = std::minmax_element(
      row.days.begin(), row.days.end(),
      [](const DayMean& a, const DayMean& b) { return a.mean_mm2 < b.mean_mm2; });
  return (high->mean_mm2 - low->mean_mm2) / row.mean_mm2;
}

void Remark(MassRow& row, const std::string& text) {
  row.remark += (row.remark.empty() ? "" : "; ") + text;
}

void JudgeForm(MassRow& row, double largest_mean, const MassRule& rule) {
  row.formed = true;
  if (!(row.least_base >= rule.least_base)) {
    row.formed = false;
    Remark(row, "covers only " + Percent(row.least_base) + " of the plate");
  }
  const double gain = largest_mean / row.mean_mm2 - 1;
  if (!(gain <= rule.largest_gain)) {
    row.formed = false;
    Remark(row, "a larger mass has " + Percent(gain) + " more NEBP");
  }
}

void JudgeRepeatability(MassRow& row, const MassRule& rule) {
  row.repeatable = true;
  const auto fail = [&](const std::string& text) {
    row.repeatable = false;
    Remark(row, text);
  };
  if (row.num_runs < 2) fail("one run says nothing of repeatability");
  const double relative_sd = row.sd_mm2 / row.mean_mm2;
  if (!(relative_sd <= rule.largest_sd))
    fail("has a standard deviation of " + Percent(relative_sd));
  const double change = DayChange(row);
  if (!(change <= rule.largest_day_change)) fail("changes by " + Percent(change) + " between days");
}

}  // namespace

MassStudy StudyMass(std::span<const MassRun> runs, const MassRule& rule) {
  // By whole nanograms: 1.1 g and 1100 mg differ in the last bit.
  std::map<long long, std::vector<MassRun>> by_mass;
  for (const MassRun& run : runs) by_mass[std::llround(run.mass * 1e12)].push_back(run);
  MassStudy study;
  for (const auto& [mass, of_mass] : by_mass) study.rows.push_back(Summarise(of_mass));
  double largest_mean = 0;  // of this mass and the larger ones
  for (auto row = study.rows.rbegin(); row != study.rows.rend(); ++row) {
    largest_mean = std::max(largest_mean, row->mean_mm2);
    JudgeForm(*row, largest_mean, rule);
    JudgeRepeatability(*row, rule);
  }
  for (const MassRow& row : study.rows) {
    if (!study.chosen && row.formed && row.repeatable) study.chosen = row.mass;
  }
  return study;
}

std::string RuleText(const MassRule& rule) {
  return "the smallest mass whose heap is formed (base at least " + Percent(rule.least_base) +
         " of the plate wide in every run, and no larger mass has more than " +
         Percent(rule.largest_gain) +
         " more NEBP) and repeatable (two runs or more, standard deviation of NEBP at most " +
         Percent(rule.largest_sd) + " and its means by day differ by at most " +
         Percent(rule.largest_day_change) + ")";
}

double BaseShare(const Profile& profile) {
  const Outline outline = FindOutline(profile.image, profile.frame);
  double widest = 0;  // of the lowest rows: grains touch the plate in points
  const double lowest = 0.02 * profile.frame.plate_diameter / profile.frame.pixel_size;  // [px]
  for (const RowExtent& row : outline.rows) {
    if (row.height <= std::max(lowest, 2.0)) widest = std::max(widest, row.right - row.left);
  }
  return widest * profile.frame.pixel_size / profile.frame.plate_diameter;
}

}  // namespace talus::imaging
