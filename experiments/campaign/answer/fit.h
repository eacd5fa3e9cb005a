// Whether the recommended set gives what was measured: each image and number of each experiment, as
// the confirming trials have it, or as the model predicts it where nothing was confirmed.
//
// An image is met when the mean profile of the confirming trials is no more than 1.5 times as far
// from the experiment's as its runs are from the mean of the others (the noise floor), and missed
// when it is farther by three standard errors of the mean of so many simulations. Without runs it
// is missed when the set itself, the scatter of its pictures taken off, is more than 5 % of the
// powder's area and 1.5 times that scatter away, or 1.5 times as far as the confirming trials are
// from each other: a map may be of one heap. Where it shows fewer views than they do, it scatters
// more, by the root of their ratio. A single confirming trial does not tell.
//
// A number is met within two standard errors, those of the measurement and of the simulations
// together, and missed beyond
//
//   √(t∞² s² + t_ν² e²)      s² the measurement's variance, e² that of the simulations' mean, known
//                            from ν degrees of freedom; t Student's, for 99 of 100
//
// One effective number of degrees of freedom for both would be exceeded 8 times in a hundred where
// two seeds tell e. So a set that fits is said to miss in one of a hundred campaigns, about
// (false_misses_test.cc counts); in between nothing is said. An s of a few values has its own
// degrees of freedom, and takes their factor in place of t∞. A number that none of the confirming
// trials has is missed: what was measured does not exist there.
//
// Coarser grains than the target's bias a heap: what they meet or miss the answer need not. Where
// the confirming trials are of such, the model's prediction at the target is judged in their place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/not_known.h"
#include "experiments/campaign/answer/answer.h"

namespace talus::campaign {

inline constexpr double kImplausible = 3;  // implausibility above which no set fits
inline constexpr double kCloseRuns = 1.5;  // noise floors that fit: a simulation scatters, too
inline constexpr double kCloseNumber = 2;  // standard errors that fit

enum class Meets {
  kYes,     // within what the measurement itself leaves open
  kNo,      // farther off
  kUnknown  // nothing to judge it by, or no farther off than a few simulations may be by chance
};

struct MeasurementFit {
  std::string experiment{};
  std::string number{};  // name of its metric; empty: the image
  Meets meets = Meets::kUnknown;
  double off = base::kNotKnown;    // of an image in noise floors, of a number in standard errors
  double share = base::kNotKnown;  // of an image: SAD of the mean profile over the powder's area
  std::optional<std::string> undefined{};  // of a number: why no confirming trial has one
  bool few_measured = false;  // of a number: more of what chance may do is the measurement's
};

// The confirming trials of an experiment, where they are of the target scale factor; else null.
const ResultConfirmed* ConfirmedAtTarget(const Answer& answer, std::string_view experiment);

// The image of an experiment, or a number of it by its place in the list.
MeasurementFit ImageFit(const Answer& answer, const ResultExperiment& experiment);
MeasurementFit NumberFit(const Answer& answer, const ResultExperiment& experiment,
                         std::size_t number);

// Every measurement, in the campaign's order.
std::vector<MeasurementFit> FitsOf(const Answer& answer);

// Whether the posterior was made without the experiment; without a posterior nothing tells.
bool IsHeldOut(const Answer& answer, std::string_view experiment);

// Every measurement that a set which was simulated again can be judged by, the farthest first:
// `off` in what is still a fit, so that it misses above 1; infinite where one does not exist there.
std::vector<MeasurementFit> DistancesOf(const Answer& answer, const ResultCandidate& candidate);

// Whether a set that was simulated again is not within what fits: it is not shown beside those that
// do, though chance may be to blame.
bool Misses(const Answer& answer, const ResultCandidate& candidate);

// "the shape of "heap"", "mass fallen of "wide plate"".
std::string SpokenOf(const MeasurementFit& fit);

// Error of the recommended set's confirmed objective. A few seeds that happen to agree say little
// of it.
double ErrorOf(const Answer& answer, const ResultExperiment& experiment,
               const ResultConfirmed& confirmed);

// What the confirming trials of an experiment say that a model of mean heaps predicts: the
// objective of their mean profile; of one that has none there the mean. NaN without either.
double ComparableOf(const Answer& answer, const ResultConfirmed& confirmed);

// " mm²" after an objective's value, " ° off" after an angle's, which is a distance.
std::string DistanceUnit(const Answer& answer);

// By how much the objective of one confirming trial scatters, by the model; 0 where it is not
// known. Grains f times as large scatter by f^1.5, a heap having f⁻³ as many.
double NoiseOfConfirming(const Answer& answer, const ResultExperiment& experiment);

// The SAD that the set would have without the scatter of its simulations.
double SadWithoutScatter(const ResultExperiment& experiment, const ResultConfirmed& confirmed);

}  // namespace talus::campaign
