// A table as CSV [rfc4180], a cell after the other. Texts may be of others: they become printable.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace talus::base {

class Csv {
 public:
  Csv& Cell(std::string_view text);  // quoted where it must be
  Csv& Cell(double value);           // exact; empty where it is not finite
  Csv& Cell(std::integral auto value) { return Cell(std::string_view(std::to_string(value))); }
  Csv& Cells(const std::vector<double>& values);
  Csv& Heads(std::initializer_list<std::string_view> names);
  void EndRow();
  std::string Take() { return std::move(text_); }

 private:
  void Separate();

  std::string text_;
  bool first_ = true;
};

}  // namespace talus::base
