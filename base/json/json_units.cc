#include "base/json/json_units.h"

#include <string>

#include "base/json/json_text.h"
#include "base/text/number_text.h"
#include "base/units.h"

namespace talus::base {
namespace {

using nlohmann::json;

std::string UnitOfText(const json& value) {
  return value.is_string() ? std::string(UnitIn(value.get_ref<const std::string&>())) : "";
}

// The unit of a text, or of the first in a list that has one; "" where there is none.
std::string FirstUnit(const json& value) {
  if (!value.is_array()) return UnitOfText(value);
  for (const json& entry : value) {
    if (const std::string unit = UnitOfText(entry); !unit.empty()) return unit;
  }
  return "";
}

// A number, or a text that is one and nothing else; "" of all others, and of 0.
std::string BareNumber(const json& value) {
  const std::string text = value.is_number()   ? JsonText(value)
                           : value.is_string() ? value.get<std::string>()
                                               : "";
  return IsBareNumber(text) && ParseQuantity(text, Dimension::kNone) != 0 ? text : "";
}

// "2 %" for a 2 that stands beside percents; of a 0.02 either may be meant.
std::string RemedyInPercent(const std::string& bare) {
  const double share = ParseQuantity(bare, Dimension::kNone);
  return "is " + bare + " without a % beside a number that has one; write \"" + bare + " %\"" +
         (share > 1 ? "" : ", or \"" + ShortNumber(100 * share) + " %\" for the share " + bare);
}

void RequireUnit(const json& value, const std::string& unit, std::string_view place,
                 Problems& problems) {
  const std::string bare = BareNumber(value);
  if (bare.empty()) return;
  if (unit == "%") return problems.AddUnread(place, RemedyInPercent(bare));
  problems.AddUnread(place, "is " + bare + " without a unit beside one in " + unit +
                                "; a bare number is in SI: write \"" + bare + " " + unit +
                                "\", or give it the SI unit that it has");
}

}  // namespace

void RequireUnits(const json& object, const json& value, std::string_view unit_of,
                  Problems& problems) {
  const auto beside = object.find(std::string(unit_of));
  if (unit_of.empty() || beside == object.end()) return;
  const std::string unit = FirstUnit(*beside);
  if (unit.empty()) return;
  if (!value.is_array()) return RequireUnit(value, unit, "", problems);
  if (!beside->is_array()) return;  // a list in place of a number is said elsewhere
  for (std::size_t i = 0; i < value.size(); ++i) {
    RequireUnit(value[i], unit, "[" + std::to_string(i) + "]", problems);
  }
}

}  // namespace talus::base
