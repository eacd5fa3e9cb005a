#include "base/units.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "base/digit_groups.h"
#include "base/error.h"
#include "base/replaced.h"
#include "base/trimmed.h"

namespace talus::base {
namespace {

struct Unit {
  std::string_view name;
  double si;  // how many SI units one of it is
};

constexpr double kPerMinute = 2 * std::numbers::pi / 60;  // a turn, in rad/s

constexpr Unit kNoUnits[] = {{"%", 0.01}};
// In Canonical spelling, the SI's first, then what people most often mean: an error names the first
// few.
constexpr Unit kLengths[] = {{"m", 1},          {"mm", 1e-3},       {"um", 1e-6},
                             {"cm", 1e-2},      {"dm", 1e-1},       {"nm", 1e-9},
                             {"micron", 1e-6},  {"microns", 1e-6},  {"in", 25.4e-3},
                             {"inch", 25.4e-3}, {"inches", 25.4e-3}};
constexpr Unit kMasses[] = {{"kg", 1},  {"g", 1e-3},    {"mg", 1e-6},   {"ug", 1e-9},
                            {"t", 1e3}, {"gram", 1e-3}, {"grams", 1e-3}};
constexpr Unit kTimes[] = {{"s", 1},     {"min", 60},  {"h", 3600}, {"ms", 1e-3},
                           {"us", 1e-6}, {"ns", 1e-9}, {"d", 86400}};
constexpr Unit kVelocities[] = {{"m/s", 1},     {"cm/s", 1e-2},        {"mm/s", 1e-3},
                                {"um/s", 1e-6}, {"mm/min", 1e-3 / 60}, {"m/min", 1.0 / 60}};
constexpr Unit kAccelerations[] = {{"m/s^2", 1}, {"cm/s^2", 1e-2}, {"g0", 9.80665}};
constexpr Unit kAngularVelocities[] = {
    {"rad/s", 1}, {"rpm", kPerMinute}, {"1/min", kPerMinute}, {"deg/s", kDegree}, {"°/s", kDegree}};
constexpr Unit kAngles[] = {{"rad", 1}, {"deg", kDegree}, {"°", kDegree}};
constexpr Unit kDensities[] = {{"kg/m^3", 1}, {"g/cm^3", 1e3}, {"g/mL", 1e3},
                               {"g/L", 1},    {"g/cc", 1e3},   {"g/ml", 1e3},
                               {"g/l", 1},    {"kg/L", 1e3},   {"kg/l", 1e3}};
constexpr Unit kPressures[] = {{"Pa", 1},    {"kPa", 1e3},    {"MPa", 1e6},    {"GPa", 1e9},
                               {"N/m^2", 1}, {"MN/m^2", 1e6}, {"N/mm^2", 1e6}, {"bar", 1e5}};
constexpr Unit kSurfaceEnergies[] = {
    {"J/m^2", 1}, {"mJ/m^2", 1e-3}, {"uJ/m^2", 1e-6}, {"N/m", 1}, {"mN/m", 1e-3}};
constexpr Unit kMassRates[] = {{"kg/s", 1}, {"g/s", 1e-3}, {"mg/s", 1e-6}, {"g/min", 1e-3 / 60}};
constexpr Unit kAreaDensities[] = {{"kg/m^2", 1},  {"g/m^2", 1e-3},  {"mg/cm^2", 1e-2},
                                   {"g/cm^2", 10}, {"mg/m^2", 1e-6}, {"ug/cm^2", 1e-5},
                                   {"mg/mm^2", 1}, {"ug/mm^2", 1e-3}};
constexpr Unit kEnergies[] = {{"J", 1}, {"mJ", 1e-3}, {"uJ", 1e-6}, {"nJ", 1e-9}, {"zJ", 1e-21}};

std::span<const Unit> UnitsOf(Dimension dimension) {
  switch (dimension) {
    case Dimension::kNone:
      return kNoUnits;
    case Dimension::kLength:
      return kLengths;
    case Dimension::kMass:
      return kMasses;
    case Dimension::kTime:
      return kTimes;
    case Dimension::kVelocity:
      return kVelocities;
    case Dimension::kAcceleration:
      return kAccelerations;
    case Dimension::kAngularVelocity:
      return kAngularVelocities;
    case Dimension::kAngle:
      return kAngles;
    case Dimension::kDensity:
      return kDensities;
    case Dimension::kPressure:
      return kPressures;
    case Dimension::kSurfaceEnergy:
      return kSurfaceEnergies;
    case Dimension::kEnergy:
      return kEnergies;
    case Dimension::kMassRate:
      return kMassRates;
    case Dimension::kAreaDensity:
      return kAreaDensities;
  }
  return {};
}

// "µm" → "um", "kg/m³" and "kg/m3" → "kg/m^3", "mm/sec" → "mm/s": as people type them.
std::string Canonical(std::string_view unit) {
  std::string name(unit);
  for (const char* micro : {"µ", "μ"}) name = Replaced(name, micro, "u");
  for (const auto& [from, to] : {std::pair{"²", "^2"}, {"³", "^3"}})
    name = Replaced(name, from, to);
  for (const char* letter : {"m", "s"}) {
    for (const char* power : {"2", "3"}) {
      name = Replaced(name, std::string(letter) + power, std::string(letter) + "^" + power);
    }
  }
  if (name.ends_with("sec")) name.resize(name.size() - 2);
  return name;
}

constexpr std::size_t kUnitsNamed = 4;

[[noreturn]] void Refuse(std::string_view text, Dimension dimension, std::string_view why) {
  std::string message = "\"" + std::string(text) + "\" " + std::string(why) + "; write a number";
  if (dimension != Dimension::kNone) message += " in " + std::string(SiUnit(dimension));
  message += " or a text such as";
  const char* separator = " ";
  for (const Unit& unit :
       UnitsOf(dimension).first(std::min(UnitsOf(dimension).size(), kUnitsNamed))) {
    message += separator + ("\"1 " + std::string(unit.name) + "\"");
    separator = ", ";
  }
  throw ConfigError(message);
}

// "1,602.5" as "1602.5", and "1.602,5" so, too; none where the groups are not of thousands.
std::optional<std::string> WithoutGroups(std::string_view number, char separator, char point) {
  const std::size_t at = number.find(point);
  const std::string_view whole = number.substr(0, at);
  if (!IsGrouped(whole, separator)) return std::nullopt;
  std::string plain(whole);
  std::erase(plain, separator);
  if (at == std::string_view::npos) return plain;
  const std::string_view decimals = number.substr(at + 1);
  if (!AreDigits(decimals)) return std::nullopt;
  return plain + "." + std::string(decimals);
}

// What a number with a comma may be meant as: a decimal, or one with its thousands apart.
std::string CommaAdvice(std::string_view sign, std::string_view number, std::string_view unit) {
  const auto whole = [&](const std::string& plain) {
    return "\"" + std::string(sign) + plain + std::string(unit) + "\"";
  };
  const std::size_t comma = number.find(',');
  if (comma == std::string_view::npos) return "its exponent without one";
  const auto by_commas = WithoutGroups(number, ',', '.');
  if (AreDigits(number.substr(0, comma)) && AreDigits(number.substr(comma + 1))) {
    const std::string decimal = Replaced(number, ",", ".");
    return whole(decimal) + " with a point" +
           (by_commas ? ", or " + whole(*by_commas) + " if the comma parts thousands" : "");
  }
  const auto plain = by_commas ? by_commas : WithoutGroups(number, '.', ',');
  return plain ? whole(*plain) + " without" : "it with one point at most";
}

// "1,602 g" would be 1 with the unit ",602 g": the comma of a decimal, or of thousands.
void RefuseComma(std::string_view text, std::string_view trimmed, std::string_view rest) {
  if (rest.size() < 2 || rest.front() != ',' || !IsDigit(rest[1])) return;
  const std::string_view sign = trimmed.substr(0, trimmed.front() == '-' ? 1 : 0);
  const std::string_view unsigned_text = trimmed.substr(sign.size());
  const std::size_t end =
      std::min(unsigned_text.find_first_not_of("0123456789.,"), unsigned_text.size());
  throw ConfigError("\"" + std::string(text) + "\" has a comma in its number; write " +
                    CommaAdvice(sign, unsigned_text.substr(0, end), unsigned_text.substr(end)));
}

// What stands after a number; nothing where there is none.
std::optional<std::string_view> AfterNumber(std::string_view text) {
  const std::string_view trimmed = Trimmed(text);
  double value = 0;
  const char* const end = trimmed.data() + trimmed.size();
  const auto [rest, status] = std::from_chars(trimmed.data(), end, value);
  if (status != std::errc() || !std::isfinite(value)) return std::nullopt;
  return Trimmed(trimmed.substr(static_cast<std::size_t>(rest - trimmed.data())));
}

}  // namespace

std::string_view SiUnit(Dimension dimension) {
  return dimension == Dimension::kNone ? std::string_view() : UnitsOf(dimension).front().name;
}

std::string_view UnitIn(std::string_view text) {
  const std::optional<std::string_view> rest = AfterNumber(text);
  return rest && !rest->starts_with(',') ? *rest : std::string_view();
}

bool IsBareNumber(std::string_view text) {
  const std::optional<std::string_view> rest = AfterNumber(text);
  return rest && rest->empty();
}

double ParseQuantity(std::string_view text, Dimension dimension) {
  const std::string_view trimmed = Trimmed(text);
  double value = 0;
  const auto [end, status] =
      std::from_chars(trimmed.data(), trimmed.data() + trimmed.size(), value);
  if (status != std::errc() || !std::isfinite(value)) {
    Refuse(text, dimension, "does not start with a number");
  }
  const std::string_view rest = trimmed.substr(static_cast<std::size_t>(end - trimmed.data()));
  RefuseComma(text, trimmed, rest);
  const std::string_view name = Trimmed(rest);
  if (name.empty()) return value;
  const std::string canonical = Canonical(name);
  for (const Unit& unit : UnitsOf(dimension)) {
    if (unit.name != canonical) continue;
    if (!std::isfinite(value * unit.si)) Refuse(text, dimension, "is too large a number");
    return value * unit.si;
  }
  Refuse(text, dimension, "has the unit \"" + std::string(name) + "\", which does not fit here");
}

}  // namespace talus::base
