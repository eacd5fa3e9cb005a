#include "base/text/number_text.h"

#include <charconv>
#include <cstdio>

namespace talus::base {
namespace {

template <class T>
std::string Shortest(T x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

}  // namespace

std::string ShortNumber(double x, int digits) {
  char text[40];  // as "%.*g" writes it, whatever the locale of the program that uses this library
  return {text, std::to_chars(text, text + sizeof text, x, std::chars_format::general, digits).ptr};
}

std::string ExactNumber(double x) { return Shortest(x); }

std::string ExactNumber(float x) { return Shortest(x); }

std::string FileNumber(std::int64_t n) {
  char text[32];
  std::snprintf(text, sizeof text, "%04lld", static_cast<long long>(n));
  return text;
}

std::string WithUnit(double x, const std::string& unit, int digits) {
  return ShortNumber(x, digits) + (unit.empty() ? "" : " " + unit);
}

}  // namespace talus::base
