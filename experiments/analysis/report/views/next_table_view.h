// What `talus next` has found for a campaign, read from the file that it leaves there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/not_known.h"
#include "experiments/analysis/compare/evidence.h"
#include "experiments/analysis/compare/profile_pictures.h"
#include "experiments/analysis/report/views/extras.h"

namespace talus::analysis {

// Something that could be done.
struct CandidateView {
  // A number of the test as it is predicted at each of the two sets.
  struct Number {
    std::string metric;
    std::vector<double> values;
  };
  std::string kind;  // as in next.json: "test", "more_runs", …
  std::string name;
  std::string what;                // in words
  double bits = base::kNotKnown;   // expected; undefined where that is not known
  bool needs_simulations = false;  // … before its simulations have been run
  std::vector<double> width;       // of the joint 90 % ranges that it leaves, unit cube; or none
  double remaining = base::kNotKnown;  // share of what there is to narrow (NextCandidate)
  double goal =
      base::kNotKnown;  // half-width of the goal's 90 % that it leaves, where there is a goal
  int num_simulations = 0;
  double core_time = 0;  // [s]
  // The two sets that it tells apart best, SI, with what they would show; or none.
  std::vector<std::vector<double>> apart;
  std::vector<Number> apart_by;
  Picture picture;
};

// A number of another test that they are ranked for.
struct NextGoalView {
  std::string process;
  std::string metric;
  double half_width = base::kNotKnown;  // of its 90 % now
};

struct NextTableView {
  std::vector<double> width;  // now
  std::string asked{};        // what it was made for, as words of the command (NextTable::asked)
  bool is_outdated = false;   // trials have ended since
  std::optional<NextGoalView> goal{};
  std::vector<CandidateView> candidates;
};

// Nothing where `talus next` has not been run. Throws ConfigError on a damaged file, but for the
// pictures.
std::optional<NextTableView> ReadNextTable(const Evidence& evidence, LeftOut& left_out);

}  // namespace talus::analysis
