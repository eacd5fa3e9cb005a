#include "experiments/trials/optimize/answer_image.h"

#include <charconv>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "base/files/file.h"
#include "base/text/byte_order_mark.h"
#include "base/text/lower.h"
#include "base/text/number_text.h"
#include "base/trimmed.h"
#include "imaging/formats/images/image_file.h"

namespace talus::trials {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::vector<double> Row(std::string_view line, const std::string& place) {
  std::vector<double> row;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    const std::string_view cell = base::Trimmed(line.substr(start, end - start), kBlanks);
    double value = 0;
    const auto [last, code] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (code != std::errc() || last != cell.data() + cell.size()) {
      throw base::ConfigError(place + ": \"" + std::string(cell) +
                              "\" is no number; give rows of numbers between commas");
    }
    row.push_back(value);
    start = end + 1;
  }
  return row;
}

AnswerImage FromCsv(const std::filesystem::path& path) {
  std::istringstream text(std::string(base::WithoutByteOrderMark(base::ReadFile(path))));
  std::vector<std::vector<double>> rows;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (base::Trimmed(line, kBlanks).empty()) continue;
    rows.push_back(Row(line, path.string() + ":" + std::to_string(number)));
  }
  return FromRows(rows, path.string());
}

}  // namespace

AnswerImage ReadAnswerImage(const std::filesystem::path& path) {
  if (base::Lower(path.extension()) == ".csv") return FromCsv(path);
  const imaging::GrayImage gray = imaging::ReadGrayImage(path);
  AnswerImage image{.field = {}, .width = gray.width};
  for (const std::uint8_t pixel : gray.pixels) {
    image.field.push_back(1.0F - static_cast<float>(pixel) / 255.0F);
  }
  return image;
}

AnswerImage FromRows(const std::vector<std::vector<double>>& rows, const std::string& name) {
  if (rows.empty() || rows.front().empty()) throw base::ConfigError(name + ": has no pixels");
  AnswerImage image{.field = {}, .width = static_cast<int>(rows.front().size())};
  for (const auto& row : rows) {
    if (row.size() != rows.front().size()) {
      throw base::ConfigError(name + ": has rows of different length");
    }
    for (const double pixel : row) {
      if (!(pixel >= 0 && pixel <= 1)) {
        throw base::ConfigError(name + ": has a pixel outside [0, 1]: 0 is empty, 1 is powder");
      }
      image.field.push_back(static_cast<float>(pixel));
    }
  }
  return image;
}

std::string ToCsv(std::span<const float> field, int width) {
  std::string csv;
  for (std::size_t i = 0; i < field.size(); ++i) {
    csv += base::ExactNumber(field[i]);
    csv += (i + 1) % static_cast<std::size_t>(width) == 0 ? '\n' : ',';
  }
  return csv;
}

}  // namespace talus::trials
