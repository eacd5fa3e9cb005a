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

// A cell that begins with a quote ends with one: a separator in it separates nothing, and two
// quotes in it are one (RFC 4180). Elsewhere a quote is a character, an inch say.
std::vector<std::string> Cells(const std::string& line, char separator, const std::string& place) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool is_double = quoted && line.substr(i, 2) == "\"\"";
    if (is_double) {
      cells.back() += line[++i];
    } else if (c == '"' && (quoted || base::Trimmed(cells.back(), " \t").empty())) {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  if (quoted) throw base::ConfigError(place + ": has a quote that is not closed in its line");
  for (std::string& cell : cells) {
    cell = base::Trimmed(cell, " \t\r");
    if (separator == ';') std::ranges::replace(cell, ',', '.');
  }
  return cells;
}

// The cells of a row under the head; what is beyond it must be empty, as spreadsheets leave it.
std::vector<std::string> RowCells(const std::string& line, char separator, std::size_t num_columns,
                                  const std::string& place) {
  const std::vector<std::string> cells = Cells(line, separator, place);
  for (std::size_t i = num_columns; i < cells.size(); ++i) {
    if (cells[i].empty()) continue;
    throw base::ConfigError(place + ": has " + std::to_string(cells.size()) +
                            " cells and the head " + std::to_string(num_columns) +
                            (separator == ','
                                 ? "; write decimals with a point, or semicolons between columns"
                                 : "; name every column in the head"));
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
    if (std::find(found + 1, head.end(), name) != head.end()) {
      throw base::ConfigError(file + ":1: has two columns \"" + name +
                              "\"; name each searched parameter once");
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
  const std::vector<std::string> head = Cells(line, separator, path.string() + ":1");
  const std::vector<std::size_t> columns = Columns(head, names, path.string());
  std::vector<std::vector<double>> rows;
  for (int number = 2; std::getline(text, line); ++number) {
    const std::string place = path.string() + ":" + std::to_string(number);
    const std::vector<std::string> cells = RowCells(line, separator, head.size(), place);
    if (std::ranges::all_of(cells, &std::string::empty)) continue;
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
