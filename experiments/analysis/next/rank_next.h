// What to do next, by what it is expected to teach about the parameters.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/next/test_candidate.h"
#include "experiments/analysis/next/test_design.h"
#include "optimizer/information/expected_learning.h"

namespace talus::analysis {

enum class NextKind {
  kMoreRuns,         // double the photographed runs of an experiment
  kMoreSimulations,  // double the simulations at the smallest scale factor
  kNumber,           // weigh the powder that falls off the plate; trials know it already
  kTest              // another test
};

struct NextCandidate {
  NextKind kind = NextKind::kTest;
  std::string name;
  std::string what{};  // in words
  // Not known where the test's design has not been simulated.
  std::optional<optimizer::ExpectedLearning> learning{};
  int num_simulations = 0;                   // that it will take, about
  double core_time = 0;                      // of these [s]
  std::vector<std::vector<double>> apart{};  // the two sets it separates most, SI; or none
  std::filesystem::path picture{};           // of these two; empty without images
};

struct NextTable {
  std::vector<journal::ParameterRecord> parameters;
  std::vector<optimizer::Scale> scales{};   // of the parameters
  std::int64_t last_trial = 0;              // the latest that had ended, by id; 0: none
  Eigen::VectorXd width{};                  // of the joint 90 % ranges now, unit cube
  std::vector<NextCandidate> candidates{};  // the most informative first, unknown ones last
};

struct NextOptions {
  std::vector<TestCandidate> tests{};
  bool simulate = false;            // the designs of the tests that have none
  campaign::CampaignParts parts{};  // that simulate
};

// Throws base::Error while there are too few trials for a posterior.
NextTable RankNext(const campaign::JointView& view, const NextOptions& options);

}  // namespace talus::analysis
