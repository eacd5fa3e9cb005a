#include "experiments/analysis/compare/experiment_fit.h"

#include <cmath>

#include "base/text/counted.h"
#include "base/text/joined.h"
#include "base/text/lower.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/analysis/compare/labels.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::analysis {
namespace {

using campaign::Answer;
using campaign::ConfirmedAtTarget;
using campaign::ConfirmedOf;
using campaign::Meets;
using campaign::ResultConfirmed;
using campaign::ResultStanding;
using campaign::StandingOf;

// Three digits: an error is known no better.
std::string ShortText(double value, int digits = 3) { return base::ShortNumber(value, digits); }

std::string MeasuredRuns(const journal::ExperimentRecord& record) {
  const std::string runs = base::Counted(record.num_heaps, "run");
  if (!record.noise_mm2) return runs;
  return runs + ", each " + ShortText(*record.noise_mm2) + " mm² SAD from the mean of the others";
}

std::string SimulatedShape(const ResultConfirmed& confirmed) {
  std::string text;
  if (confirmed.profile_sad_mm2) {
    text = ShortText(*confirmed.profile_sad_mm2) + " mm² SAD";
    if (confirmed.num_trials > 1) {
      text += " as the mean of " + base::Counted(confirmed.num_trials, "simulation");
    }
  }
  if (confirmed.sad_mm2 && confirmed.num_trials > 1) {
    text += (text.empty() ? "" : "; ") + ShortText(*confirmed.sad_mm2) + " mm² in single runs";
  }
  return text;
}

// Where it is farther than what fits and no farther than chance.
std::string ChanceText(const campaign::MeasurementFit& fit) {
  if (fit.meets != Meets::kUnknown || !std::isfinite(fit.off)) return "";
  return fit.few_measured ? ", which so few measured values may be by chance"
                          : ", which so few simulations may be by chance";
}

std::string ShapeJudgement(const campaign::MeasurementFit& fit, int num_heaps) {
  std::string text;
  if (std::isfinite(fit.off)) {
    text = ShortText(fit.off) + " times as far as the runs are from each other";
  }
  if (std::isfinite(fit.share)) {
    text += (text.empty() ? "" : ", ") + ShortText(100 * fit.share, 2) + " % of the powder's area";
  }
  if (std::isfinite(fit.off)) return text + ChanceText(fit);
  return text + (text.empty() ? "" : "; ") +
         (num_heaps > 1 ? "one map of all runs does not tell how they scatter"
                        : "no second run to compare with");
}

FitRow ShapeRow(const Answer& answer, const campaign::ResultExperiment& experiment,
                const journal::ExperimentRecord& record) {
  FitRow row{.experiment = record.name, .what = "shape", .measured = MeasuredRuns(record)};
  const campaign::MeasurementFit fit = campaign::ImageFit(answer, experiment);
  row.meets = fit.meets;
  const ResultConfirmed* confirmed = ConfirmedAtTarget(answer, record.name);
  if (confirmed != nullptr && confirmed->profile_sad_mm2) {
    row.is_confirmed = true;
    row.simulated = row.confirmed = SimulatedShape(*confirmed);
    row.judgement = ShapeJudgement(fit, record.num_heaps);
    return row;
  }
  const ResultStanding* standing = StandingOf(answer, record.name);
  if (standing != nullptr && std::isfinite(standing->predicted)) {
    row.simulated = ShortText(standing->predicted) + campaign::DistanceUnit(answer) +
                    " predicted, not confirmed";
  }
  row.judgement = "not confirmed by a fresh seed";
  if (confirmed == nullptr && ConfirmedOf(answer, record.name) != nullptr) {
    row.judgement = "simulated again at scale factor " +
                    base::ShortNumber(answer.confirmed.front().scale_factor) + " only";
  }
  return row;
}

// With the digits that the error leaves: two of its own.
std::string ToError(double value, double error) {
  const double unit = std::pow(10.0, std::floor(std::log10(error)) - 1);
  return base::ShortNumber(std::round(value / unit) * unit, 8);
}

FitRow NumberRow(const Answer& answer, const campaign::ResultExperiment& experiment,
                 std::size_t index) {
  const campaign::ResultNumber& measured = experiment.numbers[index];
  const ShownUnit unit = ShownUnitOf(rigs::UnitOfObservable(measured.name));
  const std::string ending = (unit.text.empty() || unit.text == "°" ? "" : " ") + unit.text;
  const double error = unit.per_unit * measured.standard_error;
  const auto shown = [&](double value) { return ToError(unit.per_unit * value, error); };
  const campaign::MeasurementFit fit = campaign::NumberFit(answer, experiment, index);
  FitRow row{.experiment = experiment.name,
             .what = base::LowerFirst(MetricTitle(measured.name)),
             .measured = shown(measured.value) + " ± " + shown(measured.standard_error) + ending,
             .meets = fit.meets,
             .few_measured = fit.few_measured};
  const ResultStanding* standing = StandingOf(answer, experiment.name);
  if (standing != nullptr && index < standing->numbers.size()) {
    const optimizer::NumberStanding& number = standing->numbers[index];
    row.simulated = "predicted " + shown(rigs::Possible(measured.name, number.predicted)) + " ± " +
                    base::PlainNumber(unit.per_unit * number.predicted_sd, 2) + ending;
  }
  const ResultConfirmed* confirmed = ConfirmedAtTarget(answer, experiment.name);
  if (fit.undefined) {
    row.is_confirmed = true;
    row.simulated = "none";
    row.judgement = "no simulation with these values has one: " + *fit.undefined;
    return row;
  }
  row.is_confirmed = confirmed != nullptr && std::isfinite(confirmed->scalars.at(index).mean);
  if (row.is_confirmed) {
    row.confirmed = shown(confirmed->scalars[index].mean) + ending + " as the mean of " +
                    base::Counted(confirmed->scalars[index].num_trials, "simulation");
    row.simulated = row.confirmed + (row.simulated.empty() ? "" : "; " + row.simulated);
  }
  if (std::isfinite(fit.off)) {
    const bool has_error =
        row.is_confirmed && std::isfinite(confirmed->scalars[index].standard_error);
    row.judgement = base::PlainNumber(fit.off, 2) + " standard errors of the measurement" +
                    (has_error          ? " and the simulations"
                     : row.is_confirmed ? ""
                                        : " and the prediction") +
                    " away" + (row.is_confirmed ? ChanceText(fit) : "");
  }
  return row;
}

std::string NameOf(const FitRow& row) {
  return "the " + row.what + " of \"" + row.experiment + "\"" + (row.held_out ? " (held out)" : "");
}

// "The mass of "heap" and …" of the rows that are so; empty without.
template <class Select>
std::string Names(const std::vector<FitRow>& rows, Select select) {
  std::vector<std::string> names;
  for (const FitRow& row : rows) {
    if (select(row)) names.push_back(NameOf(row));
  }
  return base::Listed(names);
}

}  // namespace

std::vector<FitRow> FitRows(const Answer& answer, const journal::CampaignRecord& record) {
  std::vector<FitRow> rows;
  for (std::size_t e = 0; e < answer.experiments.size(); ++e) {
    const campaign::ResultExperiment& experiment = answer.experiments[e];
    const std::size_t first = rows.size();
    if (experiment.has_image) rows.push_back(ShapeRow(answer, experiment, record.experiments[e]));
    for (std::size_t i = 0; i < experiment.numbers.size(); ++i) {
      rows.push_back(NumberRow(answer, experiment, i));
    }
    const ResultStanding* standing = StandingOf(answer, experiment.name);
    for (std::size_t i = first; i < rows.size(); ++i) {
      rows[i].held_out = answer.held_out && answer.held_out->name == experiment.name;
      if (standing != nullptr) rows[i].implausibility = standing->implausibility;
    }
  }
  return rows;
}

std::string FitSentence(const std::vector<FitRow>& rows) {
  std::string text;
  const auto add_those = [&](const auto& select, const std::string& before,
                             const std::string& after) {
    const std::string names = Names(rows, select);
    if (!names.empty()) text += (text.empty() ? "" : " ") + before + names + after + ".";
  };
  const auto add = [&](bool simulated, Meets meets, const std::string& before,
                       const std::string& after) {
    add_those(
        [&](const FitRow& row) { return row.meets == meets && row.is_confirmed == simulated; },
        before, after);
  };
  const auto is_open = [](const FitRow& row) {
    return row.meets == Meets::kUnknown && row.is_confirmed;
  };
  add(true, Meets::kYes, "With these values simulations give ",
      " within the errors of measurement and simulations");
  add(true, Meets::kNo, "With these values simulations miss ", "");
  add(false, Meets::kYes, "The model expects ", " within the errors of measurement and prediction");
  add(false, Meets::kNo, "The model expects to miss ", "");
  add_those([&](const FitRow& row) { return is_open(row) && !row.few_measured; },
            "The few simulations with these values do not tell how well they meet ", "");
  add_those([&](const FitRow& row) { return is_open(row) && row.few_measured; },
            "So few measured values do not tell whether simulations with these values meet ", "");
  add(false, Meets::kUnknown, "No simulation with these values tells how well they meet ", "");
  return text;
}

}  // namespace talus::analysis
