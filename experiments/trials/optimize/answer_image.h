// An image as a strategy takes it, from the files and the JSON that a command writes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace talus::trials {

// Row by row from the top, in [0, 1] with 1 = powder.
struct AnswerImage {
  std::vector<float> field;
  int width = 0;
};

// A grey image, black = powder (PNG, JPEG, TIFF, BMP, PGM), or a .csv file of rows from the top in
// [0, 1] with 1 = powder. Throws base::ConfigError that names the file.
AnswerImage ReadAnswerImage(const std::filesystem::path& path);

// At least one row, all of the same length; throws base::ConfigError otherwise, or where a pixel is
// outside [0, 1].
AnswerImage FromRows(const std::vector<std::vector<double>>& rows, const std::string& name);

// As ReadAnswerImage reads it, to the bit.
std::string ToCsv(std::span<const float> field, int width);

}  // namespace talus::trials
