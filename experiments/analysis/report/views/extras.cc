#include "experiments/analysis/report/views/extras.h"

#include <algorithm>

#include "base/files/file.h"
#include "base/replaced.h"
#include "imaging/formats/images/image_file.h"

namespace talus::analysis {

void LeaveOut(const base::ConfigError& error, LeftOut& left_out) {
  const std::string line = base::Replaced(error.what(), "\n", "; ");
  if (std::ranges::find(left_out, line) == left_out.end()) left_out.push_back(line);
}

Picture ReadPicture(const std::filesystem::path& file, const std::string& name,
                    const std::string& title, LeftOut& left_out) {
  return ReadExtra(left_out, [&] {
    if (!std::filesystem::is_regular_file(file)) return Picture{};
    const std::string png = base::ReadFile(file);
    const imaging::GrayImage size = imaging::DecodeGrayImage(png, file.string());
    return Picture{.name = name,
                   .title = title,
                   .caption = {},
                   .width = size.width,
                   .height = size.height,
                   .png = png};
  });
}

}  // namespace talus::analysis
