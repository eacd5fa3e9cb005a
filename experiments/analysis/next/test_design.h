// The few simulations that a test needs before it can be said what it would teach: one at each of
// some draws of the posterior, as coarse as the campaign allows. They are kept in DIR/next/NAME and
// not made twice: not when the test is made either (campaign/take_over.h).
#pragma once

#include <optional>
#include <vector>

#include "experiments/analysis/next/test_candidate.h"
#include "experiments/campaign/campaign.h"
#include "experiments/campaign/run_cases.h"
#include "experiments/journal/records.h"
#include "imaging/gray_image.h"

namespace talus::analysis {

inline constexpr int kDesignSize = 16;  // simulations of a design

struct DesignTrial {
  Eigen::VectorXd point;       // unit cube
  imaging::GrayImage profile;  // empty without a frame
  std::vector<journal::MetricRecord> scalars;
};

struct TestDesign {
  double scale_factor = 1;
  Eigen::VectorXd middle{};  // the point nearest to the mean of all, unit cube
  std::optional<imaging::Frame> frame{};
  int size = 0;                       // simulations in all
  std::vector<DesignTrial> trials{};  // those that succeeded
  int num_simulations = 0;            // that have ended, well or not
  double core_time = 0;               // of these [s]

  int NumFailed() const { return num_simulations - static_cast<int>(trials.size()); }
};

// The design that was made; nothing where none was, or one of another device.
std::optional<TestDesign> StoredDesign(const campaign::JointView& view, const TestCandidate& test,
                                       trials::TrialEngine& engine);

// What a simulation of a set has shown.
DesignTrial TrialOf(const Eigen::VectorXd& point, trials::TrialOutput output);

// Where a design's points lie.
struct DesignPlace {
  const Eigen::MatrixXd& draws;  // one a row; the points are spread over them
  int size = kDesignSize;        // how many
};

// Simulates what of it is missing. Throws base::Interrupted when the user ends it; what has ended
// is kept.
TestDesign SimulateDesign(const campaign::JointView& view, const TestCandidate& test,
                          const DesignPlace& place, const campaign::CampaignParts& parts);

}  // namespace talus::analysis
