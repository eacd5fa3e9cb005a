// Tables of numbers with a line of names: talus, ParaView's exported tables, YADE's text export.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/not_known.h"
#include "base/text/byte_order_mark.h"
#include "imaging/formats/spheres/sphere_formats.h"
#include "imaging/formats/spheres/text_cursor.h"

namespace talus::imaging {
namespace {

// The separator is the first of these that the line of names has.
char SeparatorOf(std::string_view line) {
  for (const char separator : {',', ';', '\t'}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

// Takes a cell and the separator behind it off the front; a quoted one may hold separators.
std::string_view TakeCell(std::string_view& line, char separator, const TextCursor& cursor) {
  const std::size_t first = line.find_first_not_of(" \t");
  const bool quoted = first != std::string_view::npos && line[first] == '"';
  const std::size_t closing = quoted ? line.find('"', first + 1) : 0;
  if (closing == std::string_view::npos) {
    cursor.Fail("has a quote that is not closed; close it, or write the cell without quotes");
  }
  const std::size_t end = std::min(line.find(separator, closing), line.size());
  const std::string_view cell =
      quoted ? line.substr(first + 1, closing - first - 1) : Trimmed(line.substr(0, end));
  line.remove_prefix(end);
  return cell;
}

std::vector<std::string_view> Cells(std::string_view line, char separator,
                                    const TextCursor& cursor) {
  if (separator == ' ') return Words(line);
  std::vector<std::string_view> cells{TakeCell(line, separator, cursor)};
  while (!line.empty()) {
    line.remove_prefix(1);
    cells.push_back(TakeCell(line, separator, cursor));
  }
  return cells;
}

struct Head {
  std::vector<std::string> names;
  char separator = ',';
};

// "x,y,z,r", "# x y z r" (numpy) or "#format x_y_z_r" (YADE, whose rows are parted by tabs).
Head ReadHead(TextCursor& cursor) {
  std::string_view line = base::WithoutByteOrderMark(Trimmed(cursor.Line()));
  while (line.starts_with('#')) line = Trimmed(line.substr(1));
  constexpr std::string_view kYade = "format ";
  const bool yade = line.starts_with(kYade);
  const char separator = yade ? '_' : SeparatorOf(line);
  Head head{.names = {}, .separator = yade ? '\t' : separator};
  for (const std::string_view cell :
       Cells(yade ? line.substr(kYade.size()) : line, separator, cursor)) {
    head.names.emplace_back(cell);
  }
  double number = 0;
  if (!head.names.empty() && ParseNumber(head.names.front(), number)) {
    cursor.Fail("the first line must name the columns, such as x_m,y_m,z_m,diameter_m");
  }
  return head;
}

// A spreadsheet in a language with decimal commas writes numbers so.
bool HasDecimalComma(std::string_view cell) {
  std::string with_point(cell);
  const std::size_t comma = with_point.find(',');
  if (comma == std::string::npos) return false;
  with_point[comma] = '.';
  double number = 0;
  return ParseNumber(with_point, number);
}

void ReadRow(const TextCursor& cursor, const std::vector<std::string_view>& cells,
             const SphereColumns& columns, std::vector<double>& row,
             std::vector<base::Sphere>& spheres) {
  if (cells.size() != row.size()) {
    cursor.Fail("has " + std::to_string(cells.size()) + " values where the first line names " +
                std::to_string(row.size()));
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    // A column that is not ours may hold a text; if it is ours, Row's value is refused later.
    if (!ParseNumber(cells[c], row[c])) row[c] = base::kNotKnown;
  }
  const base::Sphere sphere = columns.Row(row);
  const auto& [x, y, z] = sphere.position;
  if (!std::isnan(x + y + z + sphere.radius)) {
    spheres.push_back(sphere);
    return;
  }
  const auto comma = std::ranges::find_if(cells, HasDecimalComma);
  if (comma != cells.end()) {
    cursor.Fail("has a decimal comma (" + std::string(*comma) + "); write numbers with a point");
  }
  spheres.push_back(sphere);
}

}  // namespace

std::vector<base::Sphere> ReadSphereCsv(std::string_view text, const std::string& file,
                                        const SphereFileOptions& options) {
  TextCursor cursor(text, file);
  const Head head = ReadHead(cursor);
  const SphereColumns columns(head.names, file, options.length_unit.value_or(1));
  std::vector<base::Sphere> spheres;
  std::vector<double> row(head.names.size());
  while (!cursor.AtEnd()) {
    const std::string_view line = cursor.Line();
    const std::string_view trimmed = Trimmed(line);
    if (trimmed.empty() || trimmed.starts_with('#')) continue;
    ReadRow(cursor, Cells(head.separator == '\t' ? trimmed : line, head.separator, cursor), columns,
            row, spheres);
  }
  return spheres;
}

}  // namespace talus::imaging
