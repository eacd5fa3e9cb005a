#include "imaging/formats/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <tiffio.h>
// clang-format off
#include <cstdio>  // jpeglib.h needs it first
#include <jpeglib.h>
// clang-format on

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file.h"

namespace talus::imaging {
namespace {

// A slanted ramp: no row or column equals another, so that a wrong stride or order shows.
GrayImage Ramp() {
  GrayImage image{.width = 37, .height = 21, .pixels = {}};
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 37; ++x) image.pixels.push_back(static_cast<std::uint8_t>(5 * x + 3 * y));
  }
  return image;
}

std::filesystem::path TempFile(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

TEST(ImageFile, PngComesBackUnchanged) {
  WritePng(TempFile("ramp.png"), Ramp());
  EXPECT_EQ(ReadGrayImage(TempFile("ramp.png")), Ramp());
}

// Grey as red = green = blue has the same luma, up to the rounding of its three weights.
TEST(ImageFile, ColourBecomesLuma) {
  EXPECT_EQ(DecodeGrayImage(EncodePng(ToColor(Ramp())), "ramp"), Ramp());
  ColorImage red{.width = 1, .height = 1, .pixels = {{255, 0, 0}}};
  EXPECT_EQ(DecodeGrayImage(EncodePng(red), "red").pixels[0], 76);  // 0.299 × 255
}

std::string DeepPng(int shift) {
  const GrayImage ramp = Ramp();
  std::vector<std::uint16_t> samples;
  for (const std::uint8_t level : ramp.pixels) {
    samples.push_back(static_cast<std::uint16_t>(shift == 8 ? level * 257 : level << shift));
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 37;
  image.height = 21;
  image.format = PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, samples.data(), 0, nullptr);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, samples.data(), 0, nullptr);
  return bytes;
}

TEST(ImageFile, SixteenBitsBecomeEight) { EXPECT_EQ(DecodeGrayImage(DeepPng(8), "deep"), Ramp()); }

// A camera's 12 bits in 16: the brightest pixel is 4080 of 4095, not of 65535.
TEST(ImageFile, TwelveBitsInSixteenAreRecognised) {
  const GrayImage image = DecodeGrayImage(DeepPng(4), "camera");
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_NEAR(image.pixels[i], Ramp().pixels[i], 1);
  }
}

// Quality 95 leaves a few grey levels of error on a smooth ramp.
TEST(ImageFile, Jpeg) {
  const GrayImage ramp = Ramp();
  jpeg_compress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &buffer, &size);
  jpeg.image_width = 37;
  jpeg.image_height = 21;
  jpeg.input_components = 1;
  jpeg.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 95, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  for (int y = 0; y < 21; ++y) {
    JSAMPLE* row = const_cast<JSAMPLE*>(&ramp.pixels[static_cast<std::size_t>(37 * y)]);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  const std::string bytes(reinterpret_cast<char*>(buffer), size);
  std::free(buffer);
  const GrayImage image = DecodeGrayImage(bytes, "ramp.jpg");
  ASSERT_EQ(image.pixels.size(), ramp.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_NEAR(image.pixels[i], ramp.pixels[i], 4);
  }
  EXPECT_THROW(DecodeGrayImage(bytes.substr(0, bytes.size() / 2), "half.jpg"), base::ConfigError);
}

template <class Sample>
void WriteTiff(const std::filesystem::path& path, Sample scale, std::uint16_t photometric) {
  const GrayImage ramp = Ramp();
  TIFF* const tiff = TIFFOpen(path.c_str(), "w");
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 37);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 21);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8 * sizeof(Sample));
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, photometric);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 5);
  for (std::uint32_t y = 0; y < 21; ++y) {
    std::vector<Sample> row;
    for (std::uint32_t x = 0; x < 37; ++x) {
      const auto level = static_cast<Sample>(ramp.pixels[37 * y + x] * scale);
      row.push_back(photometric == PHOTOMETRIC_MINISWHITE ? static_cast<Sample>(~level) : level);
    }
    TIFFWriteScanline(tiff, row.data(), y);
  }
  TIFFClose(tiff);
}

TEST(ImageFile, TiffOfEightAndSixteenBitsBothWaysRound) {
  for (const std::uint16_t photometric : {PHOTOMETRIC_MINISBLACK, PHOTOMETRIC_MINISWHITE}) {
    WriteTiff<std::uint8_t>(TempFile("ramp8.tif"), 1, photometric);
    EXPECT_EQ(ReadGrayImage(TempFile("ramp8.tif")), Ramp());
    WriteTiff<std::uint16_t>(TempFile("ramp16.tif"), 257, photometric);
    EXPECT_EQ(ReadGrayImage(TempFile("ramp16.tif")), Ramp());
  }
  const std::string bytes = base::ReadFile(TempFile("ramp16.tif"));
  EXPECT_THROW(DecodeGrayImage(bytes.substr(0, 300), "half.tif"), base::ConfigError);
}

// 24 bits, bottom row first, rows padded to four bytes, as Windows writes them.
std::string Bmp() {
  const GrayImage ramp = Ramp();
  const auto number = [](std::uint32_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 255);
    return text;
  };
  constexpr std::uint32_t kStride = (37 * 3 + 3) / 4 * 4;
  std::string bytes = "BM" + number(54 + kStride * 21, 4) + number(0, 4) + number(54, 4) +
                      number(40, 4) + number(37, 4) + number(21, 4) + number(1, 2) + number(24, 2) +
                      number(0, 4) + number(kStride * 21, 4) + std::string(16, '\0');
  for (int y = 20; y >= 0; --y) {
    for (int x = 0; x < 37; ++x) bytes += std::string(3, static_cast<char>(ramp.at(x, y)));
    bytes += std::string(kStride - 37 * 3, '\0');
  }
  return bytes;
}

TEST(ImageFile, Bmp) {
  EXPECT_EQ(DecodeGrayImage(Bmp(), "ramp.bmp"), Ramp());
  EXPECT_THROW(DecodeGrayImage(Bmp().substr(0, 500), "half.bmp"), base::ConfigError);
}

// White is 255, 65535 or any number between, in bytes, big-endian pairs or text with comments.
std::string Pgm(bool is_text, int white) {
  const GrayImage ramp = Ramp();
  std::string bytes =
      (is_text ? "P2\n# by hand\n37 21\n" : "P5 37 21 ") + std::to_string(white) + "\n";
  for (const std::uint8_t level : ramp.pixels) {
    const int sample = (level * white + 127) / 255;
    if (is_text) {
      bytes += std::to_string(sample) + " ";
    } else {
      if (white > 255) bytes += static_cast<char>(sample >> 8);
      bytes += static_cast<char>(sample & 255);
    }
  }
  return bytes;
}

TEST(ImageFile, PgmOfEveryWhite) {
  for (const bool is_text : {false, true}) {
    for (const int white : {255, 1023, 65535}) {
      EXPECT_EQ(DecodeGrayImage(Pgm(is_text, white), "ramp.pgm"), Ramp()) << is_text << white;
    }
  }
  EXPECT_THROW(DecodeGrayImage(Pgm(false, 255).substr(0, 500), "half.pgm"), base::ConfigError);
  EXPECT_THROW(DecodeGrayImage("P2 1 1 9 10", "bright.pgm"), base::ConfigError);
}

// Cut anywhere, or with any one byte turned over, a file is an image or an error that names it;
// with the sanitizers this also shows reads beyond the end.
TEST(ImageFile, DamagedFilesAreImagesOrErrors) {
  const std::string png = EncodePng(Ramp());
  for (const std::string& good : {png, Bmp(), Pgm(false, 255), Pgm(true, 1023)}) {
    for (std::size_t at = 0; at < good.size(); at += 7) {
      std::string turned = good;
      turned[at] = static_cast<char>(~turned[at]);
      for (const std::string& bytes : {good.substr(0, at), turned}) {
        try {
          const GrayImage image = DecodeGrayImage(bytes, "damaged");
          EXPECT_FALSE(image.pixels.empty());
        } catch (const base::ConfigError& error) {
          EXPECT_THAT(error.what(), testing::StartsWith("damaged: "));
        }
      }
    }
  }
}

}  // namespace
}  // namespace talus::imaging
