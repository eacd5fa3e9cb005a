#include "imaging/formats/images/gif_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace talus::imaging {
namespace {

constexpr int kColorBits = 8;  // of a palette's index
constexpr std::size_t kColors = 1u << kColorBits;
constexpr int kMostCodeBits = 12;

void AddShort(int value, std::string& bytes) {
  bytes += static_cast<char>(value & 0xff);
  bytes += static_cast<char>((value >> 8) & 0xff);
}

// The colours that most pixels have, and each colour's place among them.
class Palette {
 public:
  explicit Palette(std::span<const ColorImage> frames) {
    std::map<Color, std::int64_t> counts;
    for (const ColorImage& frame : frames) {
      for (const Color& color : frame.pixels) ++counts[color];
    }
    std::vector<std::pair<std::int64_t, Color>> order;
    for (const auto& [color, count] : counts) order.emplace_back(-count, color);
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < std::min(order.size(), kColors); ++i) {
      colors_.push_back(order[i].second);
    }
    for (const auto& [color, count] : counts) index_[color] = Nearest(color);
  }

  std::uint8_t IndexOf(const Color& color) const { return index_.at(color); }

  std::string Bytes() const {
    std::string bytes;
    for (std::size_t i = 0; i < kColors; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        bytes += static_cast<char>(i < colors_.size() ? colors_[i][k] : 0);
      }
    }
    return bytes;
  }

 private:
  std::uint8_t Nearest(const Color& color) const {
    int least = std::numeric_limits<int>::max();
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      int distance = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        distance += (color[k] - colors_[i][k]) * (color[k] - colors_[i][k]);
      }
      if (distance >= least) continue;
      least = distance;
      nearest = i;
    }
    return static_cast<std::uint8_t>(nearest);
  }

  std::vector<Color> colors_;
  std::map<Color, std::uint8_t> index_;
};

// Codes of growing width, the lowest bit first, in blocks of at most 255 bytes.
class CodeWriter {
 public:
  void Add(int code, int width) {
    bits_ |= static_cast<std::uint32_t>(code) << num_bits_;
    num_bits_ += width;
    while (num_bits_ >= 8) TakeByte();
  }
  std::string Blocks() {
    if (num_bits_ > 0) TakeByte();
    std::string blocks;
    constexpr std::size_t kBlock = 255;
    for (std::size_t i = 0; i < bytes_.size(); i += kBlock) {
      const std::string_view part = std::string_view(bytes_).substr(i, kBlock);
      blocks += static_cast<char>(part.size());
      blocks += part;
    }
    return blocks + '\0';
  }

 private:
  void TakeByte() {
    bytes_ += static_cast<char>(bits_ & 0xff);
    bits_ >>= 8;
    num_bits_ = std::max(0, num_bits_ - 8);
  }

  std::string bytes_;
  std::uint32_t bits_ = 0;
  int num_bits_ = 0;
};

std::string Compressed(const std::vector<std::uint8_t>& pixels) {
  constexpr int kClear = 1 << kColorBits;
  constexpr int kEnd = kClear + 1;
  std::unordered_map<int, int> codes;  // of a known string and the pixel after it
  int next = kEnd + 1;
  int width = kColorBits + 1;
  CodeWriter writer;
  writer.Add(kClear, width);
  int known = pixels.front();
  for (std::size_t i = 1; i < pixels.size(); ++i) {
    const int longer = (known << kColorBits) | pixels[i];
    if (const auto found = codes.find(longer); found != codes.end()) {
      known = found->second;
      continue;
    }
    writer.Add(known, width);
    known = pixels[i];
    if (next == 1 << kMostCodeBits) {  // the table is full
      writer.Add(kClear, width);
      codes.clear();
      next = kEnd + 1;
      width = kColorBits + 1;
      continue;
    }
    if (next == 1 << width) ++width;  // the reader is one entry behind
    codes[longer] = next++;
  }
  writer.Add(known, width);
  writer.Add(kEnd, width);
  return writer.Blocks();
}

std::string GifFrame(const ColorImage& image, const Palette& palette, int hundredths) {
  std::string bytes("\x21\xf9\x04\x00", 4);  // graphic control: no transparency
  AddShort(hundredths, bytes);
  bytes += std::string("\x00\x00\x2c", 3);  // … its end, and the image's separator
  for (const int value : {0, 0, image.width, image.height}) AddShort(value, bytes);
  bytes += '\0';  // no palette of its own
  bytes += static_cast<char>(kColorBits);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(image.pixels.size());
  for (const Color& color : image.pixels) pixels.push_back(palette.IndexOf(color));
  return bytes + Compressed(pixels);
}

}  // namespace

std::string EncodeGif(std::span<const ColorImage> frames, double frame_time) {
  const Palette palette(frames);
  const int hundredths = std::max(2, static_cast<int>(std::lround(100 * frame_time)));
  std::string bytes = "GIF89a";
  AddShort(frames.front().width, bytes);
  AddShort(frames.front().height, bytes);
  bytes += std::string("\xf7\x00\x00", 3);  // a palette of 256 colours of 8 bits
  bytes += palette.Bytes();
  bytes += std::string("\x21\xff\x0bNETSCAPE2.0\x03\x01\x00\x00\x00", 19);  // for ever
  for (const ColorImage& frame : frames) bytes += GifFrame(frame, palette, hundredths);
  return bytes + '\x3b';
}

}  // namespace talus::imaging
