// The knowledge gradient: by how much one more noisy evaluation at x lowers the minimum of the
// posterior mean, expected [frazier2009].
//
//   KG(x) = min_a μ(a) - E[min_a (μ(a) + s(a, x) Z)],   s(a, x) = Cov(a, x) / √(Var(x) + n²)
//
// Z standard normal, n the noise sd of one evaluation, a over a set A of points at which the
// minimum may be: minimisers of posterior draws. Expected improvement asks how good x itself may
// be, which crowds evaluations where differences are below the noise; KG asks what they would
// change.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "optimizer/search/model_step.h"
#include "surrogate/process/gaussian_process.h"

namespace talus::optimizer {

// Evaluations from which on the posterior of the minimiser means something.
inline constexpr int kFewestForKnowledge = 20;

// min_i mean_i - E[min_i (mean_i + slope_i Z)] in closed form, >= 0. At least one line.
double ExpectedDropOfMinimum(const Eigen::VectorXd& mean, const Eigen::VectorXd& slope);

// Points where the minimum may be, one a row: minimisers of posterior draws over candidates of the
// domain, with that of the posterior mean first.
Eigen::MatrixXd PossibleMinimisers(const ModelView& view);

// KG of one more evaluation at each point, one a row; in units of the values, >= 0.
using KnowledgeGains = std::function<Eigen::VectorXd(const Eigen::MatrixXd& points)>;

// The gains by a process of the values. It must outlive the gains.
KnowledgeGains GainsOfValues(const surrogate::GaussianProcess& process,
                             const Eigen::MatrixXd& minimisers);

// The point of the largest KG, weighted by the probability that the evaluation works, and its KG.
struct KnowledgeStep {
  Eigen::VectorXd point;
  double gain = 0;  // KG there
};
KnowledgeStep MostKnowledge(const ModelView& view, const KnowledgeGains& gains,
                            const Eigen::MatrixXd& minimisers);

}  // namespace talus::optimizer
