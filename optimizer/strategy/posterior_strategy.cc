#include "optimizer/strategy/posterior_strategy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/random.h"
#include "optimizer/designs/points_within.h"
#include "optimizer/designs/posterior_design.h"
#include "optimizer/outputs/output_model.h"
#include "optimizer/posterior/learn_model_errors.h"
#include "optimizer/search/feasibility.h"
#include "optimizer/search/history.h"
#include "optimizer/search/size_to_fit.h"
#include "optimizer/strategy/observed_misses.h"

namespace talus::optimizer {
namespace {

constexpr double kEdgeError =
    0.1;                          // of the powder: above it, heaps overhang and pixels serve better
constexpr double kExploring = 4;  // softness of every other sample of candidates
constexpr int kCandidates = 48;

// Σ |image - what its column edges make of it| / Σ image, at most 1: an image without powder must
// not outvote the others.
double EdgeError(const surrogate::FieldCode& code, const std::vector<float>& field,
                 const Eigen::VectorXd& vector) {
  const std::vector<float> decoded = code.Decode(vector);
  double error = 0;
  double powder = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    error += std::abs(static_cast<double>(field[i]) - static_cast<double>(decoded[i]));
    powder += field[i];
  }
  return std::min(1.0, error / std::max(powder, 1.0));
}

// Leaves so many, evenly in their order.
void KeepSpread(std::vector<const Observation*>& list, std::size_t most) {
  if (list.size() <= most) return;
  for (std::size_t i = 0; i < most; ++i) list[i] = list[i * list.size() / most];
  list.resize(most);
}

}  // namespace

std::size_t PosteriorStrategy::Told::code() const {
  return codes.empty() || edge_error <= kEdgeError * size() ? 0 : 1;
}

PosteriorStrategy::PosteriorStrategy(const PosteriorStrategyOptions& options, const Domain& domain,
                                     std::vector<ExperimentTarget> targets)
    : options_(options),
      domain_(domain),
      levels_(options.scale_factors, options.target),
      targets_(std::move(targets)) {
  const int size = PosteriorDesignSize(domain_, options_.num_initial);
  const Points points = PosteriorDesign(domain_, size, options_.seed);
  design_.resize(static_cast<Eigen::Index>(points.size()), domain_.num_parameters);
  for (Eigen::Index i = 0; i < design_.rows(); ++i) {
    design_.row(i) = points[static_cast<std::size_t>(i)];
  }
  for (const ExperimentTarget& target : targets_) {
    Told told;
    if (target.image.width > 0) {
      const surrogate::FieldSize field{.width = target.image.width, .height = target.image.height};
      told.codes = {std::make_shared<surrogate::EdgeCode>(field, target.image.target),
                    std::make_shared<surrogate::PixelCode>(field, target.image.target)};
    }
    told.by_code.resize(std::max<std::size_t>(1, told.codes.size()));
    told.cost.resize(static_cast<std::size_t>(levels_.size()));
    told.count.resize(static_cast<std::size_t>(levels_.size()));
    told_.push_back(std::move(told));
  }
}

void PosteriorStrategy::Tell(const Observation& observation) {
  posterior_.reset();
  sample_.reset();
  asked_.reset();
  asked_sample_.reset();
  outlook_.reset();
  answer_.reset();
  observations_.push_back(WithoutImage(observation));
  Told& told = told_[static_cast<std::size_t>(observation.experiment)];
  const int level = levels_.LevelOf(observation.scale_factor);
  if (observation.cost > 0) {
    told.cost[static_cast<std::size_t>(level)] += observation.cost;
    ++told.count[static_cast<std::size_t>(level)];
  }
  // An image that was lost leaves nothing to learn from.
  if (observation.failed || (!told.codes.empty() && observation.field.empty())) return;
  const ExperimentTarget& target = targets_[static_cast<std::size_t>(observation.experiment)];
  told.misses.push_back(told.codes.empty() ? MissOfNumbers(observation, target.scalars)
                                           : observation.value);
  told.place.push_back(observations_.size() - 1);
  for (std::size_t c = 0; c < told.by_code.size(); ++c) {
    OutputData& data = told.by_code[c];
    data.points.push_back(observation.point);
    data.level.push_back(level);
    data.scalars.push_back(observation.scalars);
    if (!told.codes.empty()) data.vectors.push_back(told.codes[c]->Encode(observation.field));
  }
  if (!told.codes.empty()) {
    told.edge_error +=
        EdgeError(*told.codes.front(), observation.field, told.by_code.front().vectors.back());
  }
}

// Whether the first `number` evaluations tell anything: images that are all the same have no
// modes, and a number that is undefined in all of them, or in all but one, no surrogate.
bool PosteriorStrategy::Told::TellsBy(int number) const {
  const OutputData& data = by_code[code()];
  const std::vector<std::size_t> rows = RowsToModel(data, misses, number);
  const std::size_t num_scalars = data.scalars[rows.front()].size();
  for (std::size_t s = 0; s < num_scalars; ++s) {
    const auto num_defined = std::ranges::count_if(
        rows, [&](std::size_t row) { return std::isfinite(data.scalars[row][s]); });
    if (num_defined < 2) return false;
  }
  if (num_scalars > 0) return true;
  return std::ranges::any_of(
      rows, [&](std::size_t row) { return data.vectors[row] != data.vectors[rows.front()]; });
}

OutputData PosteriorStrategy::Told::FirstOf(int number) const {
  const OutputData& data = by_code[code()];
  return Modelled(data, RowsToModel(data, misses, number));
}

bool PosteriorStrategy::CanModel() const {
  return std::all_of(told_.begin(), told_.end(), [](const Told& told) {
    return told.size() >= kFewest && told.TellsBy(SizeToFit(told.size(), kFewest)) &&
           told.TellsBy(told.size());
  });
}

ExperimentModel::Setup PosteriorStrategy::SetupOf(std::size_t experiment) const {
  const Told& told = told_[experiment];
  return {.target = &targets_[experiment],
          .code = told.codes.empty() ? nullptr : told.codes[told.code()],
          .levels = &levels_,
          .model_error = options_.model_error};
}

// Where the simulations of an experiment give all that it has measured: they may crash, and a
// number may not exist. One model for all numbers: what takes one away may take the others, too.
void PosteriorStrategy::CountSuccesses(std::size_t experiment, Posterior& posterior) const {
  std::vector<const Observation*> all;
  for (const Observation& told : observations_) {
    if (told.experiment == static_cast<int>(experiment)) all.push_back(&told);
  }
  const auto gives = [](const Observation* told) {
    const auto exists = [](double number) { return std::isfinite(number); };
    return !told->failed && std::ranges::all_of(told->scalars, exists);
  };
  if (std::ranges::all_of(all, gives)) return;
  KeepSpread(all, kMostEvaluations);  // of both alike: their shares are what is modelled
  const auto failed = std::stable_partition(all.begin(), all.end(), gives);
  const auto num = static_cast<Eigen::Index>(all.size());
  Eigen::MatrixXd points(num, domain_.num_parameters);
  Eigen::VectorXd worked = Eigen::VectorXd::Zero(num);
  worked.head(failed - all.begin()).setOnes();
  for (Eigen::Index i = 0; i < num; ++i) points.row(i) = all[static_cast<std::size_t>(i)]->point;
  posterior.CountSuccesses(experiment, SuccessModel(points, worked));
}

Posterior PosteriorStrategy::MakePosterior() {
  std::vector<ExperimentModel> models;
  std::vector<OutputData> data;
  for (std::size_t e = 0; e < told_.size(); ++e) {
    Told& told = told_[e];
    const std::size_t code = told.code();
    const ExperimentModel::Setup setup = SetupOf(e);
    data.push_back(told.FirstOf(told.size()));
    const int count = SizeToFit(told.size(), kFewest);
    if (!told.state || told.num_fitted != count || told.fitted_code != code) {
      const ExperimentModel fitted(setup, told.FirstOf(count), nullptr);
      told.state = fitted.state();
      told.num_fitted = count;
      told.fitted_code = code;
    }
    models.emplace_back(setup, data.back(), &*told.state);
  }
  Posterior posterior(std::move(models), data, domain_.prior);
  for (std::size_t e = 0; e < told_.size(); ++e) CountSuccesses(e, posterior);
  if (options_.learn_model_error) {
    LearnModelErrors(domain_, options_.model_error, options_.seed, posterior);
  }
  return posterior;
}

const Posterior& PosteriorStrategy::Model() {
  if (!posterior_) posterior_.emplace(MakePosterior());
  return *posterior_;
}

PosteriorSample PosteriorStrategy::SampleOf(const Posterior& posterior, int divisor) const {
  const int start = domain_.num_parameters <= 2 ? 3000 : 6000;
  return posterior.Sample(domain_, start / divisor, 1, options_.seed);
}

const PosteriorSample& PosteriorStrategy::Sample() {
  if (!sample_) sample_ = SampleOf(Model());
  return *sample_;
}

const AskedDensity& PosteriorStrategy::Asked() {
  if (!asked_) {
    const auto density = [this](const Eigen::MatrixXd& points) {
      return Model().LogDensity(points);
    };
    asked_.emplace(density, domain_, Sample(), options_.seed);
  }
  return *asked_;
}

const PosteriorSample& PosteriorStrategy::AskedSample() {
  if (!asked_sample_) asked_sample_ = Asked().Sample(Sample());
  return *asked_sample_;
}

double PosteriorStrategy::CostOf(std::size_t experiment, int level) const {
  const auto l = static_cast<std::size_t>(level);
  const Told& told = told_[experiment];
  if (told.count[l] > 0) return told.cost[l] / told.count[l];
  const std::vector<double>& estimates = targets_[experiment].costs;
  if (l < estimates.size() && estimates[l] > 0) return estimates[l];
  return std::pow(levels_.factor(level), -4);
}

std::vector<Proposal> PosteriorStrategy::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  std::vector<Proposal> asked;
  for (const Eigen::VectorXd& point : pending) {
    asked.push_back({.point = point, .scale_factor = levels_.factor(0)});
  }
  return AskAt(count, asked);
}

std::vector<Proposal> PosteriorStrategy::AskAt(int count, std::span<const Proposal> pending) {
  std::vector<Proposal> asked(pending.begin(), pending.end());
  for (int i = 0; i < count; ++i) asked.push_back(Next(asked));
  return {asked.begin() + static_cast<std::ptrdiff_t>(pending.size()), asked.end()};
}

Proposal PosteriorStrategy::Next(std::span<const Proposal> asked) {
  if (auto first = FromDesign(asked)) return *first;
  if (CanModel()) return ByGain(asked);
  // Too few successes to fit a model: on with Sobol's sequence.
  const int index = static_cast<int>(observations_.size() + asked.size());
  const Eigen::VectorXd point = SobolPoint(domain_, index, options_.seed);
  return {.point = point,
          .origin = Origin::kDesign,
          .experiment = index % static_cast<int>(targets_.size()),
          .scale_factor = levels_.factor(0)};
}

Proposal PosteriorStrategy::ByGain(std::span<const Proposal> asked) {
  const std::size_t turn = observations_.size() + asked.size();
  const std::uint64_t seed = options_.seed + 7919 * turn;
  Posterior with_fantasies = Model();
  for (const Proposal& p : asked) {
    with_fantasies.models()[static_cast<std::size_t>(p.experiment)].AddFantasy(
        p.point, levels_.LevelOf(p.scale_factor));
  }
  const double softness = turn % 2 == 0 ? 1 : kExploring;
  const int start = domain_.num_parameters <= 2 ? 1000 : 2000;
  const PosteriorSample sample = Model().Sample(domain_, start, softness, seed);
  const Eigen::MatrixXd draws = sample.Draws(kCandidates, seed);
  const AskedGain gain(with_fantasies, domain_, draws);
  const Feasibility feasibility(MakeHistory(observations_, domain_.num_parameters));
  const Eigen::VectorXd score = gain.OfAll() + feasibility.Penalty(draws);
  constexpr Eigen::Index kBest = 6;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(draws.rows()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return score[a] > score[b]; });
  order.resize(std::min<std::size_t>(order.size(), kBest));
  const Eigen::MatrixXd sites = draws(order, Eigen::all);
  if (auto few = TooFewAt(sites.row(0), asked)) return *few;
  return MostPerCost(gain, sites, Price(asked));
}

// Where more of their number is used up than of the core time, an even share of the time that is
// left: coarse grains, which cost next to none, would use up the number and leave the time.
double PosteriorStrategy::Price(std::span<const Proposal> asked) const {
  const auto used = static_cast<double>(
      std::ranges::count_if(observations_, &Observation::is_paid_for) + std::ssize(asked));
  if (options_.core_time <= 0 || used >= options_.simulations) return 0;
  double spent = 0;
  const auto usual = [&](const auto& evaluation) {
    return CostOf(static_cast<std::size_t>(evaluation.experiment),
                  levels_.LevelOf(evaluation.scale_factor));
  };
  for (const Observation& o : observations_) {
    if (o.is_paid_for) spent += o.cost > 0 ? o.cost : usual(o);
  }
  for (const Proposal& p : asked) spent += usual(p);
  if (used / options_.simulations <= spent / options_.core_time) return 0;
  return (options_.core_time - spent) / (options_.simulations - used);
}

Proposal PosteriorStrategy::MostPerCost(const AskedGain& gain, const Eigen::MatrixXd& sites,
                                        double price) const {
  Proposal best;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < targets_.size(); ++e) {
    const Eigen::MatrixXd gains = gain.OfOne(e, sites);
    for (Eigen::Index i = 0; i < sites.rows(); ++i) {
      for (int level = 0; level < levels_.size(); ++level) {
        const double rate = gains(i, level) / (CostOf(e, level) + price);
        if (rate <= most) continue;
        most = rate;
        best = {.point = sites.row(i),
                .origin = Origin::kModel,
                .experiment = static_cast<int>(e),
                .scale_factor = levels_.factor(level)};
      }
    }
  }
  return best;
}

std::optional<Moments> PosteriorStrategy::Predict(const Eigen::MatrixXd& points, int experiment) {
  if (!CanModel()) return std::nullopt;
  const ExperimentModel& model = Model().models()[static_cast<std::size_t>(experiment)];
  if (!model.has_image()) return std::nullopt;
  return model.Objective(points);
}

}  // namespace talus::optimizer
