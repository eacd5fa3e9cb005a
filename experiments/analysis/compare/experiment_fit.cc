#include "experiments/analysis/compare/experiment_fit.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "base/text/counted.h"
#include "base/text/number_text.h"
#include "experiments/analysis/report/labels.h"
#include "experiments/rigs/rig.h"

namespace talus::analysis {
namespace {

using campaign::CampaignResult;
using campaign::ResultConfirmed;
using campaign::ResultStanding;
using Meets = FitRow::Meets;

constexpr double kCloseRuns = 1.5;  // times the runs' own distance: a simulation scatters, too
constexpr double kCloseNumber = 2;  // standard errors
constexpr double kImplausible = 3;  // as the alarm

// Three digits: an error is known no better.
std::string Number(double value, int digits = 3) { return base::ShortNumber(value, digits); }

// Of the recommended set; what stands beside the list belongs to a lone experiment.
std::optional<ResultConfirmed> ConfirmedOf(const CampaignResult& result, std::size_t experiment) {
  if (result.confirmed.empty()) return std::nullopt;
  const campaign::ResultCandidate& first = result.confirmed.front();
  if (first.experiments) return first.experiments->at(experiment);
  if (experiment > 0) return std::nullopt;
  return ResultConfirmed{.name = {},
                         .num_trials = first.num_trials,
                         .mean = first.mean,
                         .sad_mm2 = first.sad_mm2,
                         .profile_sad_mm2 = first.profile_sad_mm2,
                         .over_floor = result.confirmed_over_floor};
}

const ResultStanding* StandingOf(const CampaignResult& result, const std::string& name) {
  if (!result.posterior) return nullptr;
  const auto& all = result.posterior->experiments;
  const auto found = std::ranges::find(all, name, &ResultStanding::name);
  return found == all.end() ? nullptr : &*found;
}

std::string MeasuredRuns(const journal::ExperimentRecord& record) {
  const std::string runs = base::Counted(record.num_heaps, "run");
  if (!record.noise_mm2) return runs;
  return runs + ", each " + Number(*record.noise_mm2) + " mm² SAD from the mean of the others";
}

std::string SimulatedShape(const ResultConfirmed& confirmed) {
  std::string text;
  if (confirmed.profile_sad_mm2) {
    text = Number(*confirmed.profile_sad_mm2) + " mm² SAD";
    if (confirmed.num_trials > 1) {
      text += " as the mean of " + base::Counted(confirmed.num_trials, "simulation");
    }
  }
  if (confirmed.sad_mm2 && confirmed.num_trials > 1) {
    text += (text.empty() ? "" : "; ") + Number(*confirmed.sad_mm2) + " mm² in single runs";
  }
  return text;
}

void JudgeShape(const ResultConfirmed& confirmed, int num_heaps, FitRow& row) {
  if (!confirmed.over_floor) {
    row.judgement = num_heaps > 1 ? "not known: one map of all runs does not tell how they scatter"
                                  : "not known: no second run to compare with";
    return;
  }
  const double ratio = *confirmed.over_floor;
  row.meets = ratio <= kCloseRuns ? Meets::kYes : Meets::kNo;
  row.judgement = Number(ratio) + " times as far as the runs are from each other";
}

FitRow ShapeRow(const CampaignResult& result, const journal::ExperimentRecord& record,
                std::size_t experiment) {
  FitRow row{.experiment = record.name, .what = "shape", .measured = MeasuredRuns(record)};
  const auto confirmed = ConfirmedOf(result, experiment);
  if (confirmed && confirmed->profile_sad_mm2) {
    row.simulated = SimulatedShape(*confirmed);
    JudgeShape(*confirmed, record.num_heaps, row);
    return row;
  }
  const ResultStanding* standing = StandingOf(result, record.name);
  const double predicted = standing != nullptr ? standing->predicted
                           : experiment == 0   ? result.predicted
                                               : campaign::kNotKnown;
  if (std::isfinite(predicted)) {
    row.simulated = Number(predicted) + " " + result.objective_unit + " predicted, not confirmed";
  }
  row.judgement = "not confirmed by a fresh seed";
  return row;
}

// With the digits that the error leaves: two of its own.
std::string ToError(double value, double error) {
  const double unit = std::pow(10.0, std::floor(std::log10(error)) - 1);
  return base::ShortNumber(std::round(value / unit) * unit, 8);
}

FitRow NumberRow(const CampaignResult& result, const journal::ExperimentRecord& record,
                 std::size_t experiment, std::size_t index) {
  const journal::ScalarRecord& scalar = record.scalars[index];
  const ShownUnit unit = ShownUnitOf(rigs::UnitOfObservable(scalar.name));
  const std::string ending = unit.text.empty() ? "" : " " + unit.text;
  const double error = unit.per_unit * scalar.standard_error;
  const auto shown = [&](double value) { return ToError(unit.per_unit * value, error); };
  std::string what = MetricTitle(scalar.name);
  what.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(what.front())));
  FitRow row{.experiment = record.name,
             .what = what,
             .measured = shown(scalar.value) + " ± " + shown(scalar.standard_error) + ending};
  const auto confirmed = ConfirmedOf(result, experiment);
  const ResultStanding* standing = StandingOf(result, record.name);
  double simulated = campaign::kNotKnown;
  if (confirmed && index < confirmed->scalars.size()) simulated = confirmed->scalars[index].mean;
  const bool is_confirmed = std::isfinite(simulated);
  double uncertain = 0;  // of a number that is predicted only
  if (standing != nullptr && index < standing->numbers.size()) {
    const campaign::ResultPredictedNumber& number = standing->numbers[index];
    row.simulated = "predicted " + shown(number.predicted) + " ± " +
                    Number(unit.per_unit * number.predicted_sd, 2) + ending;
    if (!is_confirmed) {
      simulated = number.predicted;
      uncertain = number.predicted_sd;
    }
  }
  if (is_confirmed) {
    row.simulated = shown(simulated) + ending + " as the mean of " +
                    base::Counted(confirmed->num_trials, "simulation") +
                    (row.simulated.empty() ? "" : "; " + row.simulated);
  }
  if (!std::isfinite(simulated)) return row;
  const double off =
      std::abs(simulated - scalar.value) / std::hypot(scalar.standard_error, uncertain);
  row.meets = off <= kCloseNumber ? Meets::kYes : Meets::kNo;
  row.judgement = Number(off, 2) + " standard errors of the measurement" +
                  (is_confirmed ? "" : " and the prediction") + " away";
  return row;
}

std::string Quoted(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

std::string NameOf(const FitRow& row) {
  return "the " + row.what + " of \"" + row.experiment + "\"";
}

}  // namespace

std::vector<FitRow> FitRows(const CampaignResult& result, const journal::CampaignRecord& record) {
  std::vector<FitRow> rows;
  for (std::size_t e = 0; e < record.experiments.size(); ++e) {
    const journal::ExperimentRecord& experiment = record.experiments[e];
    const std::size_t first = rows.size();
    if (!experiment.aehp_png.empty()) rows.push_back(ShapeRow(result, experiment, e));
    for (std::size_t i = 0; i < experiment.scalars.size(); ++i) {
      rows.push_back(NumberRow(result, experiment, e, i));
    }
    const ResultStanding* standing = StandingOf(result, experiment.name);
    for (std::size_t i = first; i < rows.size(); ++i) {
      rows[i].held_out = result.held_out && result.held_out->name == experiment.name;
      if (standing == nullptr) continue;
      rows[i].implausibility = standing->implausibility;
      if (standing->implausibility > kImplausible) rows[i].meets = Meets::kNo;
    }
  }
  return rows;
}

std::string FitSentence(const std::vector<FitRow>& rows) {
  std::vector<std::string> met, missed, open;
  for (const FitRow& row : rows) {
    (row.meets == Meets::kYes  ? met
     : row.meets == Meets::kNo ? missed
                               : open)
        .push_back(NameOf(row));
  }
  std::string text;
  if (!met.empty()) {
    text = "With these values a simulation gives " + Quoted(met) +
           " as closely as the measurement itself is known.";
  }
  if (!missed.empty()) {
    text += (text.empty() ? "With these values a simulation misses " : " It misses ") +
            Quoted(missed) + ".";
  }
  if (!open.empty()) {
    text += (text.empty() ? "" : " ") + std::string("How well ") + Quoted(open) +
            (open.size() == 1 ? " is" : " are") + " met is not known.";
  }
  return text;
}

}  // namespace talus::analysis
