#include "experiments/analysis/report/views/answer_words.h"

#include <cctype>

#include "base/not_known.h"
#include "base/text/number_text.h"
#include "engine/laws/material.h"
#include "experiments/analysis/compare/labels.h"
#include "experiments/campaign/answer/headline.h"
#include "experiments/campaign/answer/hold_out.h"
#include "experiments/campaign/answer/nuisances.h"
#include "experiments/campaign/answer/verdict.h"
#include "experiments/campaign/folder/folder_in_text.h"

namespace talus::analysis {
namespace {

using campaign::AlarmKind;
using campaign::Answer;

}  // namespace

std::vector<std::string> HeadlineWords(const Evidence& evidence) {
  std::vector<std::string> names;
  for (const ParameterInfo& parameter : evidence.parameters) {
    names.push_back(LongNameOf(parameter.range.name));
  }
  std::vector<std::string> sentences = campaign::Headline(*evidence.answer, names);
  for (std::string& sentence : sentences) sentence = WithPowers(sentence);
  return sentences;
}

std::string WithPowers(const std::string& text) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at]));
  };
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool has_sign = i + 1 < text.size() && (text[i + 1] == '-' || text[i + 1] == '+');
    if (text[i] != 'e' || i == 0 || !is_digit(i - 1) || !has_sign || !is_digit(i + 2)) {
      shown += text[i];
      continue;
    }
    shown += std::string(" × 10") + (text[i + 1] == '-' ? "⁻" : "");
    bool begun = false;
    for (i += 2; is_digit(i); ++i) {
      begun |= text[i] != '0';
      if (begun) shown += kDigits[text[i] - '0'];
    }
    --i;
  }
  return shown;
}

std::optional<std::pair<std::size_t, std::size_t>> TradedPair(const Answer& answer) {
  constexpr double kClear = 0.5;
  auto pair = campaign::TiedPair(campaign::AskedPart(answer).correlation, kClear);
  if (!pair) return pair;
  const std::vector<std::size_t> asked = campaign::AskedParameters(answer);
  return std::pair(asked[pair->first], asked[pair->second]);
}

std::string TradeOffWords(const Evidence& evidence) {
  const auto pair = TradedPair(*evidence.answer);
  if (!pair) return "";
  const bool falls = evidence.answer->correlation[pair->second][pair->first] < 0;
  return "Higher " + evidence.parameters[pair->first].symbol + " goes with " +
         (falls ? "lower " : "higher ") + evidence.parameters[pair->second].symbol +
         ": change them together.";
}

double VolumeThen(const Answer& answer) {
  if (!answer.unsettled || answer.unsettled->narrowing.empty()) return base::kNotKnown;
  double volume = 1;
  for (const campaign::ResultNarrowing& one : answer.unsettled->narrowing) volume *= 1 - one.share;
  return volume;
}

std::string UseWords(const Answer& answer) {
  const bool searches_on = campaign::HasAlarm(answer, {AlarmKind::kSearchMisses});
  if (searches_on && campaign::HasAlarm(answer, {AlarmKind::kImplausible, AlarmKind::kDisagree})) {
    return "No: no set found so far fits every measurement, and the search is not done. Simulate "
           "more first.";
  }
  if (campaign::HasAlarm(answer, {AlarmKind::kImplausible})) {
    return "No: no set fits every measurement. Check contact law, plate and set-up first.";
  }
  if (campaign::HasAlarm(answer, {AlarmKind::kDisagree})) {
    return "No: the tests disagree. Check contact law, plate and set-up of each first.";
  }
  if (campaign::HasAlarm(answer, {AlarmKind::kMisses})) {
    return "No: a simulation with it misses what was measured. Check contact law, plate and set-up "
           "first.";
  }
  if (campaign::HasAlarm(answer, {AlarmKind::kConfirmationFailed})) {
    return "No: the simulations with it failed. Find out why first.";
  }
  if (searches_on) {
    return "No: a simulation with it misses what was measured, and the search is not done. "
           "Simulate more first.";
  }
  if (!answer.verdict) return "";
  if (answer.verdict->kind != campaign::VerdictKind::kPoint) {
    return "For trial runs only: other sets fit as well. Do the first of the next steps before you "
           "rely on one.";
  }
  if (campaign::AsksForSimulations(answer)) {
    return "For trial runs: more simulations should confirm it first, as the warnings say.";
  }
  if (campaign::HasAlarm(answer, {AlarmKind::kBound})) {
    return "Not yet: a parameter lies on the end of its range.";
  }
  return "Yes, as one set, for what it holds for (below).";
}

std::vector<std::string> AlarmWords(const Evidence& evidence) {
  std::vector<std::string> words;
  for (const campaign::Alarm& alarm : evidence.answer->warnings) {
    words.push_back(campaign::WithFolder(campaign::AlarmText(alarm), evidence.folder));
  }
  return words;
}

std::vector<std::string> ConditionWords(const campaign::ResultConditions& c) {
  std::vector<std::string> words{
      "Young's modulus of the grains " + base::ShortNumber(c.youngs_modulus / 1e6) + " MPa",
      "adhesion model " + c.adhesion + ", rolling model " + c.rolling};
  if (!c.command.empty()) words = {"the deck of \"" + c.command + "\" and its contact laws"};
  for (const campaign::ResultDevice& device : c.devices) {
    words.push_back(device.experiment + ", " + device.text);
  }
  std::string size = "grains at their true size";
  if (c.scale_factor != 1) {
    size = "grains " + base::ShortNumber(c.scale_factor) + " times their true size";
    if (c.adhesion != base::NameOf(engine::Adhesion::kNone)) {
      size +=
          ", surface energy scaled with exponent " + base::ShortNumber(c.surface_energy_exponent);
    }
  }
  words.push_back(size);
  return words;
}

std::vector<std::string> HeldOutWords(const Answer& answer) {
  if (!answer.held_out) return {};
  std::vector<std::string> words = campaign::HeldOutFacts(*answer.held_out, answer.objective_unit);
  words.insert(words.begin(),
               "the answer is made without " + answer.held_out->name + " and predicts it");
  return words;
}

}  // namespace talus::analysis
