#include "python/strategy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "base/problems.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/campaign/plan/stop.h"
#include "optimizer/space/point_rows.h"

namespace talus::python {
namespace {

namespace py = pybind11;

std::vector<float> FieldOf(const imaging::GrayImage& image) {
  std::vector<float> field;
  for (const std::uint8_t level : image.pixels) {
    field.push_back(static_cast<float>(255 - level) / 255.0F);
  }
  return field;
}

// The bounds, but for what decimals lose on their way through Python.
void RequireInside(const optimizer::Parameter& parameter, double native, double unit) {
  if (unit >= -1e-9 && unit <= 1 + 1e-9) return;  // false for NaN, too
  constexpr int kDigits = 10;  // so that a value just beyond a bound does not read as the bound
  throw base::ConfigError(parameter.name + ": " + base::ShortNumber(native, kDigits) +
                          " is outside the searched range, " +
                          base::ShortNumber(parameter.lowest(), kDigits) + " to " +
                          base::ShortNumber(parameter.highest(), kDigits));
}

// A fixed value, or one of the levels: the strategy has no other.
void RequireKnown(const optimizer::Parameter& parameter, double native, double nearest) {
  if (!parameter.fixed && parameter.levels.empty()) return;
  const double range = parameter.fixed ? 1 : parameter.highest() - parameter.lowest();
  if (std::abs(native - nearest) <= 1e-9 * std::max(std::abs(nearest), range)) return;
  throw base::ConfigError(parameter.name + ": " + base::ShortNumber(native) +
                          (parameter.fixed ? " is not what it is fixed at, "
                                           : " is none of its levels; the nearest is ") +
                          base::ShortNumber(nearest));
}

constexpr double kLargestPixel = 1e12;  // in whatever unit of area the user has

// The value of an evaluation; NaN and infinity say that it has failed.
double ValueOf(const py::handle& value) {
  const double number = NumberOf(value, "value");
  if (std::isfinite(number) && std::abs(number) > optimizer::kLargestValue) {
    throw base::ConfigError("value: is beyond 1e100, which no search can work with");
  }
  return number;
}

}  // namespace

Strategy::Strategy(const py::list& parameters, const py::dict& options, std::uint64_t seed,
                   const py::object& target, double pixel_area) {
  py::dict space;
  space["parameters"] = parameters;
  space_ =
      base::LoadOptions<optimizer::ParameterSpace>(base::ParseJson(JsonOf(space), "parameters"));
  const auto read =
      base::LoadOptions<optimizer::StrategyOptions>(base::ParseJson(JsonOf(options), "options"));
  base::Problems problems("options", {});
  read.ValidateUse(false, problems);
  problems.ThrowIfAny();
  if (!(pixel_area > 0 && pixel_area <= kLargestPixel)) {
    throw base::ConfigError("pixel_area: must be positive and at most 1e12");
  }
  if (!target.is_none()) {
    const imaging::GrayImage image = ImageOf(target, "target");
    field_ = optimizer::FieldObjective{.width = image.width,
                                       .height = image.height,
                                       .target = FieldOf(image),
                                       .sad_scale = pixel_area};
  }
  strategy_ = optimizer::MakeStrategy(read, space_.MakeDomain(), field_ ? &*field_ : nullptr, seed);
}

py::dict Strategy::Named(const Eigen::VectorXd& point) const {
  py::dict values;
  const std::vector<double> native = space_.ToNative(point);
  for (std::size_t i = 0; i < native.size(); ++i) {
    values[py::str(space_.parameters[i].name)] = native[i];
  }
  return values;
}

Eigen::VectorXd Strategy::PointOf(const py::dict& values) const {
  std::vector<double> native;
  for (const optimizer::Parameter& parameter : space_.parameters) {
    if (!values.contains(parameter.name.c_str())) {
      throw base::ConfigError(parameter.name + ": is missing among the values");
    }
    native.push_back(NumberOf(values[parameter.name.c_str()], parameter.name));
  }
  if (values.size() > native.size()) {
    throw base::ConfigError("values: have names that are no parameters'; there are " +
                            base::Joined(space_.parameters, ", ", &optimizer::Parameter::name));
  }
  const Eigen::VectorXd unit = space_.ToUnit(native);
  const std::vector<int> free = space_.Free();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto k = static_cast<std::size_t>(free[i]);
    RequireInside(space_.parameters[k], native[k], unit(static_cast<Eigen::Index>(i)));
  }
  const std::vector<double> known = space_.ToNative(unit);
  for (std::size_t k = 0; k < known.size(); ++k) {
    RequireKnown(space_.parameters[k], native[k], known[k]);
  }
  return unit;
}

py::list Strategy::Ask(int count) {
  if (count < 1 || count > 8) throw base::ConfigError("count: must be from 1 to 8");
  const std::vector<optimizer::Proposal> proposals = Asleep([&] {
    auto made = strategy_->Ask(count, pending_);
    for (const optimizer::Proposal& proposal : made) pending_.push_back(proposal.point);
    is_exhausted_ = made.empty() && pending_.empty();
    return made;
  });
  py::list asked;
  for (const optimizer::Proposal& proposal : proposals) asked.append(Named(proposal.point));
  return asked;
}

void Strategy::Tell(const py::dict& values, const py::object& value, const py::object& image,
                    bool failed) {
  if (!failed && value.is_none() && (image.is_none() || !field_)) {
    throw base::ConfigError(
        "tell: needs a value, an image of a strategy with a target, or "
        "failed=True");
  }
  if (!failed && image.is_none() && field_) {
    throw base::ConfigError("image: is missing; a strategy with a target learns from images");
  }
  if (!image.is_none() && !field_) {
    throw base::ConfigError("image: the strategy has no target to compare it with");
  }
  if (failed && !value.is_none() && std::isfinite(ValueOf(value))) {
    throw base::ConfigError(
        "value: an evaluation that has failed has none; leave it out, or failed");
  }
  optimizer::Observation observation{.point = PointOf(values), .failed = failed};
  if (!failed && !image.is_none()) {
    const imaging::GrayImage read = ImageOf(image, "image");
    if (read.width != field_->width || read.height != field_->height) {
      throw base::ConfigError("image: must have the size of the target");
    }
    observation.field = FieldOf(read);
  }
  if (!failed) {
    observation.value = value.is_none() ? field_->Value(observation.field) : ValueOf(value);
  }
  if (!std::isfinite(observation.value)) observation.failed = true;
  Asleep([&] { Learn(std::move(observation)); });
}

void Strategy::Learn(optimizer::Observation observation) {
  // What was asked for is told as it was asked, not as its decimals came back.
  const auto found =
      std::find_if(pending_.begin(), pending_.end(), [&](const Eigen::VectorXd& point) {
        return (point - observation.point).cwiseAbs().maxCoeff() < 1e-9;
      });
  if (found != pending_.end()) {
    observation.point = *found;
    pending_.erase(found);
  }
  ++(observation.failed ? num_failed_ : num_succeeded_);
  strategy_->Tell(observation);
}

std::optional<std::string> Strategy::StopReason() {
  return Asleep([&]() -> std::optional<std::string> {
    if (num_succeeded_ == 0 && num_failed_ >= static_cast<int>(campaign::kFailuresToGiveUp)) {
      return "the first " + std::to_string(num_failed_) + " evaluations all failed";
    }
    if (is_exhausted_) return "the strategy has no more points";
    const auto reason = strategy_->WhyStop();
    return reason ? std::optional(optimizer::TextOf(*reason)) : std::nullopt;
  });
}

py::dict Strategy::Answer() {
  const optimizer::Answer answer = Asleep([&] { return strategy_->Recommend(); });
  const auto known = [](double number) -> py::object {
    if (std::isnan(number)) return py::none();
    return py::float_(number);
  };
  py::dict result;
  result["values"] = Named(answer.point);
  result["predicted"] = known(answer.predicted_value);
  result["predicted_sd"] = known(answer.predicted_sd);
  result["noise_sd"] = known(answer.noise_sd);
  result["tied_volume"] = known(answer.tied_volume);
  result["is_guess"] = answer.is_guess;
  py::dict ranges;
  const std::vector<int> free = space_.Free();
  for (std::size_t i = 0; i < answer.credible.size(); ++i) {
    const optimizer::Parameter& p = space_.parameters[static_cast<std::size_t>(free[i])];
    ranges[py::str(p.name)] =
        py::make_tuple(p.ToNative(answer.credible[i].low), p.ToNative(answer.credible[i].high));
  }
  result["ranges_90"] = ranges;
  return result;
}

}  // namespace talus::python
