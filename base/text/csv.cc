#include "base/text/csv.h"

#include <cmath>

#include "base/text/number_text.h"
#include "base/text/printable.h"

namespace talus::base {

Csv& Csv::Cell(std::string_view from_outside) {
  Separate();
  const std::string text = Printable(from_outside);
  if (text.find_first_of(",\"\n") == std::string::npos) {
    text_ += text;
    return *this;
  }
  text_ += '"';
  for (const char c : text) text_ += c == '"' ? std::string("\"\"") : std::string(1, c);
  text_ += '"';
  return *this;
}

Csv& Csv::Cell(double value) {
  return Cell(std::string_view(std::isfinite(value) ? ExactNumber(value) : ""));
}

Csv& Csv::Cells(const std::vector<double>& values) {
  for (const double value : values) Cell(value);
  return *this;
}

Csv& Csv::Heads(std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) Cell(name);
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

}  // namespace talus::base
