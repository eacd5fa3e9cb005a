#include "optimizer/space/candidate_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/files/file.h"
#include "base/text/byte_order_mark.h"
#include "base/trimmed.h"

namespace talus::optimizer {
namespace {

// Spreadsheets of countries that write decimals with a comma separate by semicolons.
char SeparatorOf(const std::string& head) {
  const bool by_semicolons =
      head.find(',') == std::string::npos && head.find(';') != std::string::npos;
  return by_semicolons ? ';' : ',';
}

std::vector<std::string> Cells(const std::string& line, char separator) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, separator);) {
    cells.emplace_back(base::Trimmed(cell, " \t\r\""));
    if (separator == ';') std::ranges::replace(cells.back(), ',', '.');
  }
  return cells;
}

std::vector<std::size_t> Columns(const std::vector<std::string>& head,
                                 const std::vector<std::string>& names, const std::string& file) {
  std::vector<std::size_t> columns;
  for (const std::string& name : names) {
    const auto found = std::find(head.begin(), head.end(), name);
    if (found == head.end()) {
      throw base::ConfigError(file + ":1: has no column \"" + name +
                              "\"; the head of the table must name every searched parameter");
    }
    columns.push_back(static_cast<std::size_t>(found - head.begin()));
  }
  return columns;
}

double Number(const std::string& cell, const std::string& place) {
  double value = 0;
  const auto [last, code] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (code == std::errc() && last == cell.data() + cell.size() && std::isfinite(value)) {
    return value;
  }
  throw base::ConfigError(place + ": \"" + cell + "\" is no number");
}

}  // namespace

std::vector<std::vector<double>> ReadCandidateTable(const std::filesystem::path& path,
                                                    const std::vector<std::string>& names) {
  const std::string content = base::ReadFile(path);
  std::istringstream text{std::string(base::WithoutByteOrderMark(content))};
  std::string line;
  std::getline(text, line);
  const char separator = SeparatorOf(line);
  const std::vector<std::size_t> columns = Columns(Cells(line, separator), names, path.string());
  std::vector<std::vector<double>> rows;
  for (int number = 2; std::getline(text, line); ++number) {
    const std::vector<std::string> cells = Cells(line, separator);
    if (cells.empty() || (cells.size() == 1 && cells.front().empty())) continue;
    const std::string place = path.string() + ":" + std::to_string(number);
    std::vector<double> row;
    for (const std::size_t column : columns) {
      if (column >= cells.size()) throw base::ConfigError(place + ": has too few columns");
      row.push_back(Number(cells[column], place));
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty() || rows.size() > kMaxCandidates) {
    throw base::ConfigError(path.string() + ": has " + std::to_string(rows.size()) +
                            " candidates, must have 1 to " + std::to_string(kMaxCandidates));
  }
  return rows;
}

}  // namespace talus::optimizer
