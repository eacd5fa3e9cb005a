#include "experiments/analysis/report/methods.h"

#include <algorithm>
#include <cmath>

#include "base/text/number_text.h"

namespace talus::analysis {
namespace {

std::string Spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string WithUnit(double value, const std::string& unit) {
  return base::ShortNumber(value) + (unit.empty() ? "" : " " + unit);
}

// "a, b and c"
std::string Listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += words[i];
  }
  return text;
}

std::string Searched(const Evidence& evidence) {
  std::vector<std::string> words;
  for (const ParameterInfo& p : evidence.parameters) {
    words.push_back(
        Spaced(p.range.name) + " " + p.symbol + " in [" + base::ShortNumber(p.range.low) + ", " +
        WithUnit(p.range.high, p.unit) + "]" +
        (p.range.scale == optimizer::Scale::kLog ? " (searched on a logarithmic scale)" : ""));
  }
  return Listed(words);
}

std::string Answered(const Evidence& evidence, const ObjectiveFinding& own) {
  const Conclusion& c = *evidence.conclusion;
  std::vector<std::string> words;
  for (std::size_t k = 0; k < c.values.size() && k < evidence.parameters.size(); ++k) {
    const ParameterInfo& p = evidence.parameters[k];
    std::string word = p.symbol + " = " + WithUnit(c.values[k].value, p.unit);
    if (std::isfinite(c.values[k].low)) {
      word += " (90 % credible range " + base::ShortNumber(c.values[k].low) + " to " +
              base::ShortNumber(c.values[k].high) + ")";
    }
    words.push_back(word);
  }
  std::string text = " The recommended set is " + Listed(words) + ".";
  if (c.num_confirmed > 0) {
    text += " Simulated again with " + std::to_string(c.num_confirmed) +
            " fresh seeds, it has a mean " + std::string(own.info.title) + " of " +
            WithUnit(c.confirmed, std::string(own.info.unit)) + ".";
  }
  return text;
}

// The version and commit of the program that started the campaign.
std::string StartedWith(const Evidence& evidence) {
  return evidence.versions.empty() ? "" : evidence.versions.front().text;
}

}  // namespace

std::string MethodsText(const ReportData& data) {
  const Evidence& e = data.evidence;
  const auto count = [&](journal::TrialStatus state, bool confirming) {
    return std::ranges::count_if(e.trials, [&](const TrialEvidence& t) {
      return t.state == state && (t.purpose == "confirm") == confirming;
    });
  };
  const auto failed =
      count(journal::TrialStatus::kFailed, false) + count(journal::TrialStatus::kFailed, true);
  std::string text = "The contact parameters were calibrated with talus " + StartedWith(e) +
                     ". Simulated heaps were projected into the frame of the experiment's average "
                     "heap profile and compared with it by the ";
  text += data.own().info.title;
  text += ". Calibrated were " + Searched(e) + ". The strategy \"" + e.strategy + "\" chose " +
          std::to_string(count(journal::TrialStatus::kOk, false)) + " simulations that gave a heap";
  text += failed > 0 ? "; " + std::to_string(failed) + " failed." : ".";
  if (std::isfinite(e.reference.noise_floor)) {
    text += " The experiment's runs differ from the mean of the others by " +
            base::ShortNumber(e.reference.noise_floor) + " mm² (leave-one-run-out SAD).";
  }
  if (e.conclusion) text += Answered(e, data.own());
  return text;
}

}  // namespace talus::analysis
