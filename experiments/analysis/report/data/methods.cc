#include "experiments/analysis/report/data/methods.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text/counted.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "experiments/analysis/compare/labels.h"
#include "experiments/analysis/report/views/answer_words.h"

namespace talus::analysis {
namespace {

std::string Searched(const Evidence& evidence) {
  std::vector<std::string> words;
  for (const ParameterInfo& p : evidence.parameters) {
    words.push_back(
        LongNameOf(p.range.name) + " from " + base::ShortNumber(p.range.low) + " to " +
        base::WithUnit(p.range.high, p.unit, 3) +
        (p.range.scale == optimizer::Scale::kLog ? " (searched on a logarithmic scale)" : ""));
  }
  return WithPowers(base::Listed(words));
}

// As confirmed, of every experiment.
std::string Confirmed(const Evidence& evidence) {
  std::vector<std::string> words;
  for (const FitRow& row : evidence.fit) {
    if (row.confirmed.empty()) continue;
    words.push_back(row.confirmed + " (" + row.what + " of \"" + row.experiment + "\"" +
                    (row.held_out ? ", held out" : "") + ")");
  }
  if (words.empty()) return "";
  return " Simulated again with fresh seeds, it gives " + base::Listed(words) + ".";
}

std::string Answered(const Evidence& evidence) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    const ParameterInfo& p = evidence.parameters[k];
    const campaign::ResultParameter& v = evidence.answer->parameters[k];
    std::string word = p.symbol + " = " + base::WithUnit(v.value, p.unit, 3);
    if (std::isfinite(v.credible_low)) {
      word += " (90 % credible range " + std::string(p.range.is_nuisance ? "by itself, " : "") +
              base::ShortNumber(v.credible_low, 3) + " to " +
              base::WithUnit(v.credible_high, p.unit, 3) +
              (v.prior ? "; prior " + v.prior->text : "") + ")";
    }
    words.push_back(word + (p.range.is_nuisance ? " (integrated out)" : ""));
  }
  std::size_t num_ranges = 0;  // of what is asked for
  for (std::size_t k = 0; k < evidence.parameters.size(); ++k) {
    num_ranges += !evidence.parameters[k].range.is_nuisance &&
                  std::isfinite(evidence.answer->parameters[k].credible_low);
  }
  return " The recommended set is " + WithPowers(base::Listed(words)) +
         (num_ranges > 1 ? "; credible ranges hold for all parameters asked for together." : ".") +
         Confirmed(evidence);
}

// The version and commit of the program that started the campaign.
std::string StartedWith(const Evidence& evidence) {
  return evidence.versions.empty() ? "" : evidence.versions.front().text;
}

// What the simulations were held against; empty before there is an answer.
std::string Measured(const ReportData& data) {
  std::vector<std::string> words;
  for (const FitRow& row : data.evidence.fit) {
    if (row.held_out) continue;
    words.push_back("the " + row.what + " of \"" + row.experiment + "\" (" + row.measured + ")");
  }
  if (words.empty()) return "";
  const campaign::Answer& answer = *data.evidence.answer;
  const bool has_images =
      std::ranges::any_of(answer.experiments, [&](const campaign::ResultExperiment& e) {
        return e.has_image && std::ranges::none_of(data.evidence.fit, [&](const FitRow& row) {
                 return row.experiment == e.name && row.held_out;
               });
      });
  return " Simulations were compared with " + base::Listed(words) +
         (has_images
              ? "; images after projection into the frame of the experiment's average profile" +
                    // A posterior compares the images themselves.
                    (answer.posterior ? "" : ", by the " + data.own().info.title) + "."
              : ".");
}

struct Counts {
  std::ptrdiff_t searched = 0;  // with those that failed
  std::ptrdiff_t reused = 0;    // made by former campaigns
  std::ptrdiff_t failed = 0;
  std::vector<double> scale_factors;  // the coarsest first
};

// Over all experiments.
Counts CountsOf(const Evidence& e) {
  Counts counts;
  for (const TrialEvidence* t : e.AllTrials()) {
    if (t->kind == journal::TrialKind::kConfirm) continue;
    if (t->state == journal::TrialStatus::kFailed) {
      ++counts.failed;
      ++counts.searched;
    }
    if (t->state != journal::TrialStatus::kOk) continue;
    ++(t->kind == journal::TrialKind::kReused ? counts.reused : counts.searched);
    counts.scale_factors.push_back(t->scale_factor);
  }
  std::vector<double>& factors = counts.scale_factors;
  std::sort(factors.begin(), factors.end(), std::greater());
  factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
  return counts;
}

std::string Simulated(const Evidence& e) {
  const Counts counts = CountsOf(e);
  std::vector<std::string> factors;
  for (const double factor : counts.scale_factors) factors.push_back(base::ShortNumber(factor));
  std::string text =
      " The strategy \"" + e.strategy + "\" chose " + base::Counted(counts.searched, "simulation");
  if (counts.reused > 0) {
    text += " after " + base::Counted(counts.reused, "simulation") +
            " of former campaigns of this powder that it was told first,";
  }
  if (!factors.empty()) {
    text +=
        (factors.size() == 1 ? " at scale factor " : " at scale factors ") + base::Listed(factors);
  }
  return text +
         (counts.failed > 0 ? "; " + std::to_string(counts.failed) + " of them failed." : ".");
}

}  // namespace

std::string MethodsText(const ReportData& data) {
  const Evidence& e = data.evidence;
  std::string text = "The contact parameters were calibrated with talus " + StartedWith(e) +
                     ". Calibrated were " + Searched(e) + "." + Measured(data) + Simulated(e);
  if (e.answer) {
    std::string model = e.answer->model;
    if (model.ends_with('.')) model.pop_back();
    if (!model.empty()) text += " The model that answers: " + model + ".";
    text += Answered(e);
  }
  return text;
}

}  // namespace talus::analysis
