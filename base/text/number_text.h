// Numbers as text.
#pragma once

#include <cstdint>
#include <string>

namespace talus::base {

std::string ShortNumber(double x, int digits = 4);  // so many significant digits, for people
std::string ExactNumber(double x);                  // the shortest that reads back to the same
std::string ExactNumber(float x);
// "1.5 mm"; the unit may be "".
std::string WithUnit(double x, const std::string& unit, int digits = 4);
std::string FileNumber(std::int64_t n);  // four digits at least, so that names sort

}  // namespace talus::base
