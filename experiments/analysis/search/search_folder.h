// What the folder of a search by `talus optimize` holds, for its report (trials/optimize).
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/not_known.h"

namespace talus::analysis {

// One that is searched; fixed ones are left out.
struct SearchParameter {
  std::string name;
  double low = 0;
  double high = 1;
  bool log = false;
};

struct SearchEvaluation {
  int number = 0;                 // from 1
  std::vector<double> values{};   // of the parameters, in their order
  std::optional<double> value{};  // none when it failed
  std::string failure{};          // why it did
};

// docs/optimize.md; NaN for what the result does not say.
struct ParameterAnswer {
  double recommended = base::kNotKnown;
  double low = base::kNotKnown;  // of the credible range
  double high = base::kNotKnown;
  double sobol_first = base::kNotKnown;
  double sobol_total = base::kNotKnown;
};

struct SearchAnswer {
  std::vector<ParameterAnswer> parameters{};  // in the order of the search's
  double predicted_value = base::kNotKnown;
  double predicted_sd = base::kNotKnown;
  double noise_sd = base::kNotKnown;
  double tied_volume = base::kNotKnown;
  int num_evaluations = std::numeric_limits<int>::max();  // that it is made of, the first ones
  std::string stopped{};                                  // why
  std::string model{};
  std::vector<std::string> warnings{};
};

struct SearchFolder {
  std::string name;
  std::vector<SearchParameter> parameters{};
  std::vector<SearchEvaluation> evaluations{};  // by number
  int most_evaluations = 0;
  std::optional<SearchAnswer> answer{};  // once the search has ended
};

bool IsSearchFolder(const std::filesystem::path& folder);

// The search may be running. Throws base::ConfigError where files are damaged.
SearchFolder ReadSearchFolder(const std::filesystem::path& folder);

}  // namespace talus::analysis
