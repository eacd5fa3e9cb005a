#include "optimizer/posterior/asked_gain.h"

#include <Eigen/Cholesky>

#include "optimizer/space/prior_spread.h"

namespace talus::optimizer {

AskedGain::AskedGain(const Posterior& posterior, const Domain& domain, const Eigen::MatrixXd& draws)
    : posterior_(posterior), domain_(domain), draws_(draws) {
  if (domain.nuisances.empty()) return;
  const std::ptrdiff_t size = std::ssize(domain.nuisances);
  information_.assign(static_cast<std::size_t>(draws.rows()),
                      Eigen::MatrixXd::Identity(size, size));
  for (const ExperimentModel& model : posterior.models()) {
    std::vector<Eigen::MatrixXd>& effect = effect_.emplace_back();
    for (const Eigen::Index nuisance : domain.nuisances) {
      effect.push_back(EffectOf(model, nuisance));
    }
    const Eigen::MatrixXd& variance = variance_.emplace_back(model.Outputs(draws).variance);
    for (Eigen::Index k = 0; k < model.num_outputs(); ++k) {
      Add(effect_.size() - 1, k, 1 / (variance.col(k).array() + model.open()[k]), information_);
    }
  }
}

// A central difference inside the cube.
Eigen::MatrixXd AskedGain::EffectOf(const ExperimentModel& model, Eigen::Index nuisance) const {
  constexpr double kStep = 0.1;
  Eigen::MatrixXd below = draws_;
  Eigen::MatrixXd above = draws_;
  below.col(nuisance) = (draws_.col(nuisance).array() - kStep).max(0);
  above.col(nuisance) = (draws_.col(nuisance).array() + kStep).min(1);
  const Eigen::ArrayXd per_sd = PriorSd(domain_, nuisance) / (above - below).col(nuisance).array();
  return (model.Outputs(above).mean - model.Outputs(below).mean).array().colwise() * per_sd;
}

void AskedGain::Add(std::size_t experiment, Eigen::Index output, const Eigen::ArrayXd& precision,
                    Information& information) const {
  const std::vector<Eigen::MatrixXd>& effect = effect_[experiment];
  const double weight = posterior_.models()[experiment].weight();
  Eigen::VectorXd u(std::ssize(effect));
  for (Eigen::Index i = 0; i < precision.size(); ++i) {
    for (Eigen::Index j = 0; j < u.size(); ++j) {
      u[j] = effect[static_cast<std::size_t>(j)](i, output);
    }
    information[static_cast<std::size_t>(i)] += weight * precision[i] * u * u.transpose();
  }
}

Eigen::ArrayXd AskedGain::HalfLogDet(const Information& information) const {
  Eigen::ArrayXd result = Eigen::ArrayXd::Zero(draws_.rows());
  for (Eigen::Index i = 0; i < std::ssize(information); ++i) {
    const Eigen::MatrixXd lower = information[static_cast<std::size_t>(i)].llt().matrixL();
    result[i] = lower.diagonal().array().log().sum();
  }
  return result;
}

Eigen::VectorXd AskedGain::OfAll() const {
  Eigen::ArrayXd gain = Eigen::ArrayXd::Zero(draws_.rows());
  Information information = information_;  // one experiment after another becomes known
  Eigen::ArrayXd before = HalfLogDet(information);
  for (std::size_t e = 0; e < posterior_.models().size(); ++e) {
    const ExperimentModel& model = posterior_.models()[e];
    gain += model.weight() * model.GainOfAll(draws_).array();
    if (information.empty()) continue;
    for (Eigen::Index k = 0; k < model.num_outputs(); ++k) {
      const double open = model.open()[k];
      Add(e, k, 1 / open - 1 / (variance_[e].col(k).array() + open), information);
    }
    const Eigen::ArrayXd after = HalfLogDet(information);
    gain += model.weight() * (before - after);
    before = after;
  }
  return gain;
}

Eigen::MatrixXd AskedGain::OfOne(std::size_t experiment, const Eigen::MatrixXd& sites) const {
  const ExperimentModel& model = posterior_.models()[experiment];
  if (information_.empty()) return model.weight() * model.Gains(draws_, sites);
  std::vector<Information> after;  // of each level's sites in turn
  const auto place = [&](Eigen::Index site, Eigen::Index level) {
    return static_cast<std::size_t>(level * sites.rows() + site);
  };
  const auto add = [&](const ExperimentModel::Narrowed& n) {
    const std::size_t at = place(n.site, n.level);
    if (after.size() <= at) after.resize(at + 1, information_);
    Add(experiment, n.output, 1 / n.after - 1 / n.before, after[at]);
  };
  Eigen::MatrixXd gains = model.Gains(draws_, sites, add);
  const Eigen::ArrayXd before = HalfLogDet(information_);
  for (Eigen::Index level = 0; level < gains.cols(); ++level) {
    for (Eigen::Index site = 0; site < gains.rows(); ++site) {
      gains(site, level) += (before - HalfLogDet(after[place(site, level)])).mean();
    }
  }
  return model.weight() * gains;
}

}  // namespace talus::optimizer
