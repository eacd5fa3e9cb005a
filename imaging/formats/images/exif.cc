#include "imaging/formats/images/exif.h"

#include <chrono>
#include <cstddef>
#include <string>

#include "imaging/formats/images/orientation.h"

namespace talus::imaging {
namespace {

constexpr std::uint32_t kOrientationTag = 0x0112;
constexpr std::uint32_t kFurtherTags = 0x8769;  // the place of a directory with more of them
constexpr std::uint32_t kTimeTag = 0x9003;
constexpr std::uint32_t kColorSpaceTag = 0xA001;
constexpr std::uint32_t kSrgb = 1;
constexpr std::uint32_t kOtherSpace = 0xFFFF;  // Adobe RGB and Display P3, whose curves are near
constexpr std::uint32_t kShortType = 3;
constexpr std::size_t kEntrySize = 12;  // tag 2, type 2, count 4, value or its place 4 [bytes]

// Numbers of a TIFF structure, in its byte order; nothing behind its end.
class TiffBytes {
 public:
  explicit TiffBytes(std::string_view bytes)
      : bytes_(bytes), big_endian_(bytes.starts_with(std::string_view("MM\0*", 4))) {}

  bool valid() const { return big_endian_ || bytes_.starts_with(std::string_view("II*\0", 4)); }
  std::optional<std::uint32_t> Number(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || bytes_.size() - at < size) return std::nullopt;
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t byte = big_endian_ ? at + i : at + size - 1 - i;
      number = number << 8 | static_cast<std::uint8_t>(bytes_[byte]);
    }
    return number;
  }
  // Where the entry with the tag begins in the directory.
  std::optional<std::size_t> Entry(std::optional<std::uint32_t> directory,
                                   std::uint32_t tag) const {
    if (!valid() || !directory) return std::nullopt;
    const auto count = Number(*directory, 2);
    for (std::size_t i = 0; count && i < *count; ++i) {
      const std::size_t entry = *directory + 2 + i * kEntrySize;
      if (Number(entry, 2) == tag) return entry;
    }
    return std::nullopt;
  }
  std::optional<std::size_t> Entry(std::uint32_t tag) const { return Entry(Number(4, 4), tag); }
  std::optional<std::size_t> FurtherEntry(std::uint32_t tag) const {
    const auto further = Entry(kFurtherTags);
    return further ? Entry(Number(*further + 8, 4), tag) : std::nullopt;
  }

 private:
  std::string_view bytes_;
  bool big_endian_;
};

constexpr std::size_t kNumDigits = 14;

// The first 14 digits from `at` on, signs between them left out; fewer where something else stands.
std::string DigitsFrom(std::string_view text, std::size_t at) {
  std::string digits;
  for (; at < text.size() && digits.size() < kNumDigits; ++at) {
    if (text[at] >= '0' && text[at] <= '9') {
      digits += text[at];
    } else if (std::string_view(":-_. T").find(text[at]) == std::string_view::npos) {
      break;
    }
  }
  return digits;
}

std::optional<std::int64_t> TimeOf(const std::string& digits) {
  const auto number = [&](std::size_t at, std::size_t size) {
    return std::stoi(digits.substr(at, size));
  };
  const std::chrono::year_month_day day{std::chrono::year(number(0, 4)),
                                        std::chrono::month(static_cast<unsigned>(number(4, 2))),
                                        std::chrono::day(static_cast<unsigned>(number(6, 2)))};
  const int hour = number(8, 2);
  const int minute = number(10, 2);
  const int second = number(12, 2);
  const bool is_time = day.ok() && day.year() >= std::chrono::year(1990) &&
                       day.year() < std::chrono::year(2100) && hour < 24 && minute < 60 &&
                       second < 60;
  if (!is_time) return std::nullopt;
  const std::int64_t days = std::chrono::sys_days(day).time_since_epoch().count();
  return ((days * 24 + hour) * 60 + minute) * 60 + second;
}

}  // namespace

int ExifOrientation(std::string_view tiff) {
  const TiffBytes bytes(tiff);
  const auto entry = bytes.Entry(kOrientationTag);
  if (!entry) return kUpright;
  const auto value = bytes.Number(*entry + 8, 2);
  const bool known = bytes.Number(*entry + 2, 2) == kShortType && value >= 1U && value <= 8U;
  return known ? static_cast<int>(*value) : kUpright;
}

std::optional<std::int64_t> ExifTime(std::string_view tiff) {
  constexpr std::size_t kLength = 19;
  const TiffBytes bytes(tiff);
  const auto entry = bytes.FurtherEntry(kTimeTag);
  if (!entry) return std::nullopt;
  const auto place = bytes.Number(*entry + 8, 4);
  if (!place || *place > tiff.size()) return std::nullopt;
  return TimeIn(tiff.substr(*place, kLength));
}

bool ExifIsForDisplay(std::string_view tiff) {
  const TiffBytes bytes(tiff);
  const auto entry = bytes.FurtherEntry(kColorSpaceTag);
  if (!entry || bytes.Number(*entry + 2, 2) != kShortType) return false;
  const auto space = bytes.Number(*entry + 8, 2);
  return space == kSrgb || space == kOtherSpace;
}

std::optional<std::int64_t> TimeIn(std::string_view text) {
  for (std::size_t at = 0; at + kNumDigits <= text.size(); ++at) {
    if (text[at] < '0' || text[at] > '9') continue;
    const std::string digits = DigitsFrom(text, at);
    if (digits.size() < kNumDigits) continue;
    if (const auto time = TimeOf(digits)) return time;
  }
  return std::nullopt;
}

}  // namespace talus::imaging
