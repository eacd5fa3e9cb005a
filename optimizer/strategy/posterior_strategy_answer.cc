// What the posterior's search answers.
#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "base/text/counted.h"
#include "optimizer/posterior/branches.h"
#include "optimizer/posterior/credible_ranges.h"
#include "optimizer/posterior/sample_statistics.h"
#include "optimizer/posterior/sobol_indices.h"
#include "optimizer/search/describe_minimum.h"
#include "optimizer/search/history.h"
#include "optimizer/space/point_rows.h"
#include "optimizer/strategy/observed_misses.h"
#include "optimizer/strategy/posterior_strategy.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

constexpr int kAnswerDraws = 2000;

}  // namespace

std::vector<double> PosteriorStrategy::UnlearntScaleFactors() const {
  constexpr int kEnough = 2;
  std::vector<double> unlearnt;
  for (int level = 0; level < levels_.size(); ++level) {
    for (std::size_t e = 0; e < told_.size(); ++e) {
      if (targets_[e].weight == 0) continue;  // held out: the answer does not rest on it
      const std::vector<int>& levels = told_[e].by_code.front().level;
      const bool few = std::count(levels.begin(), levels.end(), level) < kEnough;
      const bool is_target = level == levels_.finest() && !levels_.is_extrapolated();
      if (few && (is_target || level == 0)) unlearnt.push_back(levels_.factor(level));
    }
  }
  unlearnt.erase(std::unique(unlearnt.begin(), unlearnt.end()), unlearnt.end());
  return unlearnt;
}

int PosteriorStrategy::FewestAtFinest() const {
  std::ptrdiff_t fewest = std::numeric_limits<int>::max();
  for (std::size_t e = 0; e < told_.size(); ++e) {
    if (targets_[e].weight == 0) continue;
    const std::vector<int>& levels = told_[e].by_code.front().level;
    fewest = std::min(fewest, std::ranges::count(levels, levels_.finest()));
  }
  return static_cast<int>(fewest);
}

std::vector<NuisanceWeight> PosteriorStrategy::NuisanceWeights(const Eigen::MatrixXd& draws) const {
  std::vector<NuisanceWeight> weights;
  for (const Eigen::Index nuisance : domain_.nuisances) {
    NuisanceWeight weight{.coordinate = nuisance};
    for (const Eigen::Index other : domain_.Asked()) {
      const double narrowing = Narrowing(draws, nuisance, other);
      if (narrowing < weight.narrowing) continue;
      weight.narrowing = narrowing;
      weight.other = other;
    }
    weights.push_back(weight);
  }
  return weights;
}

void PosteriorStrategy::AddPrior(PosteriorSummary& summary) const {
  summary.prior_offset = domain_.prior.Offset(summary.draws);
  if (domain_.prior.IsUniform()) return;
  const Eigen::Index count = summary.draws.rows();
  summary.prior_draws =
      Inside(domain_, domain_.prior.Draw(count, domain_.num_parameters, options_.seed));
}

void PosteriorStrategy::Summarise(Answer& answer) {
  const Posterior& posterior = Model();
  PosteriorSummary summary{.draws = Sample().Draws(kAnswerDraws, options_.seed),
                           .region_volume = AskedSample().RegionVolume(),
                           .branches = FindBranches(Asked(), AskedSample(), options_.seed),
                           .temper = posterior.temper(),
                           .raw_coverage = posterior.coverage().raw,
                           .tempered_coverage = posterior.coverage().tempered,
                           .num_left_out = posterior.coverage().count,
                           .target_scale_factor = levels_.target(),
                           .is_extrapolated = levels_.is_extrapolated(),
                           .unlearnt_scale_factors = UnlearntScaleFactors(),
                           .fewest_at_finest = FewestAtFinest(),
                           .experiments = {}};
  summary.surrogate_narrowing = *std::ranges::max_element(OutlookNow().all);
  answer.point = summary.branches.front().point;
  summary.nuisances = NuisanceWeights(summary.draws);
  AddPrior(summary);
  summary.experiments = posterior.StandingsAt(answer.point);
  answer.posterior = std::move(summary);
}

Answer PosteriorStrategy::RecommendUnmodelled() const {
  const std::vector<Observation> misses = WithMisses(observations_, targets_);
  Answer answer = BestObserved(misses, domain_, "the posterior's search");
  answer.predicted_value = 0;
  for (const Observation& told : observations_) {
    const bool has_image = targets_[static_cast<std::size_t>(told.experiment)].image.width > 0;
    if (told.failed || !has_image || !surrogate::SamePoint(told.point, answer.point)) continue;
    answer.predicted_value = told.value;
    break;
  }
  return answer;
}

// A campaign that ends asks four times.
Answer PosteriorStrategy::Recommend() {
  if (!answer_) answer_ = CanModel() ? RecommendModelled() : RecommendUnmodelled();
  return *answer_;
}

Answer PosteriorStrategy::RecommendModelled() {
  constexpr int kMostTied = 200;
  Answer answer;
  Summarise(answer);
  const PosteriorSummary& summary = *answer.posterior;
  answer.credible = AskedRanges(summary.draws, domain_.nuisances);
  answer.correlation = RankCorrelation(summary.draws);
  for (int i = 0; i < kMostTied; ++i) {
    answer.tied.push_back(summary.draws.row(i * summary.draws.rows() / kMostTied));
  }
  answer.tied_volume = summary.region_volume;
  answer.warnings = BoundWarnings(answer.point);
  std::erase_if(answer.warnings, [&](const BoundWarning& bound) {
    return std::ranges::count(domain_.nuisances, bound.parameter) > 0;
  });
  const std::vector<ExperimentModel>& models = Model().models();
  const auto image = std::ranges::find_if(
      models, [](const ExperimentModel& m) { return m.has_image() && m.weight() > 0; });
  if (image != models.end()) {
    const Moments at = image->Objective(answer.point.transpose());
    answer.predicted_value = at.mean[0];
    answer.predicted_sd = at.sd[0];
    answer.noise_sd = image->ObjectiveNoise(answer.point);
    const SobolIndices sobol = EstimateSobolIndices(
        [&](const Eigen::MatrixXd& points) { return image->OutlinedObjective(points); },
        {.dimension = domain_.num_parameters, .num_base = 512, .seed = options_.seed});
    answer.sobol_first = sobol.first;
    answer.sobol_total = sobol.total;
  }
  char text[200];
  std::snprintf(text, sizeof text,
                "posterior of %zu evaluations at %s; leave-one-out coverage of 90 %% "
                "regions %.0f %%, %.0f %% after tempering by %.2f",
                observations_.size(), base::Counted(levels_.size(), "scale factor").c_str(),
                100 * summary.raw_coverage, 100 * summary.tempered_coverage, summary.temper);
  answer.model = text;
  return answer;
}

AnswerIfShifted PosteriorStrategy::IfShifted(const std::vector<ShiftBySet>& shifts) {
  Posterior moved = Model();
  moved.ShiftOutputs(shifts);
  const PosteriorSample joint = SampleOf(moved);
  const AskedDensity asked([&](const Eigen::MatrixXd& points) { return moved.LogDensity(points); },
                           domain_, joint, options_.seed);
  AnswerIfShifted answer{
      .point = FindBranches(asked, asked.Sample(joint), options_.seed).front().point,
      .credible = AskedRanges(joint.Draws(kAnswerDraws, options_.seed), domain_.nuisances)};
  // What fits with the shift there fits without where so much less was measured.
  for (std::size_t e = 0; e < shifts.size(); ++e) {
    moved.models()[e].MoveMeasured(-shifts[e](answer.point.transpose()).transpose());
    answer.implausibility = std::max(answer.implausibility, moved.Implausibility(e, answer.point));
  }
  return answer;
}

std::optional<Eigen::VectorXd> PosteriorStrategy::CredibleLevels(const Eigen::MatrixXd& points) {
  if (!CanModel()) return std::nullopt;
  const PosteriorSample& sample = AskedSample();
  return Asked().LogDensity(points).unaryExpr(
      [&](double log_density) { return sample.CredibleLevel(log_density); });
}

std::optional<Standing> PosteriorStrategy::Consider(const Eigen::VectorXd& point) {
  if (!CanModel()) return std::nullopt;
  Standing standing;
  standing.credible_level = (*CredibleLevels(point.transpose()))[0];
  standing.experiments = Model().StandingsAt(point);
  return standing;
}

}  // namespace talus::optimizer
