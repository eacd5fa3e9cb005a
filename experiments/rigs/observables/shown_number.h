// Metrics in the units that people read them in: milligrams of a heap, millimetres of a column.
#pragma once

#include <string>
#include <string_view>

namespace talus::rigs {

// "mm2" → "mm²", "deg" → "°", "J/m^2" → "J/m²", "-" → "".
std::string PrettyUnit(std::string_view unit);

struct ShownUnit {
  std::string text;     // "mg"
  double per_unit = 1;  // a number in it / the metric's value
};
ShownUnit ShownUnitOf(std::string_view unit);

// "mass_fallen_kg" → "mass_fallen_mg", which is read in milligrams.
std::string ShownName(const std::string& metric);

// "mass fallen" of "mass_fallen_kg": in a sentence, with a number that has its unit.
std::string SpokenName(const std::string& metric);

// A metric's value as it can be: a model's mass below zero is none, its share above one is all.
double Possible(std::string_view metric, double value);

// "5.04 mg" of 5.04e-6 of "mass_fallen_kg".
std::string ShownNumber(std::string_view metric, double value, int digits = 4);

// The same of a standard error, which the bounds of the value do not hold for.
std::string ShownError(std::string_view metric, double error, int digits = 4);

}  // namespace talus::rigs
