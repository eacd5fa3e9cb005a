#include "tests/experiments/synthetic_campaign.h"

#include <algorithm>
#include <cmath>

#include "base/not_known.h"
#include "base/random.h"
#include "experiments/campaign/answer/headline.h"
#include "imaging/heap/metrics.h"
#include "optimizer/designs/design.h"
#include "optimizer/posterior/credible_ranges.h"
#include "optimizer/strategy/make_strategy.h"

namespace talus::test {
namespace {

using optimizer::Scale;

imaging::Frame SmallFrame() {
  return {.width = 200,
          .height = 130,
          .pixel_size = 60e-6,
          .center_x = 100,
          .baseline = 122,
          .plate_diameter = 0.01};
}

// The heap's height over the axis distance: friction sets the slope, cohesion rounds the tip and
// steepens the foot, and each seed shifts it a little.
imaging::Profile DrawHeap(const std::vector<double>& set, std::uint64_t seed) {
  imaging::Profile profile{.image = {}, .frame = SmallFrame()};
  const imaging::Frame& frame = profile.frame;
  profile.image = {.width = frame.width, .height = frame.height, .pixels = {}};
  profile.image.pixels.assign(static_cast<std::size_t>(frame.width * frame.height), 255);
  base::Random random(seed, base::Stream("synthetic heap"));
  const double cohesion = std::log10(set[2] / 1e-6) / 2.6;  // 0 … 1
  const double slope = 0.25 + 0.9 * set[0] / (0.15 + set[0]) * (0.35 + 0.65 * set[1] / 0.7) +
                       0.25 * cohesion + 0.012 * random.Normal();
  const double power = 1 + 0.9 * cohesion + 0.03 * random.Normal();
  const double radius = 0.5 * frame.plate_diameter / frame.pixel_size;
  const double shift = 0.8 * random.Normal();
  for (int x = 0; x < frame.width; ++x) {
    const double across = std::abs(x + 0.5 - frame.center_x - shift) / radius;
    if (across >= 1) continue;
    const double top = 0.8 * slope * radius * (1 - std::pow(across, power));
    for (int y = 0; y < frame.baseline; ++y) {
      const double above = frame.baseline - y - 0.5 - top;  // of the outline [px]
      const double gray = std::clamp(127.5 + 127.5 * above / 4, 0.0, 255.0);
      profile.image.at(x, y) = static_cast<std::uint8_t>(gray);
    }
  }
  return profile;
}

analysis::ParameterInfo Parameter(const std::string& name, const std::string& symbol, double low,
                                  double high) {
  analysis::ParameterInfo info;
  info.range.name = name;
  info.range.low = low;
  info.range.high = high;
  info.symbol = symbol;
  info.column = name;
  return info;
}

std::vector<analysis::ParameterInfo> Parameters(int count) {
  std::vector<analysis::ParameterInfo> all{Parameter("sliding_friction", "μₜ", 0.001, 0.7),
                                           Parameter("rolling_friction", "μᵣ", 0.001, 0.7),
                                           Parameter("surface_energy", "γ", 1e-6, 4e-4)};
  all[2].range.scale = Scale::kLog;
  all[2].unit = "J/m²";
  all[2].column = "surface_energy_J_per_m2";
  all.resize(static_cast<std::size_t>(count));
  return all;
}

double ValueOrNothing(const imaging::Measured& measured) {
  return measured.defined() ? measured.value : base::kNotKnown;
}

// Where trial `i` lies: six repeats of one set first, then an even design, then ever closer to the
// truth.
Eigen::VectorXd PointOf(int i, const SyntheticOptions& options, const Eigen::VectorXd& truth,
                        const optimizer::Points& design) {
  const Eigen::Index n = truth.size();
  if (i < 6) return Eigen::VectorXd::Constant(n, 0.45);
  if (i < options.num_trials / 2) return design[static_cast<std::size_t>(i)];
  if (i >= options.num_trials - 3) return truth;
  base::Random random(7, base::Stream("synthetic search"), static_cast<std::uint64_t>(i));
  const double reach = 0.35 * (1 - static_cast<double>(i) / options.num_trials) + 0.03;
  Eigen::VectorXd point(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    point(k) = std::clamp(truth(k) + reach * random.Normal(), 0.0, 1.0);
  }
  return point;
}

journal::TrialKind KindOf(int i, int num_trials) {
  if (i < 6) return journal::TrialKind::kNoise;
  if (i >= num_trials - 3) return journal::TrialKind::kConfirm;
  return i < num_trials / 2 ? journal::TrialKind::kDesign : journal::TrialKind::kSearch;
}

std::vector<double> FullSet(std::vector<double> values) {
  values.resize(3, SyntheticTruth()[2]);
  return values;
}

analysis::TrialEvidence MakeTrial(int i, const analysis::Evidence& evidence,
                                  const SyntheticOptions& options, const Eigen::VectorXd& point) {
  base::Random random(3, base::Stream("synthetic times"), static_cast<std::uint64_t>(i));
  analysis::TrialEvidence trial;
  trial.id = i + 1;
  trial.kind = KindOf(i, options.num_trials);
  trial.point = point;
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    trial.values.push_back(
        evidence.parameters[k].range.ToNative(point(static_cast<Eigen::Index>(k))));
  }
  trial.seed = 1000 + i;
  const bool is_early =
      trial.kind == journal::TrialKind::kDesign || trial.kind == journal::TrialKind::kNoise;
  if (options.coarse_design && is_early) trial.scale_factor = 2;
  trial.seconds = 40 + 15 * random.Uniform();
  trial.cpu_seconds = 0.97 * trial.seconds;
  trial.metrics.assign(evidence.metrics.size(), base::kNotKnown);
  if (i % options.every_failed == options.every_failed - 1) {
    trial.state = journal::TrialStatus::kFailed;
    trial.reason = i % 2 == 0 ? "a velocity is not finite at step 81000"
                              : "the heap is lost: 71 % of the grains left the plate";
    return trial;
  }
  const imaging::Profile heap = *evidence.profile(trial.id);
  const auto metrics = imaging::CompareProfiles({heap, {}}, {evidence.reference.aehp, {}});
  for (std::size_t k = 0; k < metrics.size(); ++k) {
    trial.metrics[k] = ValueOrNothing(metrics[k].value);
  }
  return trial;
}

campaign::Answer MakeAnswer(const analysis::Evidence& evidence, const Eigen::VectorXd& truth) {
  campaign::Answer answer{.name = evidence.name, .talus_version = "0.1.0"};
  answer.stop = {.kind = campaign::StopKind::kRule,
                 .rule = optimizer::StopReason{
                     .rule = optimizer::StopRule::kGain, .value = 0.01, .limit = 1, .scale = 0.02}};
  answer.objective = "sad_mm2";
  answer.objective_unit = "mm²";
  answer.model = "posterior of 50 evaluations";
  answer.conditions = {
      .youngs_modulus = 26.25e6,
      .devices = {{.experiment = "heap",
                   .text = "lifted tube: plate diameter 10 mm, lift velocity 1 cm/s"}},
      .adhesion = "jkr",
      .rolling = "epsd"};
  answer.experiments = {{.name = "heap",
                         .has_image = true,
                         .num_heaps = 5,
                         .noise_floor = evidence.reference.noise_floor,
                         .noise_sd = 0.21}};
  answer.posterior = campaign::ResultPosterior{
      .region_volume = 0.034,
      .fewest_at_finest = 30,
      .experiments = {
          {.name = "heap", .predicted = 1.52, .predicted_sd = 0.08, .implausibility = 0.6}}};
  answer.warnings = {{.kind = campaign::AlarmKind::kCorrelated,
                      .parameter = "sliding_friction",
                      .other_parameter = "rolling_friction",
                      .value = -0.91}};
  if (truth.size() == 2) answer.correlation = {{1, -0.93}, {-0.93, 1}};
  std::vector<optimizer::Range> ranges;
  if (evidence.model) ranges = optimizer::CredibleRanges(evidence.model->draws);
  campaign::ResultCandidate confirmed;
  for (Eigen::Index k = 0; k < truth.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const analysis::ParameterInfo& info = evidence.parameters[i];
    const double low = ranges.empty() ? std::max(0.0, truth(k) - 0.09) : ranges[i].low;
    const double high = ranges.empty() ? std::min(1.0, truth(k) + 0.07) : ranges[i].high;
    answer.parameters.push_back({.name = info.range.name,
                                 .unit = info.unit,
                                 .value = info.range.ToNative(truth(k)),
                                 .searched_low = info.range.low,
                                 .searched_high = info.range.high,
                                 .scale = info.range.scale,
                                 .credible_low = info.range.ToNative(low),
                                 .credible_high = info.range.ToNative(high),
                                 .sobol_first = 0.5 / static_cast<double>(k + 1),
                                 .sobol_total = 0.6 / static_cast<double>(k + 1)});
    confirmed.values.push_back(answer.parameters.back().value);
  }
  confirmed.experiments = {{.name = "heap",
                            .num_trials = 3,
                            .mean = 1.61,
                            .standard_error = 0.1,
                            .sad_mm2 = 1.61,
                            .profile_sad_mm2 = 1.3,
                            .over_floor = 1.3 / evidence.reference.noise_floor}};
  answer.confirmed = {confirmed};
  campaign::ResultBranch branch{.share = 1};
  for (const campaign::ResultParameter& p : answer.parameters) {
    branch.values.push_back(p.value);
    branch.low.push_back(p.credible_low);
    branch.high.push_back(p.credible_high);
  }
  answer.posterior->branches = {branch};
  if (const auto kind = campaign::VerdictKindOf(answer)) {
    answer.verdict = {.kind = *kind, .text = campaign::HeadlineText(answer)};
  }
  return answer;
}

// More than was ever seen.
void SayMuch(campaign::Answer& answer) {
  const std::string reason =
      "the heap of this run, on the wide plate of glass, differs from those of the four others by "
      "more than they do among themselves; look at its photographs, leave it out, or make it again "
      "as the others were made, with the powder as dry, the tube as straight and the plate as "
      "clean";
  for (int i = 1; i <= 9; ++i) {
    answer.warnings.push_back({.kind = campaign::AlarmKind::kRunDisagrees,
                               .experiment = "heap",
                               .value = 3,
                               .reason = "run " + std::to_string(i) + ": " + reason});
  }
  for (int i = 2; i <= 6; ++i) {
    answer.conditions.devices.push_back(
        {.experiment = "test " + std::to_string(i) + " of the second batch",
         .text = "lifted tube: tube inner diameter 10 mm, plate diameter 30 mm, lift velocity 5 "
                 "cm/s, plate of glass"});
  }
}

constexpr double kAlong = 0.18;   // sd along the valley, unit cube
constexpr double kAcross = 0.02;  // … across it, of each parameter

// The second parameter's distance, where the first is `along` from the truth.
double Bend(double along) { return along * along - 0.8 * along; }

// Draws of a bent valley through the truth: the first two parameters are known together only.
Eigen::MatrixXd MakeDraws(const Eigen::VectorXd& truth) {
  constexpr int kDraws = 1000;
  Eigen::MatrixXd draws(kDraws, truth.size());
  base::Random random(5, base::Stream("synthetic posterior"));
  for (Eigen::Index i = 0; i < kDraws; ++i) {
    const double along = kAlong * random.Normal();
    for (Eigen::Index k = 0; k < truth.size(); ++k) {
      const double shift = k == 0 ? along : k == 1 ? Bend(along) : 0;
      draws(i, k) = std::clamp(truth(k) + shift + kAcross * random.Normal(), 0.0, 1.0);
    }
  }
  return draws;
}

// Squared distance from the truth along the valley and across it, in standard deviations.
Eigen::VectorXd SquaredDistance(const Eigen::MatrixXd& points, const Eigen::VectorXd& truth) {
  Eigen::VectorXd squared(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    Eigen::VectorXd from = points.row(i).transpose() - truth;
    const double along = from[0];
    from[0] /= kAlong;
    if (from.size() > 1) from[1] = (from[1] - Bend(along)) / (kAcross * std::hypot(1, 0.8));
    if (from.size() > 2) from[2] /= kAcross;
    squared[i] = from.squaredNorm();
  }
  return squared;
}

// The share of the draws that are nearer.
Eigen::VectorXd LevelsOf(const Eigen::MatrixXd& points, const Eigen::MatrixXd& draws,
                         const Eigen::VectorXd& truth) {
  Eigen::VectorXd sorted = SquaredDistance(draws, truth);
  std::sort(sorted.begin(), sorted.end());
  Eigen::VectorXd levels = SquaredDistance(points, truth);
  for (double& level : levels) {
    const auto nearer = std::lower_bound(sorted.begin(), sorted.end(), level) - sorted.begin();
    level = static_cast<double>(nearer) / static_cast<double>(sorted.size());
  }
  return levels;
}

analysis::ModelEvidence MakeModel(const analysis::Evidence& evidence,
                                  const Eigen::VectorXd& truth) {
  std::shared_ptr<optimizer::Strategy> strategy =
      optimizer::MakeStrategy({.kind = optimizer::StrategyKind::kGp},
                              {.num_parameters = static_cast<int>(truth.size())}, nullptr, 1);
  const std::size_t sad = *analysis::MetricColumn(evidence, "sad_mm2");
  for (const analysis::TrialEvidence& trial : evidence.trials) {
    if (trial.state != journal::TrialStatus::kOk) continue;
    strategy->Tell({.point = trial.point, .value = trial.metrics[sad]});
  }
  const optimizer::Answer answer = strategy->Recommend();
  analysis::ModelEvidence model;
  model.point = answer.point;
  model.expected = answer.predicted_value;
  model.expected_sd = answer.predicted_sd;
  model.noise_sd = answer.noise_sd;
  model.draws = MakeDraws(truth);
  model.credible_levels = [draws = model.draws, truth](const Eigen::MatrixXd& points) {
    return LevelsOf(points, draws, truth);
  };
  // The objective grows with the distance from the truth.
  model.predict = [answer, truth](const Eigen::MatrixXd& points) {
    const Eigen::ArrayXd distance = SquaredDistance(points, truth).array().sqrt();
    return optimizer::Moments{.mean = answer.predicted_value * (1 + 0.2 * distance),
                              .sd = Eigen::VectorXd::Constant(points.rows(), answer.predicted_sd)};
  };
  return model;
}

}  // namespace

std::vector<double> SyntheticTruth() { return {0.32, 0.21, 3e-5}; }

analysis::Evidence MakeSyntheticCampaign(const SyntheticOptions& options) {
  analysis::Evidence evidence;
  evidence.name = "Ti6Al4V 45–111 µm";
  evidence.objective = "sad";
  evidence.strategy = "auto";
  evidence.max_simulations = 120;
  evidence.state =
      options.concluded ? journal::CampaignState::kFinished : journal::CampaignState::kRunning;
  if (options.concluded)
    evidence.stop_reason =
        "what is left to gain, at most 0.01, is below 1 x the noise sd of one evaluation, 0.02";
  evidence.parameters = Parameters(options.num_parameters);
  evidence.versions = {{"talus", "0.1.0"}, {"compiler", "GCC 12.2.0"}};
  evidence.stages = {{"simulations", 1840}, {"proposals", 42}, {"projection and metrics", 3.1}};
  evidence.spec = "{\n  // as the user wrote it, </script> and all\n  \"name\": \"Ti6Al4V\"\n}\n";
  evidence.reference.aehp = DrawHeap(SyntheticTruth(), 999);
  evidence.reference.noise_floor = 1.3;
  const auto self =
      imaging::CompareProfiles({evidence.reference.aehp, {}}, {evidence.reference.aehp, {}});
  for (const imaging::Metric& metric : self) {
    evidence.metrics.push_back({metric.name, metric.unit});
    evidence.reference.metrics.push_back(ValueOrNothing(metric.value));
  }

  Eigen::VectorXd truth(options.num_parameters);
  for (Eigen::Index k = 0; k < truth.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    truth(k) = evidence.parameters[i].range.ToUnit(SyntheticTruth()[i]);
  }
  const auto design = optimizer::Sobol(std::max(1, options.num_trials), options.num_parameters, 1);
  std::vector<std::vector<double>> sets;
  std::vector<Eigen::VectorXd> points;
  for (int i = 0; i < options.num_trials; ++i) {
    points.push_back(PointOf(i, options, truth, design));
    std::vector<double> values;
    for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
      values.push_back(
          evidence.parameters[k].range.ToNative(points.back()(static_cast<Eigen::Index>(k))));
    }
    sets.push_back(FullSet(values));
  }
  evidence.profile = [sets](int id) -> std::optional<imaging::Profile> {
    return DrawHeap(sets[static_cast<std::size_t>(id - 1)], static_cast<std::uint64_t>(id));
  };
  for (int i = 0; i < options.num_trials; ++i) {
    evidence.trials.push_back(MakeTrial(i, evidence, options, points[static_cast<std::size_t>(i)]));
  }
  if (options.num_trials >= 20 && options.num_trials <= 200) {
    evidence.model = MakeModel(evidence, truth);
  }
  evidence.experiments = {"heap"};
  if (options.concluded) evidence.answer = MakeAnswer(evidence, truth);
  if (options.much_to_say) SayMuch(evidence.answer.value());
  return evidence;
}

}  // namespace talus::test
