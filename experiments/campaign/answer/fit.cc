#include "experiments/campaign/answer/fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/not_known.h"
#include "base/student_factor.h"
#include "experiments/journal/objective.h"
#include "experiments/rigs/observables/shown_number.h"
#include "optimizer/outputs/levels.h"

namespace talus::campaign {
namespace {

constexpr double kNoChance =
    0.99;                        // of the measurements that a set gives are not said to be missed
constexpr double kFarImage = 3;  // standard errors: SADs are skewed (tests count 1 in 100)
constexpr double kMostShare = 0.05;  // of the powder's area

// The square of a mean profile's SAD falls as a² + b²/n with its n heaps: b, from one heap and all.
// Not from one heap that is black and white: it is as far from a mean as from another of its kind,
// and how far the trials are from each other tells.
double ScatterOfOne(const ResultExperiment& experiment, const ResultConfirmed& confirmed) {
  if (!confirmed.profile_sad_mm2 || !confirmed.sad_mm2 || confirmed.num_trials < 2) return 0;
  const double n = confirmed.num_trials;
  const double one = *confirmed.sad_mm2;
  const double all = *confirmed.profile_sad_mm2;
  const double by_means = std::sqrt(std::max(0.0, (one * one - all * all) * n / (n - 1)));
  if (experiment.views_per_photograph == 1) return by_means;
  return std::max(by_means, confirmed.spread_mm2.value_or(0) * std::sqrt((n - 1) / n));
}

// How far above its mean chance may take the SAD of a mean profile [mm²], by the scatter that the
// model has found over the campaign, where it has one of SADs, and by that of the confirming seeds.
double ChanceOf(const Answer& answer, const ResultExperiment& experiment,
                const ResultConfirmed& confirmed) {
  const double seeds = OrZero(confirmed.sad_standard_error.value_or(0));
  if (MinimisesSad(answer) && experiment.noise_sd) {
    return kFarImage * std::max(seeds, ErrorOf(answer, experiment, confirmed));
  }
  if (confirmed.degrees == 0) return 0;
  return seeds * std::max(kFarImage, base::StudentFactor(confirmed.degrees, kNoChance));
}

// Where no runs say how far heaps are apart by chance: the SAD above which an image misses [mm²].
// Nothing where the powder's area is not known.
std::optional<double> LimitWithoutRuns(const ResultExperiment& experiment,
                                       const ResultConfirmed& confirmed) {
  if (!experiment.powder_area || confirmed.num_trials < 2) return std::nullopt;
  const double scatter =
      std::max(ScatterOfOne(experiment, confirmed), confirmed.spread_mm2.value_or(0)) *
      std::sqrt(experiment.views_per_photograph);
  return std::max(kMostShare * *experiment.powder_area, kCloseRuns * scatter);
}

Meets ImageMeets(const Answer& answer, const ResultExperiment& experiment,
                 const ResultConfirmed& confirmed) {
  if (!confirmed.profile_sad_mm2) return Meets::kUnknown;
  if (confirmed.over_floor) {
    if (*confirmed.over_floor <= kCloseRuns) return Meets::kYes;
    const double beyond = (1 - kCloseRuns / *confirmed.over_floor) * *confirmed.profile_sad_mm2;
    return beyond > ChanceOf(answer, experiment, confirmed) ? Meets::kNo : Meets::kUnknown;
  }
  const auto limit = LimitWithoutRuns(experiment, confirmed);
  return limit && SadWithoutScatter(experiment, confirmed) > *limit ? Meets::kNo : Meets::kUnknown;
}

// How far apart they are in standard errors; a few simulations have one, too.
double OffBy(const ResultNumber& measured, double simulated, double simulated_error) {
  const double error = std::isfinite(simulated_error) ? simulated_error : 0;
  return std::abs(simulated - measured.value) / std::hypot(measured.standard_error, error);
}

double OffBy(const ResultNumber& measured, const ResultScalar& simulated) {
  return OffBy(measured, simulated.mean, simulated.standard_error);
}

// How many standard errors chance may make of an error of so many degrees of freedom; 0: exact.
double MostByChance(int degrees) {
  return base::StudentFactor(degrees > 0 ? degrees : std::numeric_limits<double>::infinity(),
                             kNoChance);
}

// Without an error of the simulations nothing is far.
Meets NumberMeets(const ResultNumber& measured, double off, double simulated_error, int degrees) {
  if (!std::isfinite(off)) return Meets::kUnknown;
  if (off <= kCloseNumber) return Meets::kYes;
  if (!std::isfinite(simulated_error)) return Meets::kUnknown;
  const double limit = std::hypot(MostByChance(measured.degrees) * measured.standard_error,
                                  MostByChance(degrees) * simulated_error) /
                       std::hypot(measured.standard_error, simulated_error);
  return off > limit ? Meets::kNo : Meets::kUnknown;
}

// In what is still a fit; NaN where nothing judges it.
double DistanceOfImage(const ResultExperiment& experiment, const ResultConfirmed& confirmed) {
  if (confirmed.over_floor) return *confirmed.over_floor / kCloseRuns;
  const auto limit = LimitWithoutRuns(experiment, confirmed);
  if (!limit || !confirmed.profile_sad_mm2) return base::kNotKnown;
  return SadWithoutScatter(experiment, confirmed) / *limit;
}

bool IsImplausible(const Answer& answer, const std::string& experiment) {
  const ResultStanding* standing = StandingOf(answer, experiment);
  return standing != nullptr && standing->implausibility > kImplausible;
}

}  // namespace

const ResultConfirmed* ConfirmedAtTarget(const Answer& answer, std::string_view experiment) {
  const ResultCandidate* set = ConfirmedSet(answer);
  if (set == nullptr) return nullptr;
  const bool is_there = set->scale_factor == answer.conditions.scale_factor;
  return is_there ? ConfirmedOf(answer, experiment) : nullptr;
}

double NoiseOfConfirming(const Answer& answer, const ResultExperiment& experiment) {
  if (answer.confirmed.empty()) return experiment.noise_sd.value_or(0);
  return experiment.noise_sd.value_or(0) *
         optimizer::NoiseRatio(answer.confirmed.front().scale_factor,
                               answer.conditions.scale_factor);
}

double ErrorOf(const Answer& answer, const ResultExperiment& experiment,
               const ResultConfirmed& confirmed) {
  return std::max(
      OrZero(confirmed.standard_error),
      NoiseOfConfirming(answer, experiment) / std::sqrt(std::max(1, confirmed.num_trials)));
}

std::string DistanceUnit(const Answer& answer) {
  const bool is_distance = std::ranges::any_of(journal::kObjectives, [&](const auto& info) {
    return info.is_angle && info.ValueKey() == answer.objective;
  });
  return " " + answer.objective_unit + (is_distance ? " off" : "");
}

double ComparableOf(const Answer& answer, const ResultConfirmed& confirmed) {
  if (MinimisesSad(answer) && confirmed.profile_sad_mm2) return *confirmed.profile_sad_mm2;
  return confirmed.profile_objective.value_or(confirmed.mean);
}

double SadWithoutScatter(const ResultExperiment& experiment, const ResultConfirmed& confirmed) {
  const double all =
      confirmed.profile_sad_mm2.value_or(confirmed.sad_mm2.value_or(base::kNotKnown));
  const double scatter = ScatterOfOne(experiment, confirmed);
  return std::sqrt(std::max(0.0, all * all - scatter * scatter / confirmed.num_trials));
}

MeasurementFit ImageFit(const Answer& answer, const ResultExperiment& experiment) {
  MeasurementFit fit{.experiment = experiment.name};
  if (IsImplausible(answer, experiment.name)) fit.meets = Meets::kNo;
  const ResultConfirmed* confirmed = ConfirmedAtTarget(answer, experiment.name);
  if (confirmed == nullptr || !confirmed->profile_sad_mm2) return fit;
  if (experiment.powder_area) fit.share = *confirmed->profile_sad_mm2 / *experiment.powder_area;
  if (confirmed->over_floor) fit.off = *confirmed->over_floor;
  if (fit.meets != Meets::kNo) fit.meets = ImageMeets(answer, experiment, *confirmed);
  return fit;
}

MeasurementFit NumberFit(const Answer& answer, const ResultExperiment& experiment,
                         std::size_t number) {
  const ResultNumber& measured = experiment.numbers[number];
  MeasurementFit fit{.experiment = experiment.name, .number = measured.name};
  const ResultConfirmed* confirmed = ConfirmedAtTarget(answer, experiment.name);
  const ResultStanding* standing = StandingOf(answer, experiment.name);
  if (confirmed != nullptr && confirmed->scalars.at(number).undefined) {
    fit.undefined = confirmed->scalars[number].undefined;
    fit.meets = Meets::kNo;
    return fit;
  }
  double simulated = base::kNotKnown;
  double error = base::kNotKnown;
  int degrees = 0;
  if (confirmed != nullptr && std::isfinite(confirmed->scalars.at(number).mean)) {
    simulated = confirmed->scalars[number].mean;
    error = confirmed->scalars[number].standard_error;
    degrees = confirmed->scalars[number].degrees;
  } else if (standing != nullptr && number < standing->numbers.size()) {
    simulated = standing->numbers[number].predicted;
    error = standing->numbers[number].predicted_sd;
  }
  fit.off = OffBy(measured, simulated, error);
  fit.meets = NumberMeets(measured, fit.off, error, degrees);
  // Where no set fits an experiment, what is close to it is so all the same.
  if (IsImplausible(answer, experiment.name) && !(fit.off <= kCloseNumber)) fit.meets = Meets::kNo;
  fit.few_measured =
      measured.degrees > 0 && MostByChance(measured.degrees) * measured.standard_error >
                                  MostByChance(degrees) * (std::isfinite(error) ? error : 0);
  return fit;
}

std::vector<MeasurementFit> DistancesOf(const Answer& answer, const ResultCandidate& candidate) {
  std::vector<MeasurementFit> distances;
  for (const ResultConfirmed& confirmed : candidate.experiments) {
    const auto add = [&](const std::string& number, double off) {
      if (std::isnan(off)) return;
      distances.push_back({.experiment = confirmed.name, .number = number, .off = off});
    };
    const auto experiment =
        std::ranges::find(answer.experiments, confirmed.name, &ResultExperiment::name);
    // An experiment without a standing is held out.
    if (experiment == answer.experiments.end() || !StandingOf(answer, confirmed.name)) continue;
    add("", DistanceOfImage(*experiment, confirmed));
    for (std::size_t i = 0; i < experiment->numbers.size(); ++i) {
      const ResultNumber& measured = experiment->numbers[i];
      add(measured.name, confirmed.scalars.at(i).undefined
                             ? std::numeric_limits<double>::infinity()
                             : OffBy(measured, confirmed.scalars[i]) / kCloseNumber);
    }
  }
  std::ranges::stable_sort(distances, std::ranges::greater{}, &MeasurementFit::off);
  return distances;
}

bool Misses(const Answer& answer, const ResultCandidate& candidate) {
  if (candidate.scale_factor != answer.conditions.scale_factor) return false;
  const std::vector<MeasurementFit> distances = DistancesOf(answer, candidate);
  return !distances.empty() && distances.front().off > 1;
}

std::string SpokenOf(const MeasurementFit& fit) {
  return (fit.number.empty() ? "the shape" : rigs::SpokenName(fit.number)) + " of \"" +
         fit.experiment + "\"";
}

bool IsHeldOut(const Answer& answer, std::string_view experiment) {
  return answer.posterior && StandingOf(answer, experiment) == nullptr;
}

std::vector<MeasurementFit> FitsOf(const Answer& answer) {
  std::vector<MeasurementFit> fits;
  for (const ResultExperiment& experiment : answer.experiments) {
    if (experiment.has_image) fits.push_back(ImageFit(answer, experiment));
    for (std::size_t i = 0; i < experiment.numbers.size(); ++i) {
      fits.push_back(NumberFit(answer, experiment, i));
    }
  }
  return fits;
}

}  // namespace talus::campaign
