#include "experiments/analysis/report/views/width_views.h"

#include <algorithm>
#include <cmath>

#include "base/not_known.h"
#include "experiments/analysis/report/views/answer_words.h"
#include "optimizer/posterior/credible_ranges.h"

namespace talus::analysis {
namespace {

WidthView Empty(const Evidence& evidence, const std::string& title, const std::string& means) {
  const std::vector<double> none(evidence.parameters.size(), base::kNotKnown);
  return {.title = title, .means = means, .low = none, .high = none};
}

void Set(const Evidence& evidence, std::size_t k, const optimizer::Range& range, WidthView& view) {
  view.low[k] = evidence.parameters[k].range.ToNative(range.low);
  view.high[k] = evidence.parameters[k].range.ToNative(range.high);
}

// A nuisance has a range of its own, whatever the others are.
std::string AllAtOnce(const Evidence& evidence) {
  return evidence.all_asked_for()
             ? "90 % for all parameters at once"
             : "90 % for all parameters asked for at once; of one not asked for, by itself";
}

WidthView Stated(const Evidence& evidence) {
  WidthView view = Empty(evidence, "Stated range",
                         AllAtOnce(evidence) +
                             "; what tolerances are made of, and what talus next "
                             "starts from");
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    view.low[k] = evidence.answer->parameters[k].credible_low;
    view.high[k] = evidence.answer->parameters[k].credible_high;
  }
  return view;
}

void Include(double value, std::size_t k, WidthView& view) {
  view.low[k] = std::fmin(view.low[k], value);
  view.high[k] = std::fmax(view.high[k], value);
}

// How far the figures' cells inside the region reach. Of what no figure shows, how far the draws
// do.
WidthView Shadow(const Evidence& evidence, const std::vector<PairMap>& pairs) {
  WidthView view = Empty(evidence, "Shadow of the region",
                         "from end to end of the joint 90 % region, whatever the others are; what "
                         "the figures show");
  for (const PairMap& pair : pairs) {
    const std::size_t columns = pair.x_edges.size() - 1;
    for (std::size_t c = 0; c < pair.value.size(); ++c) {
      if (!(pair.value[c] < optimizer::kRegionLevel)) continue;
      for (const std::size_t edge : {std::size_t{0}, std::size_t{1}}) {
        Include(pair.x_edges[c % columns + edge], pair.i, view);
        Include(pair.y_edges[c / columns + edge], pair.j, view);
      }
    }
  }
  if (std::ranges::all_of(view.low, [](double low) { return std::isfinite(low); })) return view;
  const Eigen::MatrixXd& draws = evidence.model->draws;
  const Eigen::VectorXd levels = evidence.model->credible_levels(draws);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    if (levels[i] <= optimizer::kRegionLevel) inside.push_back(i);
  }
  if (inside.empty()) return view;
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    if (std::isfinite(view.low[k])) continue;
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
    Set(evidence, k, optimizer::CredibleRanges(column).front(), view);
  }
  return view;
}

WidthView Alone(const Evidence& evidence, const campaign::ResultAlone& alone) {
  return {.title = alone.name + " alone",
          .means = AllAtOnce(evidence) + "; by this experiment without the others",
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

std::vector<WidthView> WidthViews(const Evidence& evidence, const std::vector<PairMap>& pairs) {
  if (!evidence.answer || !evidence.model || evidence.parameters.size() < 2) return {};
  std::vector<WidthView> views{Stated(evidence), Shadow(evidence, pairs)};
  if (const auto pair = TradedPair(*evidence.answer)) {
    views.push_back(AcrossTheCurve(evidence, pair->first, pair->second));
  }
  if (!evidence.answer->posterior) return views;
  for (const campaign::ResultAlone& alone : evidence.answer->posterior->alone) {
    views.push_back(Alone(evidence, alone));
  }
  return views;
}

}  // namespace talus::analysis
