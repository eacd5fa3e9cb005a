#include "experiments/analysis/design/design_text.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "base/json/json_text.h"
#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/analysis/next/next_text.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/plan/estimate.h"
#include "experiments/campaign/plan/usual_cost.h"
#include "experiments/rigs/case/device_text.h"
#include "experiments/rigs/observables/shown_number.h"

namespace talus::analysis {
namespace {

using base::ShortNumber;

constexpr std::size_t kShown = 4;  // of one size

std::string NamesOf(const DesignTable& table, const DesignChoice& choice) {
  return base::Joined(choice.tests, " + ",
                      [&](std::size_t t) { return table.tests.candidates[t].name; });
}

// What the choices are in order of, ten characters wide.
std::string MeritText(const DesignChoice& choice) {
  const std::string percent = base::InPercent(choice.remaining);
  return std::string(8 - std::min<std::size_t>(8, percent.size()), ' ') + percent + " %";
}

// What is supposed, as far as it is given.
struct Supposed {
  std::vector<journal::ParameterRecord> parameters{};
  std::vector<double> values{};
};

Supposed SupposedOf(const DesignTable& table) {
  Supposed supposed;
  for (std::size_t i = 0; i < table.supposed.size(); ++i) {
    if (std::isnan(table.supposed[i])) continue;
    supposed.parameters.push_back(table.tests.parameters[i]);
    supposed.values.push_back(table.supposed[i]);
  }
  return supposed;
}

// "searched: …", what is supposed, and what the order is.
std::string GroundText(const DesignTable& table) {
  std::string text = "searched: " + WidthsText(table.tests, table.tests.width) + "\n";
  const Supposed supposed = SupposedOf(table);
  if (!supposed.values.empty()) {
    text += "supposed: " + campaign::SetText(supposed.parameters, supposed.values) + "\n";
  }
  return text + "in order of the share of the volume searched that they are expected to leave\n";
}

std::string ChoicesText(const DesignTable& table, const std::vector<DesignChoice>& choices) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, choices.size()); ++i) {
    text += MeritText(choices[i]) + "  " + NamesOf(table, choices[i]) +
            "\n            expected to leave " + SpreadText(table.tests, choices[i].learning) +
            "; " + ShortNumber(choices[i].learning.bits, 3) + " bits\n";
  }
  return text;
}

std::string NumbersText(const campaign::JointView& view, const TestCandidate& test) {
  return base::Joined(NumbersOf(view, test), ", ", [](const ExpectedNumber& number) {
    const std::string name = rigs::SpokenName(number.metric);
    if (number.relative_error > 0) {
      return name + " ± " + ShortNumber(100 * number.relative_error) + " %";
    }
    const bool is_stated = number.standard_error > 0;
    return name +
           (is_stated ? " ± " + rigs::ShownNumber(number.metric, number.standard_error) : "");
  });
}

// Seconds with their fractions where there are few.
std::string TimeText(double seconds) {
  constexpr double kFew = 10;
  return seconds < kFew ? ShortNumber(seconds, 2) + " s" : base::DurationText(seconds);
}

std::string FillingText(rigs::FillingKind kind) {
  return kind == rigs::FillingKind::kPour ? "poured" : "filled densely";
}

std::string TestText(const campaign::JointView& view, const TestCandidate& test,
                     const NextCandidate& judged) {
  const rigs::Case c =
      campaign::TypicalCase(SpecOf(view, test), 0, view.spec.coarse_graining.Levels().front());
  std::string text = "  " + test.name + "\n    " + base::Counted(test.runs, "run") + " of " +
                     ShortNumber(1e3 * c.powder.mass) + " g, " + FillingText(c.filling.kind) +
                     "; " + rigs::DeviceText(c.rig) + "\n";
  if (FrameOf(view, test)) {
    text +=
        "    photograph every run from several sides by turning the plate, with light from "
        "behind\n";
  }
  const std::string numbers = NumbersText(view, test);
  if (!numbers.empty()) text += "    measure " + numbers + "\n";
  if (judged.num_made > 0 && judged.core_time_made > 0) {
    const double one = judged.core_time_made / judged.num_made;
    const campaign::CampaignSpec spec = SpecOf(view, test);
    const std::vector<double> levels = view.spec.coarse_graining.Levels();
    const double coarse = campaign::GrainStepsOf(spec, 0, levels.front());
    text += "    core time of a simulation:";
    for (const double factor : levels) {
      text += (factor == levels.front() ? " " : ", ") +
              TimeText(one * campaign::GrainStepsOf(spec, 0, factor) / coarse) +
              " at scale factor " + ShortNumber(factor);
    }
    text += "\n";
  }
  return text;
}

// What can be simulated, as the experiments of one campaign at the scale factor of the plan.
campaign::CampaignSpec SpecOfAll(const campaign::JointView& view,
                                 const std::vector<TestCandidate>& tests) {
  campaign::CampaignSpec all = view.spec;
  all.coarse_graining.scale_factors = {{all.coarse_graining.Levels().front()}};
  all.experiment.reset();
  std::vector<campaign::ExperimentSpec>& experiments = all.experiments.emplace();
  for (const TestCandidate& test : tests) {
    if (!WhyNot(view, test).empty()) continue;
    experiments.push_back(campaign::ExperimentsOf(SpecOf(view, test)).front());
  }
  return all;
}

}  // namespace

std::string DesignCostText(const DesignSpec& design) {
  const campaign::CampaignSpec all = SpecOfAll(ViewOf(design, {}), design.candidates);
  const std::vector<campaign::ExperimentSpec>& experiments = *all.experiments;
  std::string text = "  candidates        " + std::to_string(design.candidates.size()) + "\n";
  if (experiments.empty()) return text;
  if (design.campaign.engine.kind == campaign::EngineKind::kCommand) {
    return text + "  time              " + base::Counted(kDesignSimulations, "simulation") +
           " of each; how long one takes is not known before one has run\n";
  }
  double seconds = 0;
  for (const campaign::TrialEstimate& trial : campaign::EstimateTrials(all).trials) {
    seconds += kDesignSimulations * trial.core_seconds;
    text += "    " + experiments[static_cast<std::size_t>(trial.experiment)].name + ": " +
            std::to_string(trial.num_grains) + " grains of " +
            base::ShortNumber(1e3 * trial.mean_diameter) + " mm, " +
            base::DurationText(trial.core_seconds) + " of a core\n";
  }
  return text + "  time              " + base::Counted(kDesignSimulations, "simulation") +
         " of each, about " + base::DurationText(seconds) + " of core time in all\n";
}

std::string DesignText(const DesignTable& table, const campaign::JointView& view,
                       const std::vector<TestCandidate>& tests) {
  static constexpr const char* kHeads[] = {"one test", "two tests", "three tests"};
  std::string text = GroundText(table);
  std::set<std::size_t> best;
  for (std::size_t size = 0; size < table.choices.size(); ++size) {
    if (table.choices[size].empty()) continue;
    text += std::string(kHeads[size]) + "\n" + ChoicesText(table, table.choices[size]);
    const std::vector<std::size_t>& first = table.choices[size].front().tests;
    best.insert(first.begin(), first.end());
  }
  for (const NextCandidate& candidate : table.tests.candidates) {
    if (!candidate.learning) text += "   -        " + candidate.name + ": " + candidate.what + "\n";
  }
  if (!best.empty()) text += "what the best ones need\n";
  for (const std::size_t t : best) text += TestText(view, tests[t], table.tests.candidates[t]);
  return text;
}

std::string DesignJson(const DesignTable& table) {
  auto json = nlohmann::ordered_json::parse(NextJson(table.tests));
  for (const char* of_campaign : {"after_trial", "simulate_first"}) json.erase(of_campaign);
  json["scale_factor"] = table.scale_factor;
  const Supposed supposed = SupposedOf(table);
  for (std::size_t i = 0; i < supposed.values.size(); ++i) {
    json["supposed"][supposed.parameters[i].name] = supposed.values[i];
  }
  json["choices"] = nlohmann::ordered_json::array();
  for (const std::vector<DesignChoice>& choices : table.choices) {
    for (const DesignChoice& choice : choices) {
      nlohmann::ordered_json entry{{"tests", nlohmann::ordered_json::array()},
                                   {"bits", choice.learning.bits},
                                   {"remaining", choice.remaining}};
      for (const std::size_t t : choice.tests) {
        entry["tests"].push_back(table.tests.candidates[t].name);
      }
      const auto add = [&](const char* key, const Eigen::VectorXd& width) {
        for (std::size_t i = 0; i < table.tests.parameters.size(); ++i) {
          entry[key][table.tests.parameters[i].name] = width[static_cast<Eigen::Index>(i)];
        }
      };
      add("width_90", choice.learning.width);
      add("width_90_low", choice.learning.narrow);
      add("width_90_high", choice.learning.wide);
      json["choices"].push_back(std::move(entry));
    }
  }
  return base::JsonText(json, 2) + "\n";
}

}  // namespace talus::analysis
