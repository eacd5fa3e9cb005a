// What `talus next` has found for a campaign, read from the file that it leaves there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/compare/evidence.h"
#include "experiments/analysis/compare/profile_pictures.h"

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
  std::string what;           // in words
  double bits = kUndefined;   // expected; undefined where its simulations have not been run
  std::vector<double> width;  // of the joint 90 % ranges that it leaves, unit cube; or none
  int num_simulations = 0;
  double core_time = 0;  // [s]
  // The two sets that it tells apart best, SI, with what they would show; or none.
  std::vector<std::vector<double>> apart;
  std::vector<Number> apart_by;
  Picture picture;
};

struct NextTableView {
  std::vector<double> width;  // now
  bool is_outdated = false;   // trials have ended since
  std::vector<CandidateView> candidates;
};

// Nothing where `talus next` has not been run. Throws ConfigError on a damaged file.
std::optional<NextTableView> ReadNextTable(const Evidence& evidence);

}  // namespace talus::analysis
