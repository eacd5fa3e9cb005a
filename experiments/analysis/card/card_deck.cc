#include "experiments/analysis/card/card_deck.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/joined.h"
#include "base/text/name.h"
#include "engine/laws/material.h"
#include "experiments/analysis/card/card_formats.h"
#include "experiments/analysis/card/card_json.h"
#include "experiments/trials/engines/case_values.h"

namespace talus::analysis {
namespace {

// What the case makes of the calibrated values and the deck may have taken in their place, and what
// they hold together with.
constexpr const char* kGivenWithThem[] = {"surface_energy_used", "scale_factor", "mean_diameter",
                                          "time_step"};

constexpr const char* kNothingConverted =
    "values of the deck's placeholders as they went into it, in SI units; nothing is converted: "
    "what they mean is the deck's";

std::string DeckMark(CardFormat format) {
  if (format == CardFormat::kTable) return "";
  return format == CardFormat::kMercuryDpm ? "// " : "# ";
}

// ", 90 %: 0.2 ... 0.4" of a calibrated parameter.
std::string RangeOfPlaceholder(const Card& card, const std::string& name) {
  const auto range = std::ranges::find(card.ranges, name, &CardRange::name);
  return range == card.ranges.end() ? "" : CardRangeText(*range);
}

std::string DeckJson(const Card& card) {
  nlohmann::ordered_json json{
      {"title", card.title},
      {"engine", {{"command", card.deck->command}, {"templates", card.deck->templates}}},
      {"placeholders_are", kNothingConverted}};
  for (const auto& [name, value] : card.deck->placeholders) json["placeholders"][name] = value;
  for (const auto& [name, value] : card.deck->given) json["given_with_them"][name] = value;
  if (!card.ranges.empty()) json["parameters"] = RangesJson(card);
  for (const CardTest& test : card.tests) json["tests"].push_back(TestJson(test));
  json["warnings"] = card.notes;
  return base::JsonText(json, 2) + "\n";
}

}  // namespace

CardDeck DeckOf(const trials::CommandOptions& engine, const rigs::Case& rig_case,
                const std::vector<std::string>& names) {
  const trials::TemplateValues values = trials::CaseValues(rig_case);
  CardDeck deck{.command = base::Joined(engine.command, " "),
                .templates = engine.templates ? engine.templates->string() : ""};
  // What is of the bulk has no placeholder: it reaches a deck by the grains.
  const auto add = [&](const std::string& name, std::vector<CardPlaceholder>& to) {
    const auto value = values.scalars.find(name);
    if (value != values.scalars.end()) to.push_back({name, value->second});
  };
  for (const std::string& name : names) add(name, deck.placeholders);
  for (const char* name : kGivenWithThem) add(name, deck.given);
  return deck;
}

std::vector<std::string> PowderPlaceholders() {
  std::vector<std::string> names;
  const engine::Material any;
  engine::Material::Visit(
      any, [&](std::string_view key, double, const base::FieldInfo&) { names.emplace_back(key); });
  return names;
}

std::string DeckCardText(const Card& card, CardFormat format) {
  if (format == CardFormat::kJson) return DeckJson(card);
  const std::string mark = DeckMark(format);
  std::ostringstream text;
  text << mark << base::OneLine(card.title)
       << (card.is_calibrated ? ", calibrated with talus" : ", a case of talus as it is")
       << ", by a deck of its own: " << base::OneLine(card.deck->command) << " ("
       << base::OneLine(card.deck->templates) << ").\n"
       << mark << "Here are the " << kNothingConverted << ".\n";
  for (const auto& [name, value] : card.deck->placeholders) {
    text << mark << "  {{ " << name << " }} = " << value << RangeOfPlaceholder(card, name) << '\n';
  }
  text << mark << "Given with them:";
  for (const auto& [name, value] : card.deck->given) {
    text << (name == card.deck->given.front().name ? " " : ", ") << "{{ " << name
         << " }} = " << value;
  }
  text << '\n' << mark << "The tests that they come from:\n";
  for (const CardTest& test : card.tests) text << mark << "  " << TestText(test) << '\n';
  for (const std::string& note : card.notes) {
    text << mark << "Warning: " << base::OneLine(note) << '\n';
  }
  return text.str();
}

}  // namespace talus::analysis
