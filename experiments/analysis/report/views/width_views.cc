#include "experiments/analysis/report/views/width_views.h"

#include <cmath>

#include "experiments/analysis/report/views/answer_words.h"
#include "optimizer/posterior/credible_ranges.h"

namespace talus::analysis {
namespace {

WidthView Empty(const Evidence& evidence, const std::string& title, const std::string& means) {
  const std::vector<double> none(evidence.parameters.size(), kUndefined);
  return {.title = title, .means = means, .low = none, .high = none};
}

void Set(const Evidence& evidence, std::size_t k, const optimizer::Range& range, WidthView& view) {
  view.low[k] = evidence.parameters[k].range.ToNative(range.low);
  view.high[k] = evidence.parameters[k].range.ToNative(range.high);
}

WidthView Stated(const Evidence& evidence) {
  WidthView view = Empty(evidence, "Stated range",
                         "90 % for all parameters at once; what tolerances are made of, and what "
                         "talus next starts from");
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    view.low[k] = evidence.answer->parameters[k].credible_low;
    view.high[k] = evidence.answer->parameters[k].credible_high;
  }
  return view;
}

// How far the draws inside the region reach.
WidthView Shadow(const Evidence& evidence) {
  WidthView view = Empty(evidence, "Shadow of the region",
                         "from end to end of the joint 90 % region, whatever the others are; what "
                         "the figures show");
  const Eigen::MatrixXd& draws = evidence.model->draws;
  const Eigen::VectorXd levels = evidence.model->credible_levels(draws);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    if (levels[i] <= 0.9) inside.push_back(i);
  }
  if (inside.empty()) return view;
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    const Eigen::VectorXd column = draws(inside, static_cast<Eigen::Index>(k));
    Set(evidence, k, {.low = column.minCoeff(), .high = column.maxCoeff()}, view);
  }
  return view;
}

// Each of the two that trade, with the other where it is recommended.
WidthView AcrossTheCurve(const Evidence& evidence, std::size_t i, std::size_t j) {
  const std::string& first = evidence.parameters[i].symbol;
  const std::string& second = evidence.parameters[j].symbol;
  WidthView view = Empty(evidence, "Across the curve",
                         "90 % of " + first + " once " + second +
                             " is held at its recommended value, and the other way round; how "
                             "closely the pair is tied");
  for (const auto& [k, other] : {std::pair{i, j}, std::pair{j, i}}) {
    const double held =
        evidence.parameters[other].range.ToUnit(evidence.answer->parameters[other].value);
    const std::vector<Eigen::Index> near =
        DrawsNear(evidence.model->draws, static_cast<Eigen::Index>(other), held);
    if (static_cast<Eigen::Index>(near.size()) < kFewestNear) continue;
    const Eigen::MatrixXd column = evidence.model->draws(near, static_cast<Eigen::Index>(k));
    Set(evidence, k, optimizer::CredibleRanges(column, 0.9).front(), view);
  }
  return view;
}

WidthView Alone(const campaign::ResultAlone& alone) {
  return {.title = alone.name + " alone",
          .means = "90 % for all parameters at once, by this experiment without the others",
          .low = alone.low,
          .high = alone.high};
}

}  // namespace

std::vector<Eigen::Index> DrawsNear(const Eigen::MatrixXd& draws, Eigen::Index column,
                                    double value) {
  std::vector<Eigen::Index> near;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    if (std::abs(draws(i, column) - value) <= kMeasured / 2) near.push_back(i);
  }
  return near;
}

std::vector<WidthView> WidthViews(const Evidence& evidence) {
  if (!evidence.answer || !evidence.model || evidence.parameters.size() < 2) return {};
  std::vector<WidthView> views{Stated(evidence), Shadow(evidence)};
  if (const auto pair = TradedPair(*evidence.answer)) {
    views.push_back(AcrossTheCurve(evidence, pair->first, pair->second));
  }
  if (!evidence.answer->posterior) return views;
  for (const campaign::ResultAlone& alone : evidence.answer->posterior->alone) {
    views.push_back(Alone(alone));
  }
  return views;
}

}  // namespace talus::analysis
