// What a posterior needs of the table of drums: each output of each set predicted from all other
// sets, and the program's own likelihood of them (joint_misfit.h).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "bench/optimizers/drum_sets.h"
#include "optimizer/posterior/joint_misfit.h"
#include "surrogate/process/gaussian_process.h"
#include "surrogate/process/warp.h"

namespace talus::bench {

inline constexpr double kCaution = 1.5;  // of the surrogate's sd, as the tables were made; the
                                         // program's is optimizer::SurrogateCaution

// One output at every set.
class Output {
 public:
  Output(const surrogate::GaussianProcessState& state, const Eigen::MatrixXd& sets,
         const Eigen::VectorXd& values)
      : values_(values) {
    const surrogate::Covariance covariance(surrogate::Kernel::kMatern52, state.hyper);
    const auto sites = surrogate::Sites::At(surrogate::WarpAll(sets, state.hyper.warp), 0);
    const double units = state.scale * state.scale;
    noise_ = units * (state.hyper.noise[0] * state.hyper.noise[0] + 1e-10);
    Eigen::MatrixXd k = units * covariance.Between(sites, sites);
    k.diagonal().array() += noise_;
    precision_ = k.llt().solve(Eigen::MatrixXd::Identity(k.rows(), k.cols()));
    alpha_ = precision_ * (values.array() - state.centre).matrix();
  }

  // Each set's output, predicted from all other sets.
  surrogate::Predictions LeftOut() const {
    const Eigen::ArrayXd own = precision_.diagonal();
    surrogate::Predictions at;
    at.mean = values_.array() - alpha_.array() / own;
    at.variance = (1 / own - noise_).max(0);
    return at;
  }
  // (value - prediction)/sd of each set from all others.
  Eigen::VectorXd Residuals() const {
    return alpha_.array() / precision_.diagonal().array().sqrt();
  }

  Eigen::Index size() const { return values_.size(); }
  double value(Eigen::Index set) const { return values_[set]; }
  double noise() const { return noise_; }  // variance of one image

 private:
  Eigen::VectorXd values_;
  double noise_ = 0;
  Eigen::MatrixXd precision_;
  Eigen::VectorXd alpha_;
};

struct Measurement {
  std::string name;
  std::vector<Output> outputs{};

  Eigen::Index size() const { return static_cast<Eigen::Index>(outputs.size()); }
};

// Hyper-parameters from a subset, spread over the table.
inline Measurement Learnt(const std::string& name, const Table& table,
                          const Eigen::MatrixXd& values, int subset) {
  const Eigen::Index n = values.rows();
  Measurement m{.name = name};
  std::vector<Eigen::Index> some;
  for (Eigen::Index i = 0; i < subset; ++i) some.push_back((i * 617) % n);  // prime to n
  const surrogate::GaussianProcessOptions options{
      .warp_inputs = true, .priors = surrogate::PriorsOfOutputs({{.median = 0.2, .log_sd = 0.7}})};
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const surrogate::Evaluations some_sets{.points = table.sets(Eigen::all, some).transpose(),
                                           .values = values.col(k)(some)};
    m.outputs.emplace_back(surrogate::GaussianProcess::Fit(some_sets, options).state(), table.sets,
                           values.col(k));
  }
  return m;
}

// How a likelihood is read: as the program tempers it, or untempered and to a power.
struct Reading {
  std::optional<double> power;
  bool student = false;  // a Student-t of 5 degrees of freedom all through, as the reference's
};

// The likelihood of some measurements together, of every set with every set for the truth.
class Likelihood {
 public:
  Likelihood(const std::vector<const Measurement*>& parts, bool joint) {
    if (joint) {
      groups_.push_back(GroupOf(parts));
      return;
    }
    for (const Measurement* m : parts) groups_.push_back(GroupOf({m}));
  }

  // ln p of every set when the images of set `truth` were measured.
  Eigen::VectorXd At(Eigen::Index truth, const Reading& reading) const {
    Eigen::VectorXd density = Eigen::VectorXd::Zero(groups_.front().squared.rows());
    for (const Group& g : groups_) {
      const Eigen::ArrayXd squared = g.squared.col(truth);
      const Eigen::ArrayXd log_sd = g.log_sd.col(truth);
      if (reading.student) {
        constexpr double kFreedom = 5;
        const auto outputs = static_cast<double>(g.misfit.num_outputs());
        density.array() -= log_sd + 0.5 * (kFreedom + outputs) * (squared / kFreedom).log1p();
      } else {
        const double softness = reading.power ? 1 / g.misfit.temper() : 1;  // takes the temper back
        density += g.misfit.LogDensity(squared, log_sd, softness);
      }
    }
    return reading.power.value_or(1) * density;
  }
  double temper() const { return groups_.front().misfit.temper(); }

 private:
  struct Group {
    optimizer::JointMisfit misfit;
    Eigen::MatrixXd squared;  // one truth a column
    Eigen::MatrixXd log_sd;
  };

  static Group GroupOf(const std::vector<const Measurement*>& parts) {
    Group group{.misfit = MisfitOf(parts), .squared = {}, .log_sd = {}};
    const Eigen::Index n = parts.front()->outputs.front().size();
    group.squared.resize(n, n);
    group.log_sd.setZero(n, n);
    Eigen::MatrixXd residual(n, group.misfit.num_outputs());
    for (Eigen::Index truth = 0; truth < n; ++truth) {
      Eigen::Index column = 0;
      Eigen::MatrixXd share = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(parts.size()));
      for (std::size_t e = 0; e < parts.size(); ++e) {
        const Measurement* m = parts[e];
        for (const Output& output : m->outputs) {
          const surrogate::Predictions at = output.LeftOut();
          const Eigen::ArrayXd cautious =
              kCaution * kCaution * at.variance.array() + output.noise();
          residual.col(column++) = (output.value(truth) - at.mean.array()) / cautious.sqrt();
          share.col(static_cast<Eigen::Index>(e)).array() +=
              (1 - output.noise() / cautious) / static_cast<double>(m->outputs.size());
          group.log_sd.col(truth).array() += 0.5 * (at.variance.array() + output.noise()).log();
        }
      }
      group.squared.col(truth) = group.misfit.Squared(residual, share);
    }
    return group;
  }
  static optimizer::JointMisfit MisfitOf(const std::vector<const Measurement*>& parts) {
    Eigen::MatrixXd stacked;
    std::vector<int> test;
    for (std::size_t e = 0; e < parts.size(); ++e) {
      for (const Output& output : parts[e]->outputs) {
        const Eigen::VectorXd z = output.Residuals();
        stacked.conservativeResize(z.size(), stacked.cols() + 1);
        stacked.rightCols(1) = z;
        test.push_back(static_cast<int>(e));
      }
    }
    return {stacked, test};
  }

  std::vector<Group> groups_;
};

}  // namespace talus::bench
