#include "imaging/formats/images/gif_file.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <vector>

#include "base/random.h"

namespace talus::imaging {
namespace gif_file_test {

std::uint8_t At(const std::string& bytes, std::size_t i) {
  return static_cast<std::uint8_t>(bytes.at(i));
}

// What a viewer makes of it: the frames in their palette's colours, by the format's own rules.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes), at_(13 + 3 * 256) {}

  std::vector<ColorImage> Frames() {
    std::vector<ColorImage> frames;
    while (At(bytes_, at_) != 0x3b) {
      if (At(bytes_, at_) == 0x21) {
        at_ += 2;
        Blocks();
      } else {
        frames.push_back(Frame());
      }
    }
    return frames;
  }

 private:
  std::string Blocks() {
    std::string data;
    while (const std::size_t length = At(bytes_, at_++)) {
      data += bytes_.substr(at_, length);
      at_ += length;
    }
    return data;
  }

  ColorImage Frame() {
    const int width = At(bytes_, at_ + 5) + 256 * At(bytes_, at_ + 6);
    const int height = At(bytes_, at_ + 7) + 256 * At(bytes_, at_ + 8);
    at_ += 10;
    const int bits = At(bytes_, at_++);
    ColorImage image{.width = width, .height = height, .pixels = {}};
    for (const std::uint8_t index : Decompressed(Blocks(), bits)) {
      const std::size_t entry = 13 + 3 * std::size_t{index};
      image.pixels.push_back({At(bytes_, entry), At(bytes_, entry + 1), At(bytes_, entry + 2)});
    }
    return image;
  }

  static std::vector<std::uint8_t> Decompressed(const std::string& data, int bits) {
    const int clear = 1 << bits;
    std::vector<std::vector<std::uint8_t>> table;
    std::vector<std::uint8_t> pixels, before;
    int width = bits + 1;
    std::size_t bit = 0;
    const auto next = [&] {
      int code = 0;
      for (int i = 0; i < width; ++i, ++bit) code |= (At(data, bit / 8) >> (bit % 8) & 1) << i;
      return code;
    };
    const auto reset = [&] {
      table.clear();
      for (int i = 0; i < clear; ++i) table.push_back({static_cast<std::uint8_t>(i)});
      table.resize(static_cast<std::size_t>(clear) + 2);
      width = bits + 1;
      before.clear();
    };
    for (int code = next(); code != clear + 1; code = next()) {
      if (code == clear) {
        reset();
        continue;
      }
      std::vector<std::uint8_t> now;
      if (static_cast<std::size_t>(code) < table.size()) {
        now = table[static_cast<std::size_t>(code)];
      } else {
        now = before;
        now.push_back(before.front());
      }
      if (!before.empty() && table.size() < 4096) {
        before.push_back(now.front());
        table.push_back(before);
        if (table.size() == std::size_t{1} << width && width < 12) ++width;
      }
      pixels.insert(pixels.end(), now.begin(), now.end());
      before = now;
    }
    return pixels;
  }

  const std::string& bytes_;
  std::size_t at_;
};

ColorImage Noise(std::uint64_t seed, int num_colors) {
  ColorImage image{.width = 151, .height = 97, .pixels = {}};
  base::Random random(seed, base::Stream("noise of a film"));
  for (int i = 0; i < image.width * image.height; ++i) {
    const auto level = static_cast<std::uint8_t>(random.Below(static_cast<unsigned>(num_colors)));
    image.pixels.push_back({level, static_cast<std::uint8_t>(255 - level), 7});
  }
  return image;
}

// Noise of all colours fills the table of codes many times over; flat frames make the longest
// codes.
TEST(Gif, IsReadBackPixelForPixel) {
  ColorImage flat = Noise(1, 1);
  const std::vector<ColorImage> frames{Noise(2, 256), flat, Noise(3, 3)};
  const std::string bytes = EncodeGif(frames, 0.05);
  EXPECT_EQ(bytes.substr(0, 6), "GIF89a");
  // It begins again for ever, and each frame stands for 5 hundredths of a second.
  EXPECT_NE(bytes.find(std::string("NETSCAPE2.0\3\1\0\0\0", 16)), std::string::npos);
  const std::size_t control = bytes.find("\x21\xf9\4");
  ASSERT_NE(control, std::string::npos);
  EXPECT_EQ(At(bytes, control + 4) + 256 * At(bytes, control + 5), 5);
  const std::vector<ColorImage> read = Reader(bytes).Frames();
  ASSERT_EQ(read.size(), frames.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].width, 151);
    EXPECT_TRUE(read[i].pixels == frames[i].pixels) << "frame " << i;
  }
}

// 300 shades do not fit into a palette: the rarest become their neighbours.
TEST(Gif, MoreColoursThanAPaletteBecomeTheNearest) {
  ColorImage image{.width = 300, .height = 2, .pixels = {}};
  for (int i = 0; i < 600; ++i) {
    const int x = i % 300;
    image.pixels.push_back({static_cast<std::uint8_t>(std::min(x, 255)), 0,
                            static_cast<std::uint8_t>(std::max(0, x - 255))});
  }
  const std::string bytes = EncodeGif(std::vector<ColorImage>{image}, 0.05);
  const ColorImage read = Reader(bytes).Frames().at(0);
  for (std::size_t i = 0; i < read.pixels.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(read.pixels[i][k], image.pixels[i][k], 44);  // the 44 that do not fit, at most
    }
  }
}

}  // namespace gif_file_test
}  // namespace talus::imaging
