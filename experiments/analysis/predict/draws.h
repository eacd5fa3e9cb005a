// The sets that are predicted by: a few draws that stand for the many of a posterior, or one set.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "experiments/analysis/predict/predict_options.h"
#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

struct WeightedDraws {
  std::vector<std::vector<double>> points;  // unit cube
  std::vector<double> weights;              // sum to 1
};

// Stratified: the draws (equally likely, one a row) are parted into `count` cells of near draws
// (Lloyd's k-means from starts far apart), and one draw of each cell is taken at random with the
// cell's share as its weight. So they fill the posterior, and weighted means over them are
// unbiased. The first stand far apart, so that a few already show the range. Fewer where fewer
// draws differ.
WeightedDraws ChooseDraws(const Eigen::MatrixXd& draws, int count, std::uint64_t seed);

// Many equally likely ones of what a campaign's trials say, one a row. Throws base::Error where
// the trials are too few.
Eigen::MatrixXd PosteriorDraws(const campaign::JointView& view);

// ChooseDraws of these.
WeightedDraws PosteriorSets(const campaign::JointView& view, int count);

// Rows of `draws`, each the farthest from those before it.
std::vector<Eigen::Index> FarApart(const Eigen::MatrixXd& draws, int count);

// The one set instead of draws, in the unit cube. Throws ConfigError where the set is no set of the
// campaign, or where the recommended one is asked for and there is none yet.
Eigen::VectorXd OneSet(const campaign::JointView& view, const PredictOptions& options);

}  // namespace talus::analysis
