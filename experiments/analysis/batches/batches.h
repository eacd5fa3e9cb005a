// Batches of a powder, calibrated by campaigns of the same kind: do they differ, and in what?
//
// Each is set against the first. The posteriors are independent, so draws of the two in pairs give
// draws of the difference. What was measured is compared without any model, too. Photographs by a
// permutation test: were the runs dealt out to the two batches by chance, how often would the mean
// profiles differ as much? Numbers by their standard errors.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/field.h"
#include "optimizer/space/scale.h"

namespace talus::analysis {

// Median and 90 % of a posterior, SI.
struct BatchRange {
  double median = 0;
  double low = 0;
  double high = 0;

  static constexpr base::FieldKey kKeys[] = {{"low", "low_90"}, {"high", "high_90"}};
  TALUS_FIELDS(median, low, high);
};

// This batch less the first; of a parameter that was searched on a logarithmic scale, over it: then
// range and `matters` are factors, and 1 is no difference.
struct BatchDifference {
  BatchRange range{};      // of the difference
  double matters = 0;      // a difference that is asked for [SI]; a factor > 1
  double probability = 0;  // that it is larger than that, either way
  bool is_found = false;   // the 90 % leave out no difference

  static constexpr base::FieldKey kKeys[] = {{"range", "difference"},
                                             {"probability", "probability_larger"}};
  TALUS_FIELDS(range, matters, probability, is_found);
};

struct BatchParameter {
  std::string name{};
  std::string unit{};
  std::string scale{};       // as the first batch searched it: "linear", "log"
  bool is_nuisance = false;  // searched, but not asked for: it decides nothing here
  std::vector<BatchRange> batches{};
  std::vector<BatchDifference> differences{};  // of all but the first batch

  bool IsLog() const { return scale == base::NameOf(optimizer::Scale::kLog); }

  static constexpr base::FieldKey kKeys[] = {{"is_nuisance", "nuisance"}};
  TALUS_FIELDS(name, unit, scale, is_nuisance, batches, differences);
};

// All parameters of a batch that are asked for less those of the first: a curve of equal sets may
// hide in single parameters what it shows in them together.
struct BatchTogether {
  std::string batch{};
  // Credible level of the smallest joint region of the difference that reaches no difference, by
  // the draws' mean and covariance: 0.9 or less is inside the joint 90 % region.
  double level = 0;
  bool is_found = false;  // it is not

  static constexpr base::FieldKey kKeys[] = {{"level", "credible_level_of_none"}};
  TALUS_FIELDS(batch, level, is_found);
};

// The photographs of an experiment beside those of the first batch.
struct BatchPictures {
  std::string batch{};
  std::string experiment{};
  std::string absent{};      // why they are not compared; empty where they are
  double sad_mm2 = 0;        // between the mean profiles
  double probability = 1;    // of one as large by chance
  int num_arrangements = 0;  // of the runs that this is counted over

  static constexpr base::FieldKey kKeys[] = {{"probability", "probability_by_chance"}};
  TALUS_FIELDS(batch, experiment, absent, sad_mm2, probability, num_arrangements);
};

// A number that an experiment has measured in both batches, less that of the first batch.
struct BatchNumber {
  std::string batch{};
  std::string experiment{};
  std::string name{};         // with the unit: "mass_fallen_kg"
  double difference = 0;      // in that unit
  double standard_error = 0;  // of it, > 0
  double probability = 1;     // of one as large by chance

  static constexpr base::FieldKey kKeys[] = {{"probability", "probability_by_chance"}};
  TALUS_FIELDS(batch, experiment, name, difference, standard_error, probability);
};

// Whether a batch differs from the first, in words.
struct BatchVerdict {
  std::string batch{};
  bool is_found = false;
  double measured_by_chance = 1;  // of all photographs and numbers together; 1 without any
  std::string text{};             // "no difference found", or what differs

  TALUS_FIELDS(batch, is_found, measured_by_chance, text);
};

struct BatchComparison {
  std::vector<std::string> batches{};  // by their folders
  std::vector<BatchParameter> parameters{};
  std::vector<BatchTogether> together{};  // of all but the first batch
  std::vector<BatchPictures> pictures{};
  std::vector<BatchNumber> numbers{};
  std::vector<BatchVerdict> verdicts{};  // of all but the first batch
  // What must be known before anything else: batches that another engine has simulated.
  std::vector<std::string> other_engines{};
  std::vector<std::string> warnings{};  // what else speaks against the comparison

  TALUS_FIELDS(batches, parameters, together, pictures, numbers, verdicts, other_engines, warnings);
};

// At least two folders. `matters` is the difference that counts of a parameter, by name and as text
// with its unit, of a logarithmic one as a factor; default: a tenth of the searched range of the
// first batch, on its scale. Throws ConfigError
// where the campaigns have searched different parameters or are one and the same, or a name is none
// of the parameters.
BatchComparison CompareBatches(const std::vector<std::filesystem::path>& folders,
                               const std::map<std::string, std::string>& matters);

// How many parameters are asked for.
int NumAsked(const BatchComparison& comparison);

// Share of the draws of a difference, one a row, that lie nearer to their mean than 0 does, by
// their covariance.
double LevelOfNone(Eigen::MatrixXd difference);

// The probability of several independent tests together, by Fisher's method: −2 Σ ln p follows χ²
// of 2 n degrees of freedom. That of one is its own; each by itself would claim more by chance the
// more there are. `probabilities` in (0, 1].
double ChanceTogether(const std::vector<double>& probabilities);

// A standard error and how many degrees of freedom it has; infinitely many: it is exact.
struct KnownError {
  double value = 0;
  double degrees = 0;
};

// The error of a difference of two such (Welch and Satterthwaite).
KnownError ErrorOfDifference(const KnownError& a, const KnownError& b);

// The chance that a difference is as large, by Student's t.
double ChanceOf(double difference, const KnownError& error);

// The verdict on a batch that is not the first, by all else that the comparison holds. Photographs
// and numbers of one test are of the same heaps: the least of their m chances counts m times
// (Bonferroni). Tests are independent, and their chances taken together.
BatchVerdict VerdictOf(const BatchComparison& comparison, std::size_t batch);
bool IsBeyondChance(double probability);
// How many photographs and numbers of a batch were compared.
int NumMeasured(const BatchComparison& comparison, const std::string& batch);
}  // namespace talus::analysis
