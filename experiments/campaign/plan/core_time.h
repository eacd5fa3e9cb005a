// What trials cost in processor time: as measured once they have ended, as estimated before.
#pragma once

#include <span>
#include <vector>

#include "experiments/campaign/plan/usual_cost.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

// Processor time of a trial that has ended [core seconds]; 0 where it is not known.
double MeasuredCoreTime(const journal::TrialRecord& trial, int num_cores);
// That of a campaign's trial. Another engine's ranks that `srun` starts are no children of the
// job's script, which cannot measure them: in Slurm they count as long as the job had its cores.
double MeasuredCoreTime(const journal::TrialRecord& trial, const CampaignSpec& spec);
// That of all that have ended in the campaign, without what it took over from others.
double MeasuredCoreTime(std::span<const journal::TrialRecord> trials, const CampaignSpec& spec);

class CoreTime {
 public:
  explicit CoreTime(const CampaignSpec& spec) : spec_(spec), usual_(spec) {}

  // [core seconds] of all these trials: those that run still count by what others of their
  // experiment and scale factor took.
  double Of(std::span<const journal::TrialRecord> trials);
  // Noise and search among them, without what was reused.
  double OfSearch(std::vector<journal::TrialRecord> trials);
  // The same with what was reused: what it takes to know as much.
  double OfTold(std::vector<journal::TrialRecord> trials);

  // The time of one more simulation, by what the trials of the last Of took.
  double OfOne(int experiment, double scale_factor) { return usual_.Of(experiment, scale_factor); }

 private:
  const CampaignSpec& spec_;
  UsualCost usual_;
};

}  // namespace talus::campaign
