// Photographs are turned upright, and their levels made light, as their files say.
#include <gtest/gtest.h>

#include "base/files/file.h"
#include "imaging/formats/images/exif.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/formats/images/orientation.h"
#include "imaging/formats/images/photograph_file.h"
#include "tests/imaging/stored_images.h"

namespace talus::imaging {
namespace image_orientation_test {

// Where the stored row 0 and column 0 are in the upright image, as the EXIF standard lists them.
struct Orientation {
  int tag;
  const char* row_0;
  const char* column_0;
};
constexpr Orientation kOrientations[] = {
    {1, "top", "left"}, {2, "top", "right"}, {3, "bottom", "right"}, {4, "bottom", "left"},
    {5, "left", "top"}, {6, "right", "top"}, {7, "right", "bottom"}, {8, "left", "bottom"},
};

// What the sensor of a camera held so has stored of an upright image.
GrayImage Stored(const GrayImage& upright, const Orientation& orientation) {
  const bool turned = orientation.tag >= 5;
  GrayImage stored{.width = turned ? upright.height : upright.width,
                   .height = turned ? upright.width : upright.height,
                   .pixels = {}};
  int x = 0;
  int y = 0;
  const auto go = [&](std::string_view from, int index) {
    if (from == "left") x = index;
    if (from == "right") x = upright.width - 1 - index;
    if (from == "top") y = index;
    if (from == "bottom") y = upright.height - 1 - index;
  };
  for (int row = 0; row < stored.height; ++row) {
    for (int column = 0; column < stored.width; ++column) {
      go(orientation.row_0, row);
      go(orientation.column_0, column);
      stored.pixels.push_back(upright.at(x, y));
    }
  }
  return stored;
}

std::string Number(std::uint32_t value, int size, bool big_endian) {
  std::string text;
  for (int i = 0; i < size; ++i) {
    const int shift = 8 * (big_endian ? size - 1 - i : i);
    text += static_cast<char>(value >> shift & 255);
  }
  return text;
}

// A TIFF structure with one other tag before the orientation.
std::string Exif(int orientation, bool big_endian) {
  const auto number = [&](std::uint32_t value, int size) {
    return Number(value, size, big_endian);
  };
  return (big_endian ? "MM" : "II") + number(42, 2) + number(8, 4) + number(2, 2) +
         number(0x0100, 2) + number(4, 2) + number(1, 4) + number(640, 4) + number(0x0112, 2) +
         number(3, 2) + number(1, 4) + number(static_cast<std::uint32_t>(orientation), 2) +
         number(0, 2) + number(0, 4);
}

// The JPEG's smooth ramp comes back within a few grey levels; a wrong turn is off by up to 255.
TEST(ImageOrientation, JpegIsTurnedUprightAsExifSays) {
  for (const Orientation& orientation : kOrientations) {
    for (const bool big_endian : {false, true}) {
      const std::string app1 = std::string("Exif\0\0", 6) + Exif(orientation.tag, big_endian);
      const GrayImage image =
          DecodeGrayImage(EncodeJpeg(Stored(Ramp(), orientation), app1), "held.jpg");
      ASSERT_EQ(image.width, 37) << orientation.tag;
      for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        ASSERT_NEAR(image.pixels[i], Ramp().pixels[i], 6) << orientation.tag;
      }
    }
  }
}

TEST(ImageOrientation, DamagedExifLeavesTheImageAsItIs) {
  const std::string whole = Exif(6, true);
  for (std::size_t size = 0; size + 6 < whole.size(); ++size) {
    EXPECT_EQ(ExifOrientation(whole.substr(0, size)), kUpright) << size;
  }
  EXPECT_EQ(ExifOrientation(Exif(0, true)), kUpright);
  EXPECT_EQ(ExifOrientation(Exif(9, false)), kUpright);
}

// A structure whose only tag is the place of a second directory, and that one's a tag of its own.
std::string ExifWith(std::uint32_t tag, std::uint32_t type, std::uint32_t count,
                     std::uint32_t value, bool big_endian) {
  const auto number = [&](std::uint32_t n, int size) { return Number(n, size, big_endian); };
  return (big_endian ? "MM" : "II") + number(42, 2) + number(8, 4) +
         // The first directory, whose end is the second one's place.
         number(1, 2) + number(0x8769, 2) + number(4, 2) + number(1, 4) + number(26, 4) +
         number(0, 4) +
         // The second.
         number(1, 2) + number(tag, 2) + number(type, 2) + number(count, 4) + number(value, 4) +
         number(0, 4);
}

std::string ExifWithTime(bool big_endian) {
  return ExifWith(0x9003, 2, 20, 44, big_endian) + "2026:01:31 17:05:09";
}

// A number of 16 bits stands at the left of its four bytes.
std::string ExifWithSpace(std::uint32_t space, bool big_endian) {
  return ExifWith(0xA001, 3, 1, big_endian ? space << 16 : space, big_endian);
}

TEST(ImageOrientation, TimeOfExposureIsReadAndADamagedOneIsNotKnown) {
  for (const bool big_endian : {false, true}) {
    const std::string exif = ExifWithTime(big_endian);
    EXPECT_EQ(ExifTime(exif), 1769879109);  // as `date -u -d "2026-01-31 17:05:09" +%s` says
    for (std::size_t size = 0; size < exif.size(); ++size) {
      EXPECT_EQ(ExifTime(exif.substr(0, size)), std::nullopt) << size;
    }
  }
  EXPECT_EQ(ExifTime(Exif(6, true)), std::nullopt);
}

TEST(ImageOrientation, AColourSpaceOfDisplaysIsTold) {
  for (const bool big_endian : {false, true}) {
    for (const std::uint32_t space : {1U, 0xFFFFU}) {
      const std::string exif = ExifWithSpace(space, big_endian);
      EXPECT_TRUE(ExifIsForDisplay(exif));
      for (std::size_t size = 0; size + 6 < exif.size(); ++size) {
        EXPECT_FALSE(ExifIsForDisplay(exif.substr(0, size))) << size;
      }
    }
    EXPECT_FALSE(ExifIsForDisplay(ExifWithSpace(2, big_endian)));
    EXPECT_FALSE(ExifIsForDisplay(ExifWithTime(big_endian)));
  }
  EXPECT_FALSE(ExifIsForDisplay(Exif(6, true)));
}

std::string PngWith(const std::string& exif, const GrayImage& stored) {
  return CompressPng(
      {.width = static_cast<png_uint_32>(stored.width),
       .height = static_cast<png_uint_32>(stored.height),
       .exif = exif},
      [&](png_uint_32 y) { return &stored.pixels[y * static_cast<std::size_t>(stored.width)]; });
}

TEST(ImageOrientation, PngIsTurnedUprightAsExifSays) {
  for (const Orientation& orientation : kOrientations) {
    const std::string bytes = PngWith(Exif(orientation.tag, true), Stored(Ramp(), orientation));
    EXPECT_EQ(DecodeGrayImage(bytes, "held.png"), Ramp()) << orientation.tag;
  }
}

TEST(ImageOrientation, APhotographKnowsWhenItWasTaken) {
  const std::string exif = ExifWithTime(true);
  base::WriteFileAtomically(TempFile("taken.png"), PngWith(exif, Ramp()));
  base::WriteFileAtomically(TempFile("taken.jpg"),
                            EncodeJpeg(Ramp(), std::string("Exif\0\0", 6) + exif));
  base::WriteFileAtomically(TempFile("undated.jpg"), EncodeJpeg(Ramp()));
  EXPECT_EQ(ReadPhotograph(TempFile("taken.png")).taken, 1769879109);
  EXPECT_EQ(ReadPhotograph(TempFile("taken.jpg")).taken, 1769879109);
  EXPECT_EQ(ReadPhotograph(TempFile("undated.jpg")).taken, std::nullopt);
}

// The curve of sRGB has 188 where half of the light is. A map of coverage has no light in it.
TEST(ImageOrientation, LevelsForADisplayBecomeLight) {
  const GrayImage levels{.width = 4, .height = 1, .pixels = {0, 99, 188, 255}};
  base::WriteFileAtomically(TempFile("camera.png"), PngWith(ExifWithSpace(1, true), levels));
  base::WriteFileAtomically(TempFile("plain.png"), PngWith(ExifWithTime(true), levels));
  const std::vector<std::uint8_t> light{0, 32, 128, 255};
  EXPECT_EQ(ReadPhotograph(TempFile("camera.png")).image.pixels, light);
  EXPECT_EQ(ReadPhotograph(TempFile("plain.png")).image, levels);
  EXPECT_EQ(ReadGrayImage(TempFile("camera.png")), levels);
  // A dim one keeps its white: 0.0452 of full light, of which 20 has 0.155.
  const GrayImage dim{.width = 3, .height = 1, .pixels = {0, 20, 60}};
  base::WriteFileAtomically(TempFile("dim.png"), PngWith(ExifWithSpace(1, true), dim));
  const std::vector<std::uint8_t> as_bright{0, 9, 60};
  EXPECT_EQ(ReadPhotograph(TempFile("dim.png")).image.pixels, as_bright);
}

// 8 bits go through libtiff's own conversion, which must not turn a second time; 16 bits do not.
TEST(ImageOrientation, TiffIsTurnedUprightAsItsTagSays) {
  for (const Orientation& orientation : kOrientations) {
    const TiffImage held{.stored = Stored(Ramp(), orientation), .orientation = orientation.tag};
    WriteTiff<std::uint8_t>(TempFile("held8.tif"), 1, held);
    EXPECT_EQ(ReadGrayImage(TempFile("held8.tif")), Ramp()) << orientation.tag;
    WriteTiff<std::uint16_t>(TempFile("held16.tif"), 257, held);
    EXPECT_EQ(ReadGrayImage(TempFile("held16.tif")), Ramp()) << orientation.tag;
  }
}

}  // namespace image_orientation_test
}  // namespace talus::imaging
