// What could be done next, and the one order that terminal, next.json and report list it in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/not_known.h"
#include "experiments/journal/records.h"
#include "optimizer/posterior/expected_learning.h"
#include "optimizer/space/parameter_space.h"

namespace talus::analysis {

enum class NextKind {
  kMoreRuns,         // double the photographed runs of an experiment
  kMoreSimulations,  // double the simulations at the smallest scale factor
  kFinerGrains,      // simulations at a smaller scale factor
  kNumber,           // weigh the powder on the plate; trials know it already
  kDirect,           // measure a parameter by itself: powder on a wall, on a tilted plate
  kTest              // another test
};

// A number as it is predicted at the two sets that a test tells apart best.
struct ToldApart {
  std::string metric;
  double first = 0;
  double second = 0;
};

// Something held fixed that a test depends on.
struct NextUnknown {
  std::string name;  // "restitution"
  std::string from;  // for people, with its unit
  std::string to;    // as it was moved
  double shift = 0;  // of what the test shows, √(δᵀ C⁻¹ δ), in its errors [-]
};

struct NextCandidate {
  NextKind kind = NextKind::kTest;
  std::string name;
  std::string what{};  // in words
  // Not known where the test's design has not been simulated.
  std::optional<optimizer::ExpectedLearning> learning{};
  // Share that it is expected to leave of the goal's width, else of the volume of the 90 % ranges
  // of what is asked for [-]; NaN where that is not known.
  double remaining = base::kNotKnown;
  optimizer::PredictedMeasurement predicted{};  // of a test: what `learning` is of
  std::vector<NextUnknown> unknowns{};          // of a test: what it is discounted for, most first
  std::optional<double> bits_if_known{};        // without that discount
  int num_simulations = 0;  // that it will take, about, with those that are made
  int num_made = 0;         // of these, for its design
  int num_failed = 0;       // of those made
  double core_time = 0;     // of all these simulations [s]
  double core_time_made = 0;
  double core_time_to_judge = 0;             // of a test without a design: what that takes [s]
  std::vector<std::vector<double>> apart{};  // the two sets it separates most, SI; or none
  std::vector<ToldApart> numbers{};          // at these two
  std::filesystem::path picture{};           // of these two; empty without images
};

// The prediction that they are ranked for.
struct NextGoal {
  std::string process;        // "spread"
  std::string number;         // "packing_fraction", in whose unit the widths are
  double half_width = 0;      // of its 90 % now, as far as the parameters leave it open
  double left_out_error = 0;  // NumberSurrogate's
  double scale_factor = 1;
  int num_draws = 0;
  int num_runs = 0;
  double core_time = 0;  // of these [s]
};

struct NextTable {
  std::vector<journal::ParameterRecord> parameters;
  std::vector<optimizer::Scale> scales{};  // of the parameters
  std::int64_t last_trial = 0;             // the latest that had ended, by id; 0: none
  std::vector<Eigen::Index> nuisances{};   // which of them nobody asks for
  Eigen::VectorXd width{};         // of the 90 % ranges now, as the answer states them, unit cube
  std::optional<NextGoal> goal{};  // none: the parameters themselves
  // More simulations that the campaign's alarms ask for before anything else; 0: none.
  int simulate_first = 0;
  // Candidates and prediction that were asked for, as words of the command: " tests.json --for a".
  std::string asked{};
  bool has_simulated = false;               // the designs of tests, as far as the budget went
  std::vector<NextCandidate> candidates{};  // in the order of Rank
};

// What the learning is expected to leave: NextCandidate::remaining.
double RemainingOf(const NextTable& table, const optimizer::ExpectedLearning& learning);

// Sets what each candidate leaves.
void SetRemaining(NextTable& table);

// The same, and puts first what leaves least; of equals what has more bits. What is not known
// stands last.
void Rank(NextTable& table);

}  // namespace talus::analysis
