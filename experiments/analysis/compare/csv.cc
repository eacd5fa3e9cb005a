#include "experiments/analysis/compare/csv.h"

#include <charconv>
#include <cmath>

namespace talus::analysis {

Csv& Csv::Cell(std::string_view text) {
  Separate();
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += text;
    return *this;
  }
  text_ += '"';
  for (const char c : text) text_ += c == '"' ? std::string("\"\"") : std::string(1, c);
  text_ += '"';
  return *this;
}

Csv& Csv::Cell(double value) {
  Separate();
  if (!std::isfinite(value)) return *this;
  char digits[32];
  text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  return *this;
}

Csv& Csv::Cells(const std::vector<double>& values) {
  for (const double value : values) Cell(value);
  return *this;
}

void Csv::EndRow() {
  text_ += '\n';
  first_ = true;
}

void Csv::Separate() {
  if (!first_) text_ += ',';
  first_ = false;
}

}  // namespace talus::analysis
