#include "experiments/analysis/next/unknown_discount.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/analysis/next/unknown_shift.h"

namespace talus::analysis {
namespace {

// δ of each thing that moves the test beyond chance, over the root of the temper: variances are
// those before tempering.
std::vector<Eigen::VectorXd> ListShifts(double temper, const UnknownTrials& unknown,
                                        const UnknownRows& rows, NextCandidate& candidate) {
  std::vector<Eigen::MatrixXd> sets{rows.base};
  sets.insert(sets.end(), rows.moved.begin(), rows.moved.end());
  const Eigen::VectorXd noise = rows.noise.cwiseMax(PooledVariance(sets));
  std::vector<Eigen::VectorXd> shifts;
  for (std::size_t m = 0; m < unknown.moved.size(); ++m) {
    const Eigen::VectorXd shift = ShiftBeyondChance(
        {.moved = rows.moved[m], .base = rows.base, .noise = noise, .num_modes = rows.num_modes});
    if (shift.isZero(0)) continue;
    const Eigen::VectorXd untempered = shift / std::sqrt(temper);
    const MovedTest& moved = unknown.moved[m];
    const Eigen::ArrayXd errors = candidate.predicted.variance.array();
    candidate.unknowns.push_back(
        {.name = moved.name,
         .from = moved.from,
         .to = moved.to,
         .shift = std::sqrt((untempered.array().square() / errors).sum())});
    shifts.push_back(untempered);
  }
  return shifts;
}

// "; 5.1 bits if what it depends on were known: restitution (0.6 in place of 0.9 shifts it by 6.2
// of its errors)"
std::string DiscountText(const NextCandidate& candidate) {
  constexpr std::size_t kMost = 3;
  const std::size_t named = std::min(kMost, candidate.unknowns.size());
  const std::size_t more = candidate.unknowns.size() - named;
  return "; " + base::ShortNumber(*candidate.bits_if_known, 2) +
         " bits if what it depends on were known: " +
         base::JoinedUpTo(named, ", ",
                          [&](std::size_t i) {
                            const NextUnknown& unknown = candidate.unknowns[i];
                            return unknown.name + " (" + unknown.to + " in place of " +
                                   unknown.from + " shifts it by " +
                                   base::ShortNumber(unknown.shift, 2) +
                                   (i == 0 ? " of its errors)" : ")");
                          }) +
         (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

}  // namespace

void Discount(const Ground& ground, const UnknownTrials& unknown, const UnknownRows& rows,
              NextCandidate& candidate) {
  const std::vector<Eigen::VectorXd> shifts = ListShifts(ground.temper, unknown, rows, candidate);
  if (shifts.empty()) return;
  const optimizer::PredictedMeasurement less = WithShifts(candidate.predicted, shifts);
  candidate.bits_if_known = candidate.learning->bits;
  candidate.learning = ground.Learn(less);
  std::ranges::stable_sort(candidate.unknowns, std::greater<>{}, &NextUnknown::shift);
  candidate.what += DiscountText(candidate);
}

}  // namespace talus::analysis
