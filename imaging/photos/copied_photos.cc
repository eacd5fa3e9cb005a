#include "imaging/photos/copied_photos.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>

#include "base/files/file.h"

namespace talus::imaging {
namespace {

namespace fs = std::filesystem;

struct RunPhoto {
  fs::path path;
  std::size_t run = 0;
};

// Those that could be copies, by the size of their files: photographs hardly ever share one.
std::map<std::uintmax_t, std::vector<RunPhoto>> BySize(const std::vector<MeasuredRun>& runs) {
  std::map<std::uintmax_t, std::vector<RunPhoto>> photos;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (const MeasuredView& view : runs[r].views) {
      std::error_code error;
      const std::uintmax_t size = fs::file_size(view.photo, error);
      if (!error) photos[size].push_back({view.photo, r});
    }
  }
  return photos;
}

}  // namespace

std::vector<PhotoWarning> WarningsOfCopies(const std::vector<MeasuredRun>& runs) {
  std::vector<PhotoWarning> warnings;
  for (const auto& [size, photos] : BySize(runs)) {
    if (photos.front().run == photos.back().run) continue;
    std::map<std::uint64_t, RunPhoto> first;  // by the checksum of the file
    for (const RunPhoto& photo : photos) {
      const std::uint64_t checksum = base::Checksum(base::ReadFile(photo.path));
      const auto [same, is_new] = first.emplace(checksum, photo);
      if (is_new || same->second.run == photo.run) continue;
      warnings.push_back({.doubt = PhotoDoubt::kCopied,
                          .photo = photo.path,
                          .reason = same->second.path.string()});
    }
  }
  return warnings;
}

}  // namespace talus::imaging
