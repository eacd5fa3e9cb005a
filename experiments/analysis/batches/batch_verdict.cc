#include <algorithm>
#include <cmath>
#include <limits>

#include "base/student_factor.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/analysis/batches/batches.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::analysis {
namespace {

// What was measured by one test on the same heaps.
struct MeasuredTest {
  std::string experiment;
  std::vector<double> chances{};
  std::vector<std::string> apart{};  // that is beyond chance by itself

  void Add(double chance, const std::string& what) {
    chances.push_back(chance);
    if (IsBeyondChance(chance)) apart.push_back(what);
  }
  double Chance() const {
    return std::min(1.0, static_cast<double>(chances.size()) * std::ranges::min(chances));
  }
};

std::vector<MeasuredTest> MeasuredTests(const BatchComparison& c, const std::string& batch) {
  std::vector<MeasuredTest> tests;
  const auto test = [&](const std::string& experiment) -> MeasuredTest& {
    const auto found = std::ranges::find(tests, experiment, &MeasuredTest::experiment);
    return found != tests.end() ? *found : tests.emplace_back(MeasuredTest{experiment});
  };
  for (const BatchPictures& p : c.pictures) {
    if (p.batch != batch || !p.absent.empty()) continue;
    test(p.experiment).Add(p.probability, "the photographs of " + p.experiment);
  }
  for (const BatchNumber& n : c.numbers) {
    if (n.batch == batch)
      test(n.experiment).Add(n.probability, rigs::SpokenName(n.name) + " of " + n.experiment);
  }
  return tests;
}

// "0.2 J/m2", of a logarithmic parameter "a factor of 1.3".
std::string MedianText(const BatchParameter& p, const BatchDifference& d) {
  const std::string number = base::ShortNumber(d.range.median);
  if (p.IsLog()) return "a factor of " + number;
  return p.unit.empty() ? number : number + " " + p.unit;
}

std::vector<std::string> ParametersApart(const BatchComparison& c, std::size_t batch) {
  std::vector<std::string> apart;
  if (!c.together[batch - 1].is_found) return apart;
  for (const BatchParameter& p : c.parameters) {
    const BatchDifference& d = p.differences[batch - 1];
    if (d.is_found && !p.is_nuisance) apart.push_back(p.name + " by " + MedianText(p, d));
  }
  if (apart.empty()) apart.push_back("the parameters together, none of them by itself");
  return apart;
}

}  // namespace

bool IsBeyondChance(double probability) {
  constexpr double kBeyondChance = 0.05;
  return probability < kBeyondChance;
}

double ChanceTogether(const std::vector<double>& probabilities) {
  double half = 0;  // of χ²
  for (const double p : probabilities) half -= std::log(p);
  double term = std::exp(-half);
  double sum = 0;
  for (std::size_t i = 0; i < probabilities.size(); ++i) {
    sum += term;
    term *= half / static_cast<double>(i + 1);
  }
  return probabilities.empty() ? 1 : std::min(sum, 1.0);
}

KnownError ErrorOfDifference(const KnownError& a, const KnownError& b) {
  const double square = a.value * a.value + b.value * b.value;
  const double share_a = a.value * a.value / square, share_b = b.value * b.value / square;
  return {.value = std::sqrt(square),
          .degrees = 1 / (share_a * share_a / a.degrees + share_b * share_b / b.degrees)};
}

double ChanceOf(double difference, const KnownError& error) {
  // Student's tail is a difference of shares near 1, no better than its integral.
  constexpr double kLeast = 1e-9;
  return std::max(kLeast,
                  1 - base::StudentShare(error.degrees, std::abs(difference) / error.value));
}

BatchVerdict VerdictOf(const BatchComparison& c, std::size_t batch) {
  std::vector<std::string> found = ParametersApart(c, batch);
  std::vector<double> chances;
  std::vector<std::string> apart;
  for (const MeasuredTest& test : MeasuredTests(c, c.batches[batch])) {
    chances.push_back(test.Chance());
    apart.insert(apart.end(), test.apart.begin(), test.apart.end());
  }
  const double chance = ChanceTogether(chances);
  if (IsBeyondChance(chance)) {
    if (apart.empty()) apart.push_back("what was measured together, nothing of it by itself");
    found.insert(found.end(), apart.begin(), apart.end());
  }
  return {.batch = c.batches[batch],
          .is_found = !found.empty(),
          .measured_by_chance = chance,
          .text = found.empty() ? "no difference found" : "differs: " + base::Joined(found, ", ")};
}

int NumAsked(const BatchComparison& c) {
  return static_cast<int>(std::ranges::count(c.parameters, false, &BatchParameter::is_nuisance));
}

int NumMeasured(const BatchComparison& c, const std::string& batch) {
  int count = 0;
  for (const MeasuredTest& test : MeasuredTests(c, batch)) {
    count += static_cast<int>(test.chances.size());
  }
  return count;
}

}  // namespace talus::analysis
