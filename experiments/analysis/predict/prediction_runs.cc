#include "experiments/analysis/predict/prediction_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/not_known.h"
#include "base/sample.h"
#include "base/student_factor.h"
#include "base/text/joined.h"
#include "experiments/analysis/predict/prediction_pictures.h"
#include "experiments/analysis/predict/surrogate_answer.h"
#include "experiments/rigs/rig_list.h"
#include "imaging/heap/metrics.h"
#include "imaging/spheres/projection.h"

namespace talus::analysis {
namespace {

const journal::MetricRecord* Find(const trials::TrialOutput& output, const std::string& name) {
  const auto found = std::ranges::find(output.scalars, name, &journal::MetricRecord::name);
  return found == output.scalars.end() ? nullptr : &*found;
}

// The error of the mean that a draw's runs, or a surrogate in their place, say it has.
double MeanSd(const PredictedNumber& predicted, const Spread& spread, int num_seeds) {
  if (predicted.surrogate && predicted.surrogate->is_used) return spread.surrogate_sd();
  return std::isnan(spread.run_sd()) ? 0 : spread.run_sd() / std::sqrt(num_seeds);
}

MeasuredThere Judge(const campaign::ScalarSpec& number, const Spread& spread,
                    const PredictedNumber& predicted, int num_seeds) {
  // The mean of several values scatters by its own error, not by a single run's.
  const bool is_mean = number.degrees > 0;
  const double error = base::NormalError(number.standard_error, number.degrees);
  const Range range = (is_mean ? spread.OfMeans() : spread).Ninety(error);
  MeasuredThere there{.value = number.value,
                      .standard_error = number.standard_error,
                      .low = range.low,
                      .high = range.high};
  there.is_inside = number.value >= there.low && number.value <= there.high;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < predicted.by_draw.size(); ++d) {
    const double distance = std::abs(predicted.by_draw[d] - number.value);
    if (!(distance < nearest)) continue;
    nearest = distance;
    there.nearest_draw = static_cast<int>(d);
  }
  const double run_sd = is_mean || std::isnan(spread.run_sd()) ? 0 : spread.run_sd();
  const double sd = std::hypot(run_sd, MeanSd(predicted, spread, num_seeds), error);
  there.nearest_is_inside = nearest <= base::kNormal90 * sd;
  return there;
}

PredictedNumber Describe(std::string name, const DrawValues& values, const Spread& spread) {
  PredictedNumber number{.name = std::move(name)};
  Take(spread, number);
  number.repeats_sd = number.run_sd;
  for (const std::vector<double>& runs : values.runs) {
    number.num_defined += static_cast<int>(runs.size());
    number.by_draw.push_back(base::SampleOf(runs).mean);
  }
  return number;
}

// How much farther a mean is from another run than from one that it is of: `squares`, below 1, is
// the sum of the squares of its runs' shares, 1/n of n equal ones.
double ToAnother(double squares) { return std::sqrt((1 + squares) / (1 - squares)); }

struct Weighted {
  double value = 0;
  double weight = 0;
};

// The least value that 90 % of the weight is not above.
double Quantile90(std::vector<Weighted> values) {
  std::ranges::sort(values, {}, &Weighted::value);
  double total = 0;
  for (const Weighted& v : values) total += v.weight;
  double below = 0;
  for (const Weighted& v : values) {
    below += v.weight;
    if (below >= optimizer::kRegionLevel * total) return v.value;
  }
  return base::kNotKnown;
}

}  // namespace

void KeepRigNumbers(const rigs::Case& rig_case, trials::TrialOutput& output) {
  std::vector<std::string> measured;
  for (const rigs::RigObservable& one : rigs::EntryOf(rig_case).observables) {
    measured.push_back(rigs::MetricName(one.observable));
  }
  std::erase_if(output.scalars, [&](const journal::MetricRecord& scalar) {
    return std::ranges::find(measured, scalar.name) == measured.end();
  });
  if (!output.scalars.empty() || !output.profile.pixels.empty()) return;
  throw base::Error("left none of \"" + base::Joined(measured, "\", \"") + "\", which the rig \"" +
                    std::string(base::NameOf(rig_case.rig.kind)) +
                    "\" measures; the engine's templates simulate another test");
}

PredictionRuns::PredictionRuns(std::vector<double> weights, std::vector<PlannedRun> plan,
                               double scale_factor)
    : weights_(std::move(weights)),
      plan_(std::move(plan)),
      scale_factor_(scale_factor),
      runs_(plan_.size()) {}

void PredictionRuns::Add(std::size_t run, trials::TrialOutput output) {
  runs_[run] = {.has_ended = true, .output = std::move(output)};
  ++num_ended_;
}

void PredictionRuns::AddFailure(std::size_t run, std::string why, double core_time) {
  runs_[run].has_ended = true;
  ++num_ended_;
  ++num_failed_;
  failed_time_ += core_time;
  failure_ = std::move(why);
}

int PredictionRuns::NumEnded(double scale_factor) const {
  int count = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (runs_[r].output && plan_[r].scale_factor == scale_factor) ++count;
  }
  return count;
}

std::vector<std::string> PredictionRuns::Names(double scale_factor) const {
  std::vector<std::string> names;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (!runs_[r].output || plan_[r].scale_factor != scale_factor) continue;
    for (const journal::MetricRecord& scalar : runs_[r].output->scalars) {
      if (std::ranges::find(names, scalar.name) == names.end()) names.push_back(scalar.name);
    }
  }
  return names;
}

DrawValues PredictionRuns::ValuesOf(const std::string& name, double scale_factor,
                                    std::string& undefined) const {
  DrawValues values{.runs = std::vector<std::vector<double>>(weights_.size()), .weight = weights_};
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (!runs_[r].output || plan_[r].scale_factor != scale_factor) continue;
    const journal::MetricRecord* scalar = Find(*runs_[r].output, name);
    if (scalar == nullptr) continue;
    if (std::isfinite(scalar->value))
      values.runs[plan_[r].draw].push_back(scalar->value);
    else
      undefined = scalar->undefined;
  }
  return values;
}

std::vector<double> PredictionRuns::ByRun(const std::string& name) const {
  std::vector<double> values;
  for (const Run& run : runs_) {
    if (!run.output) continue;
    const journal::MetricRecord* scalar = Find(*run.output, name);
    values.push_back(scalar == nullptr ? base::kNotKnown : scalar->value);
  }
  return values;
}

std::string PredictionRuns::UnitOf(const std::string& name) const {
  for (const Run& run : runs_) {
    const journal::MetricRecord* scalar = run.output ? Find(*run.output, name) : nullptr;
    if (scalar != nullptr && scalar->unit != "-") return scalar->unit;
  }
  return {};
}

int PredictionRuns::SeedsOfADraw() const {
  return static_cast<int>(std::ranges::count_if(plan_, [&](const PlannedRun& run) {
    return run.draw == 0 && run.scale_factor == scale_factor_;
  }));
}

std::vector<std::optional<Spread>> PredictionRuns::Summarise(Prediction& prediction) const {
  prediction.num_runs = static_cast<int>(runs_.size());
  prediction.num_ended = num_ended_;
  prediction.num_failed = num_failed_;
  prediction.failure = failure_;
  prediction.core_time = failed_time_;
  prediction.runs.clear();
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (!runs_[r].output) continue;
    prediction.core_time += runs_[r].output->cpu_time;
    prediction.runs.push_back(
        {.draw = static_cast<int>(plan_[r].draw), .scale_factor = plan_[r].scale_factor});
  }
  prediction.numbers.clear();
  std::vector<std::optional<Spread>> spreads;
  for (const std::string& name : Names(prediction.scale_factor)) {
    std::string undefined;
    const DrawValues values = ValuesOf(name, prediction.scale_factor, undefined);
    PredictedNumber number{.name = name, .by_draw = std::vector(weights_.size(), base::kNotKnown)};
    std::optional<Spread> spread;
    const bool any =
        std::ranges::any_of(values.runs, [](const auto& runs) { return !runs.empty(); });
    if (any) {
      spread.emplace(values, rigs::BoundsOf(name));
      number = Describe(name, values, *spread);
    }
    number.unit = UnitOf(name);
    number.by_run = ByRun(name);
    number.undefined = std::move(undefined);
    prediction.numbers.push_back(std::move(number));
    spreads.push_back(std::move(spread));
  }
  return spreads;
}

std::vector<imaging::GrayImage> PredictionRuns::ImagesOf(std::size_t wanted) const {
  std::vector<imaging::GrayImage> images;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (plan_[r].draw != wanted || plan_[r].scale_factor != scale_factor_ || !runs_[r].output)
      continue;
    if (!runs_[r].output->profile.pixels.empty()) images.push_back(runs_[r].output->profile);
  }
  return images;
}

void PredictionRuns::Compare(const MeasuredProcess& measured,
                             const std::vector<std::optional<Spread>>& spreads,
                             Prediction& prediction) const {
  for (const campaign::ScalarSpec& scalar : measured.numbers) {
    const auto number =
        std::ranges::find(prediction.numbers, scalar.metric, &PredictedNumber::name);
    if (number == prediction.numbers.end()) {
      prediction.notes.push_back(scalar.key + " is measured, and no run of this case reports it");
      continue;
    }
    const std::optional<Spread>& spread =
        spreads[static_cast<std::size_t>(number - prediction.numbers.begin())];
    if (spread) number->measured = Judge(scalar, *spread, *number, SeedsOfADraw());
  }
  if (measured.profile) prediction.image = CompareImage(*measured.profile);
}

std::optional<MeasuredImage> PredictionRuns::CompareImage(const imaging::Profile& measured) const {
  const double pixel = 1e3 * measured.frame.pixel_size;  // [mm]
  const auto sad = [&](const imaging::GrayImage& a, const imaging::GrayImage& b) {
    return imaging::Sad(a, b) * pixel * pixel;
  };
  struct SeenRun {
    imaging::GrayImage image;
    double weight = 0;
  };
  std::vector<SeenRun> all;
  std::vector<imaging::GrayImage> means;
  std::vector<double> weights;
  std::vector<Weighted> own;  // of each run to its draw's mean
  int num_own = 0;
  MeasuredImage image;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < weights_.size(); ++d) {
    const std::vector<imaging::GrayImage> runs = ImagesOf(d);
    if (runs.empty()) continue;
    means.push_back(imaging::MeanImage(runs));
    weights.push_back(weights_[d]);
    const auto n = static_cast<double>(runs.size());
    // Two runs are as far from their mean as each other.
    if (runs.size() > 1) num_own += runs.size() == 2 ? 1 : static_cast<int>(runs.size());
    for (const imaging::GrayImage& run : runs) {
      all.push_back({run, weights_[d] / n});
      if (n > 1) own.push_back({sad(run, means.back()) * ToAnother(1 / n), weights_[d] / n});
    }
    const double distance = sad(measured.image, means.back());
    if (!(distance < nearest)) continue;
    nearest = distance;
    image.nearest_draw = static_cast<int>(d);
  }
  if (all.empty()) return std::nullopt;
  const imaging::GrayImage mean = WeightedMean(means, weights);
  image.sad_mm2 = sad(measured.image, mean);
  const bool are_many_draws = weights_.size() == 1 || means.size() >= kFewestDrawsOfARange;
  if (all.size() >= kFewestOfARange && are_many_draws) {
    double total = 0, squares = 0;
    for (const SeenRun& run : all) total += run.weight;
    for (const SeenRun& run : all) squares += std::pow(run.weight / total, 2);
    const double another = ToAnother(squares);
    std::vector<Weighted> spread;
    for (const SeenRun& run : all) spread.push_back({sad(run.image, mean) * another, run.weight});
    image.sad_90_mm2 = Quantile90(spread);
    image.is_inside = image.sad_mm2 <= image.sad_90_mm2;
  }
  image.nearest_sad_mm2 = nearest;
  if (num_own >= kFewestOfARange) {
    image.nearest_sad_90_mm2 = Quantile90(own);
    image.nearest_is_inside = nearest <= image.nearest_sad_90_mm2;
  }
  return image;
}

}  // namespace talus::analysis
