#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/nearest.h"
#include "base/problems.h"
#include "base/random.h"
#include "base/text/joined.h"
#include "base/units.h"
#include "experiments/analysis/batches/batch_pictures.h"
#include "experiments/analysis/batches/batch_warnings.h"
#include "experiments/analysis/batches/batches.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;
using campaign::JointView;

constexpr int kPairs = 4000;  // draws of a difference

// Values of the free parameters, one draw a row, SI.
struct Batch {
  JointView view;
  std::vector<std::vector<double>> draws;
};

std::vector<std::vector<double>> DrawsOf(const JointView& view, std::uint64_t stream) {
  const auto strategy = campaign::AnsweringStrategy(view);
  const Eigen::MatrixXd points = strategy->Sample().Draws(kPairs, view.spec.seed);
  std::vector<std::vector<double>> draws;
  for (const auto& point : points.rowwise()) {
    draws.push_back(campaign::FreeValues(view.space, point.transpose()));
  }
  // The draws of two posteriors come in the same order of the cube: pairs of them would be alike.
  base::Random random(view.spec.seed, base::Stream("pairs of batches"), stream);
  for (std::size_t i = draws.size() - 1; i > 0; --i) {
    std::swap(draws[i], draws[random.Below(i + 1)]);
  }
  return draws;
}

std::vector<double> Column(const Batch& batch, std::size_t parameter) {
  std::vector<double> values;
  for (const std::vector<double>& draw : batch.draws) values.push_back(draw[parameter]);
  return values;
}

BatchRange RangeOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {.median = at(0.5), .low = at(0.05), .high = at(0.95)};
}

bool IsLog(const journal::ParameterRecord& parameter) {
  return parameter.scale == base::NameOf(optimizer::Scale::kLog);
}

// A value on the scale that the parameter is searched on.
double Scaled(const journal::ParameterRecord& parameter, double value) {
  return IsLog(parameter) ? std::log(value) : value;
}

double Unscaled(const journal::ParameterRecord& parameter, double value) {
  return IsLog(parameter) ? std::exp(value) : value;
}

// How parameter `p` differs; `matters` as in BatchDifference.
BatchDifference DifferenceOf(const Batch& first, const Batch& batch, std::size_t p,
                             double matters) {
  const journal::ParameterRecord& parameter = first.view.record.parameters[p];
  std::vector<double> difference;
  for (std::size_t i = 0; i < first.draws.size(); ++i) {
    difference.push_back(Scaled(parameter, batch.draws[i][p]) -
                         Scaled(parameter, first.draws[i][p]));
  }
  const double least = Scaled(parameter, matters);
  const auto larger =
      std::ranges::count_if(difference, [&](double d) { return std::abs(d) > least; });
  const BatchRange range = RangeOf(difference);
  return {.range = {.median = Unscaled(parameter, range.median),
                    .low = Unscaled(parameter, range.low),
                    .high = Unscaled(parameter, range.high)},
          .matters = matters,
          .probability = static_cast<double>(larger) / static_cast<double>(difference.size()),
          .is_found = range.low > 0 || range.high < 0};
}

bool IsNuisance(const Batch& batch, std::size_t parameter) {
  const optimizer::ParameterSpace& space = batch.view.space;
  return space.parameters[static_cast<std::size_t>(space.Free()[parameter])].is_nuisance;
}

// Those that are asked for.
std::vector<std::size_t> AskedOf(const Batch& batch) {
  std::vector<std::size_t> asked;
  for (std::size_t p = 0; p < batch.view.record.parameters.size(); ++p) {
    if (!IsNuisance(batch, p)) asked.push_back(p);
  }
  return asked;
}

// A batch's draws of what is asked for, on the scales of the first batch's parameters.
Eigen::MatrixXd ScaledDraws(const Batch& batch, const Batch& first) {
  const auto& parameters = first.view.record.parameters;
  const std::vector<std::size_t> asked = AskedOf(first);
  Eigen::MatrixXd scaled(static_cast<Eigen::Index>(batch.draws.size()),
                         static_cast<Eigen::Index>(asked.size()));
  for (Eigen::Index i = 0; i < scaled.rows(); ++i) {
    for (Eigen::Index k = 0; k < scaled.cols(); ++k) {
      const std::size_t p = asked[static_cast<std::size_t>(k)];
      scaled(i, k) = Scaled(parameters[p], batch.draws[static_cast<std::size_t>(i)][p]);
    }
  }
  return scaled;
}

BatchTogether TogetherOf(const Batch& first, const Batch& batch) {
  const double level = LevelOfNone(ScaledDraws(batch, first) - ScaledDraws(first, first));
  return {batch.view.folder.root.string(), level, level > optimizer::kRegionLevel};
}

std::vector<std::string> NamesOf(const Batch& batch) {
  std::vector<std::string> names;
  for (const journal::ParameterRecord& p : batch.view.record.parameters) names.push_back(p.name);
  return names;
}

void RequireSameParameters(const std::vector<Batch>& batches) {
  for (const Batch& batch : batches) {
    if (NamesOf(batch) == NamesOf(batches.front())) continue;
    throw base::ConfigError(
        batch.view.folder.root.string() + ": has searched other parameters than " +
        batches.front().view.folder.root.string() + "; batches are compared by the same ones");
  }
}

// As it is given; of a logarithmic parameter a factor.
double MatterOf(const journal::ParameterRecord& parameter, const std::string& text) {
  try {
    return IsLog(parameter) ? base::ParseQuantity(text, base::Dimension::kNone)
                            : campaign::ParseProperty(parameter.name, text);
  } catch (const base::ConfigError& error) {
    throw base::ConfigError("--matters " + parameter.name + ": " + error.what() +
                            (IsLog(parameter) ? "; it was searched on a logarithmic scale: give a "
                                                "factor, such as 1.5"
                                              : ""));
  }
}

// A tenth of the searched range.
double UsualMatter(const journal::ParameterRecord& parameter) {
  constexpr double kShare = 0.1;
  return Unscaled(parameter,
                  kShare * (Scaled(parameter, parameter.high) - Scaled(parameter, parameter.low)));
}

std::vector<double> MattersOf(const Batch& first, const std::map<std::string, std::string>& given) {
  std::vector<double> matters;
  base::Problems problems;
  const std::vector<std::string> names = NamesOf(first);
  for (const journal::ParameterRecord& p : first.view.record.parameters) {
    const auto own = given.find(p.name);
    matters.push_back(own == given.end() ? UsualMatter(p) : MatterOf(p, own->second));
    problems.Require(
        matters.back() > (IsLog(p) ? 1 : 0), "--matters " + p.name, matters.back(),
        IsLog(p) ? "must be a factor above 1: the scale is logarithmic" : "must be positive");
  }
  for (const auto& [name, value] : given) {
    if (std::ranges::find(names, name) != names.end()) continue;
    problems.Add(name, "is no calibrated parameter of these campaigns" +
                           base::DidYouMean(name, names) + "; there are " + base::Listed(names));
  }
  problems.ThrowIfAny();
  return matters;
}

// A stated error is known as well as the heaps tell it that were photographed beside it.
KnownError ErrorOf(const journal::ScalarRecord& number, const journal::ExperimentRecord& e) {
  const int degrees = number.degrees > 0 ? number.degrees : e.num_heaps - 1;
  return {.value = number.standard_error,
          .degrees = degrees > 0 ? degrees : std::numeric_limits<double>::infinity()};
}

// The numbers that both have measured in the first batch's experiment `e`.
void CompareNumbers(const Batch& first, const Batch& batch, std::size_t e,
                    std::vector<BatchNumber>& numbers) {
  const journal::ExperimentRecord& a = first.view.record.experiments[e];
  const auto& others = batch.view.record.experiments;
  const auto b = std::ranges::find(others, a.name, &journal::ExperimentRecord::name);
  if (b == others.end()) return;
  for (const journal::ScalarRecord& of_first : a.scalars) {
    const auto found = std::ranges::find(b->scalars, of_first.name, &journal::ScalarRecord::name);
    if (found == b->scalars.end()) continue;
    const KnownError error = ErrorOfDifference(ErrorOf(*found, *b), ErrorOf(of_first, a));
    BatchNumber number{.batch = batch.view.folder.root.string(),
                       .experiment = a.name,
                       .name = of_first.name,
                       .difference = found->value - of_first.value,
                       .standard_error = error.value};
    number.probability = ChanceOf(number.difference, error);
    numbers.push_back(std::move(number));
  }
}

}  // namespace

double LevelOfNone(Eigen::MatrixXd difference) {
  const Eigen::RowVectorXd mean = difference.colwise().mean();
  difference.rowwise() -= mean;
  const Eigen::LDLT<Eigen::MatrixXd> covariance(difference.transpose() * difference /
                                                static_cast<double>(difference.rows()));
  const auto square = [&](const Eigen::RowVectorXd& d) {
    return d.dot(covariance.solve(d.transpose()));
  };
  const double of_none = square(mean);
  Eigen::Index nearer = 0;
  for (const auto& draw : difference.rowwise()) nearer += square(draw) < of_none;
  return static_cast<double>(nearer) / static_cast<double>(difference.rows());
}

namespace {

// By whatever names: two that are one and the same show no difference of anything.
void RequireOtherFolders(const std::vector<fs::path>& folders) {
  for (std::size_t i = 0; i < folders.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      std::error_code absent;
      if (!fs::equivalent(folders[k], folders[i], absent)) continue;
      throw base::ConfigError(folders[i].string() +
                              ": is named twice; a batch is compared with another one");
    }
  }
}

std::vector<BatchParameter> ParametersOf(const std::vector<Batch>& batches,
                                         const std::vector<double>& counts) {
  std::vector<BatchParameter> parameters;
  for (std::size_t p = 0; p < counts.size(); ++p) {
    const journal::ParameterRecord& record = batches.front().view.record.parameters[p];
    BatchParameter parameter{.name = record.name,
                             .unit = record.unit,
                             .scale = record.scale,
                             .is_nuisance = IsNuisance(batches.front(), p)};
    for (std::size_t b = 0; b < batches.size(); ++b) {
      parameter.batches.push_back(RangeOf(Column(batches[b], p)));
      if (b == 0) continue;
      parameter.differences.push_back(DifferenceOf(batches.front(), batches[b], p, counts[p]));
    }
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

// What was measured of each batch beside that of the first, and all parameters at once.
void AddMeasured(const std::vector<Batch>& batches, BatchComparison& comparison) {
  const Batch& first = batches.front();
  for (std::size_t b = 1; b < batches.size(); ++b) {
    comparison.together.push_back(TogetherOf(first, batches[b]));
    for (std::size_t e = 0; e < first.view.record.experiments.size(); ++e) {
      CompareNumbers(first, batches[b], e, comparison.numbers);
      if (!first.view.references[e].has_image()) continue;
      comparison.pictures.push_back(ComparePictures(first.view, batches[b].view, e));
    }
  }
}

// What follows from all of that, and what it is to be read with.
void AddVerdicts(const std::vector<Batch>& batches, BatchComparison& comparison) {
  const auto warn = [&](const std::vector<std::string>& more) {
    comparison.warnings.insert(comparison.warnings.end(), more.begin(), more.end());
  };
  const JointView& first = batches.front().view;
  for (std::size_t b = 1; b < batches.size(); ++b) {
    comparison.verdicts.push_back(VerdictOf(comparison, b));
    if (const std::string engine = OtherEngine(first, batches[b].view); !engine.empty()) {
      comparison.other_engines.push_back(engine);
    }
    warn(OtherConditions(first, batches[b].view));
    if (std::string prior = CommonPrior(first, batches[b].view); !prior.empty()) {
      comparison.warnings.push_back(std::move(prior));
    }
  }
  for (const Batch& batch : batches) warn(AlarmsOf(batch.view));
}

}  // namespace

BatchComparison CompareBatches(const std::vector<fs::path>& folders,
                               const std::map<std::string, std::string>& matters) {
  std::vector<Batch> batches;
  BatchComparison comparison;
  for (const fs::path& folder : folders) {
    batches.push_back({.view = campaign::ReadJointView(folder), .draws = {}});
    comparison.batches.push_back(folder.string());
  }
  RequireSameParameters(batches);
  const std::vector<double> counts = MattersOf(batches.front(), matters);
  RequireOtherFolders(folders);
  for (std::size_t b = 0; b < batches.size(); ++b) {
    batches[b].draws = DrawsOf(batches[b].view, b);
  }
  comparison.parameters = ParametersOf(batches, counts);
  AddMeasured(batches, comparison);
  AddVerdicts(batches, comparison);
  return comparison;
}

}  // namespace talus::analysis
