#include "experiments/analysis/predict/prediction_text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "base/text/counted.h"
#include "base/text/csv.h"
#include "base/text/duration_text.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/analysis/predict/prediction_runs.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::analysis {
namespace {

using base::ShortNumber;

// A number's name without its unit, and the unit that people read it in.
struct TitleAndUnit {
  std::string title;
  rigs::ShownUnit unit;

  explicit TitleAndUnit(const PredictedNumber& number)
      : title(number.name), unit(rigs::ShownUnitOf(number.unit)) {
    const rigs::ObservableInfo* const known = rigs::FindObservable(number.name);
    if (known == nullptr) return;
    title = known->key;
    unit = rigs::ShownUnitOf(rigs::UnitOfObservable(number.name));
  }

  std::string Text(double x, int digits = 4) const {
    return base::PlainNumber(unit.per_unit * x, digits);
  }
  std::string Unit() const { return unit.text.empty() ? "" : " " + unit.text; }
};

std::string Percent(double share) { return ShortNumber(std::round(100 * share), 3) + " %"; }

std::string SetText(const Prediction& prediction, int draw,
                    const std::vector<journal::ParameterRecord>& parameters) {
  const std::vector<double>& values = prediction.draws.at(static_cast<std::size_t>(draw)).values;
  const auto text = [&](std::size_t i) {
    return parameters[i].name + " " + ShortNumber(values[i]);
  };
  return "draw " + std::to_string(draw + 1) + " (" + base::JoinedUpTo(values.size(), ", ", text) +
         ")";
}

// Where the uncertainty of a single run comes from.
std::string SharesText(const PredictedNumber& number, bool many_draws) {
  if (number.run_sd == 0 && !many_draws) return "the same in every run";
  if (!many_draws) {
    return std::isfinite(number.run_sd) ? "all of it the scatter of a single run"
                                        : "of one run: how far others lie is not known";
  }
  if (!std::isfinite(number.run_sd)) {
    return "parameters and the scatter of a run are not told apart: no set was run twice";
  }
  if (!std::isfinite(number.parameters_share)) return "the same in every run";
  double scatter = 1 - number.parameters_share;
  std::string surrogate;
  if (number.surrogate && number.surrogate->is_used) {
    const double share = std::pow(number.surrogate->sd, 2) / number.Variance();
    surrogate = ", " + Percent(share) + " the surrogate";
    scatter -= share;
  }
  return "of the variance " + Percent(number.parameters_share) + " parameters, " +
         Percent(scatter) + " the scatter of a single run" + surrogate;
}

// By whom the number is told, and how far off either is of draws that were left out.
std::string LeftOutText(const Prediction& prediction, const PredictedNumber& number) {
  if (!number.surrogate) return "";
  const TitleAndUnit shown(number);
  const PredictedSurrogate& s = *number.surrogate;
  const std::string errors = " is off by " + shown.Text(s.left_out_error, 2) + shown.Unit() +
                             " at a draw left out; the mean of the other draws by " +
                             shown.Text(s.draws_error, 2) + shown.Unit();
  if (s.is_used) {
    return "    at scale factor " + ShortNumber(s.scale_factor) + " by a surrogate, which" +
           errors + "\n";
  }
  return "    by the draws at scale factor " + ShortNumber(prediction.scale_factor) +
         "; a surrogate" + errors + "\n";
}

// "scale factor 1.5", "scale factors 2 and 1.5"
std::string ScaleFactorsText(const Prediction& prediction) {
  std::set<double, std::greater<>> all{prediction.scale_factor};
  for (const PredictedRun& run : prediction.runs) all.insert(run.scale_factor);
  std::string text;
  for (const double f : all) {
    text += text.empty() ? "" : f == *all.rbegin() ? " and " : ", ";
    text += ShortNumber(f);
  }
  return (all.size() > 1 ? "scale factors " : "scale factor ") + text;
}

std::string MeasuredText(const Prediction& prediction, const PredictedNumber& number,
                         const std::vector<journal::ParameterRecord>& parameters) {
  const MeasuredThere& m = *number.measured;
  const TitleAndUnit shown(number);
  std::string text =
      "    measured " + shown.Text(m.value) + " ± " + shown.Text(m.standard_error) + shown.Unit();
  if (!std::isfinite(m.low)) return text + "; one run does not tell how far others lie from it\n";
  text += std::string(": ") + (m.is_inside ? "inside" : "outside") + " of " + shown.Text(m.low) +
          " … " + shown.Text(m.high) + ", its error counted";
  if (m.is_inside) return text + "\n";
  return text + (m.nearest_is_inside
                     ? "; yet " + SetText(prediction, m.nearest_draw, parameters) +
                           " gives it: `talus add-experiment` would narrow the answer by it\n"
                 : std::isnan(number.run_sd)
                     ? "; one run of a set does not tell whether the set gives it\n"
                 : prediction.by == PredictedBy::kPosterior
                     ? "; no draw gives it: this process is not predicted by any set that fits\n"
                     : "; this set does not give it\n");
}

std::string ImageText(const Prediction& prediction,
                      const std::vector<journal::ParameterRecord>& parameters) {
  const MeasuredImage& image = *prediction.image;
  std::string text =
      "  measured image  " + ShortNumber(image.sad_mm2) + " mm² from the predicted mean";
  if (!image.is_inside) {
    return text + "; too few runs to tell how far others lie from it: it takes " +
           std::to_string(PredictionRuns::kFewestOfARange) +
           (prediction.draws.size() > 1
                ? ", of " + std::to_string(PredictionRuns::kFewestDrawsOfARange) + " draws or more"
                : "") +
           "\n";
  }
  text += std::string(", ") + (*image.is_inside ? "inside" : "outside") + " of the " +
          ShortNumber(image.sad_90_mm2) + " mm² of 90 % of single runs";
  if (*image.is_inside || prediction.by != PredictedBy::kPosterior) return text + "\n";
  text += "; nearest is " + SetText(prediction, image.nearest_draw, parameters) + ", " +
          ShortNumber(image.nearest_sad_mm2) + " mm² from it";
  if (!image.nearest_is_inside) return text + "\n";
  return text + (*image.nearest_is_inside
                     ? ", which gives it: `talus add-experiment` would narrow the answer by it\n"
                     : ", and does not give it either\n");
}

// "0.012 (0.003 … 0.05)": the median of the work, and what 90 % of it lies in.
std::string RangeText(const std::vector<double>& range) {
  return base::PlainNumber(range[1], 2) + " (" + base::PlainNumber(range[0], 2) + " … " +
         base::PlainNumber(range[2], 2) + ")";
}

std::string RegimeText(const FlowRegime& r) {
  return "  sheared in " + r.name + " at an inertial number of " + RangeText(r.inertial_number) +
         ", under " + RangeText(r.pressure) + " Pa, Bond number " +
         base::PlainNumber(r.bond_number, 2) + ", contact duration × shear rate " +
         ShortNumber(r.contact_duration[1], 2) + "\n";
}

std::string WhatText(const Prediction& prediction) {
  switch (prediction.by) {
    case PredictedBy::kPosterior:
      return base::Counted(static_cast<long long>(prediction.draws.size()), "draw") +
             " of the posterior";
    case PredictedBy::kRecommended:
      return "the recommended set";
    case PredictedBy::kSet:
      return "one set";
  }
  return {};
}

}  // namespace

std::string NumberTitle(const PredictedNumber& number) { return TitleAndUnit(number).title; }

std::string NumberText(const PredictedNumber& number) {
  const TitleAndUnit shown(number);
  const std::string text = shown.Text(number.mean) + shown.Unit();
  if (!std::isfinite(number.low)) return text;
  return text + ", 90 % of runs in " + shown.Text(number.low) + " … " + shown.Text(number.high);
}

std::string SilentText(const PredictedNumber& number) {
  const auto silent =
      std::ranges::count_if(number.by_run, [](double value) { return !std::isfinite(value); });
  if (silent == 0) return {};
  return "without a value in " + base::Counted(silent, "run") +
         (number.undefined.empty() ? "" : ": " + number.undefined);
}

std::string PredictionText(const Prediction& prediction,
                           const std::vector<journal::ParameterRecord>& parameters) {
  std::string text = prediction.name + " (" + prediction.test + "), by " + WhatText(prediction);
  if (prediction.test != "scene") {
    text += ", " + ScaleFactorsText(prediction);
  }
  text += ": " + std::to_string(prediction.num_ended) + " of " +
          base::Counted(prediction.num_runs, "run") + ", " +
          base::DurationText(prediction.core_time) + " of core time\n";
  if (prediction.num_failed > 0) {
    text += "  " + std::to_string(prediction.num_failed) +
            " failed, the last: " + prediction.failure + "\n";
  }
  for (const std::string& note : prediction.notes) text += "  note: " + note + "\n";
  for (const PredictedNumber& number : prediction.numbers) {
    const TitleAndUnit shown(number);
    text += "  " + shown.title +
            std::string(shown.title.size() < 15 ? 16 - shown.title.size() : 1, ' ');
    if (number.num_defined == 0) {
      text += "has no value: " + number.undefined + "\n";
      continue;
    }
    text += NumberText(number) + "; " + SharesText(number, prediction.draws.size() > 1);
    if (const std::string silent = SilentText(number); !silent.empty()) text += "; " + silent;
    text += "\n" + LeftOutText(prediction, number);
    if (number.measured) text += MeasuredText(prediction, number, parameters);
  }
  if (prediction.image) text += ImageText(prediction, parameters);
  for (const FlowRegime& regime : prediction.regimes) text += RegimeText(regime);
  return text;
}

std::string DrawsCsv(const Prediction& prediction,
                     const std::vector<journal::ParameterRecord>& parameters) {
  base::Csv csv;
  csv.Cell("draw").Cell("weight");
  for (const journal::ParameterRecord& p : parameters) csv.Cell(journal::ColumnName(p));
  for (const PredictedNumber& number : prediction.numbers) csv.Cell(number.name);
  csv.EndRow();
  for (std::size_t d = 0; d < prediction.draws.size(); ++d) {
    csv.Cell(d + 1).Cell(prediction.draws[d].weight).Cells(prediction.draws[d].values);
    for (const PredictedNumber& number : prediction.numbers) csv.Cell(number.by_draw[d]);
    csv.EndRow();
  }
  return csv.Take();
}

}  // namespace talus::analysis
