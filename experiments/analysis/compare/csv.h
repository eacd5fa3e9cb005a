// A table as CSV [rfc4180], a cell after the other.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace talus::analysis {

class Csv {
 public:
  Csv& Cell(std::string_view text);  // quoted where it must be
  Csv& Cell(double value);           // exact; empty where it is not finite
  Csv& Cells(const std::vector<double>& values);
  void EndRow();
  std::string Take() { return std::move(text_); }

 private:
  void Separate();

  std::string text_;
  bool first_ = true;
};

}  // namespace talus::analysis
