// What the folder of a search by `talus optimize` holds, for its report (trials/optimize).
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

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
  double recommended = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();  // of the credible range
  double high = std::numeric_limits<double>::quiet_NaN();
  double sobol_first = std::numeric_limits<double>::quiet_NaN();
  double sobol_total = std::numeric_limits<double>::quiet_NaN();
};

struct SearchAnswer {
  std::vector<ParameterAnswer> parameters{};  // in the order of the search's
  double predicted_value = std::numeric_limits<double>::quiet_NaN();
  double predicted_sd = std::numeric_limits<double>::quiet_NaN();
  double noise_sd = std::numeric_limits<double>::quiet_NaN();
  double tied_volume = std::numeric_limits<double>::quiet_NaN();
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
