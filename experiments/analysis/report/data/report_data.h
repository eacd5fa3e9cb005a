// Everything that a report shows, worked out once: the page, the figures and the tables are only
// ways to write it down.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/not_known.h"
#include "experiments/analysis/compare/compare.h"
#include "experiments/analysis/compare/profile_pictures.h"
#include "experiments/analysis/report/views/folder_views.h"
#include "experiments/analysis/report/views/heap_views.h"
#include "experiments/analysis/report/views/model_views.h"
#include "experiments/analysis/report/views/next_steps.h"
#include "experiments/analysis/report/views/next_table_view.h"
#include "experiments/analysis/report/views/width_views.h"

namespace talus::analysis {

// The outline of a profile at half intensity.
struct OutlineCurve {
  std::string title;
  std::vector<double> x;       // from the plate's centre [m]
  std::vector<double> height;  // above the plate [m]
  bool is_experiment = false;  // of the AEHP, not of a trial
};

// A profile's metrics, in the order of Evidence::metrics.
struct MeasuredProfile {
  std::string title;  // "trial 12"
  std::string note;   // "best by SAD"
  std::vector<double> metrics;
};

// How far the answer was known after so many trials.
struct RegionPoint {
  std::int64_t num_trials = 0;     // that have ended
  double share = base::kNotKnown;  // RegionShare then
};

struct ReportData {
  Evidence evidence;
  std::vector<ObjectiveFinding> findings;
  std::size_t objective = 0;  // index into findings: the campaign's own
  std::vector<ModelSlice> slices;
  std::vector<Marginal> marginals;  // of the posterior; none without one
  std::vector<PairMap> pairs;
  std::vector<RepresentativeView> representative;  // of the recommended set and its equals
  std::vector<WidthView> widths;
  std::vector<NextStep> next_steps;
  std::optional<NextTableView> next_table;     // none where `talus next` has not been run
  std::vector<PredictionView> predictions;     // of `talus predict`
  std::optional<SensitivityView> sensitivity;  // none where `talus sensitivity` has not been run
  std::vector<RegionPoint> region_history;     // of a page that is watched
  PhotoOverlay overlay;
  std::vector<OutlineCurve> overlay_outlines;  // the experiment's, the trial's
  std::optional<FilmView> film;
  std::vector<MeasuredProfile> measures;
  std::vector<OutlineCurve> outlines;  // the experiment's first
  std::vector<Picture> pictures;
  LeftOut left_out;                // of all experiments
  std::vector<ReportData> others;  // of a campaign's further experiments, with what differs there

  const ObjectiveFinding& own() const { return findings[objective]; }
};

// `others`: the same campaign with its further experiments shown.
ReportData MakeReportData(Evidence evidence, std::vector<Evidence> others = {});

// The pair of parameters that says most: the one that the answer says to change together, or the
// one whose region is smallest; an index into data.pairs, nothing where there are none.
std::optional<std::size_t> ClosestPair(const ReportData& data);

// Share of the searched plane that the joint 90 % region takes of the two parameters that it ties
// closest; undefined without a posterior.
double RegionShare(const ReportData& data);

// Adds where the answer stands now, once for each number of trials, of all experiments.
void Follow(const ReportData& data, std::vector<RegionPoint>& history);

}  // namespace talus::analysis
