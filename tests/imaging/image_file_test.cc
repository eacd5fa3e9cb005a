#include "imaging/formats/images/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>
#include <tiffio.h>
#include <zlib.h>
// clang-format off
#include <cstdio>  // jpeglib.h needs it first
#include <jpeglib.h>
// clang-format on

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "imaging/formats/images/orientation.h"

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

std::string EncodeJpeg(const GrayImage& image, const std::string& app1 = {}) {
  jpeg_compress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &buffer, &size);
  jpeg.image_width = static_cast<JDIMENSION>(image.width);
  jpeg.image_height = static_cast<JDIMENSION>(image.height);
  jpeg.input_components = 1;
  jpeg.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 95, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  if (!app1.empty()) {
    jpeg_write_marker(&jpeg, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(app1.data()),
                      static_cast<unsigned>(app1.size()));
  }
  for (int y = 0; y < image.height; ++y) {
    JSAMPLE* row = const_cast<JSAMPLE*>(&image.pixels[static_cast<std::size_t>(image.width * y)]);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  const std::string bytes(reinterpret_cast<char*>(buffer), size);
  std::free(buffer);
  return bytes;
}

// Quality 95 leaves a few grey levels of error on a smooth ramp.
TEST(ImageFile, Jpeg) {
  const GrayImage ramp = Ramp();
  const std::string bytes = EncodeJpeg(ramp);
  const GrayImage image = DecodeGrayImage(bytes, "ramp.jpg");
  ASSERT_EQ(image.pixels.size(), ramp.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_NEAR(image.pixels[i], ramp.pixels[i], 4);
  }
  EXPECT_THROW(DecodeGrayImage(bytes.substr(0, bytes.size() / 2), "half.jpg"), base::ConfigError);
}

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

// A TIFF structure with one other tag before the orientation.
std::string Exif(int orientation, bool big_endian) {
  const auto number = [&](std::uint32_t value, int size) {
    std::string text;
    for (int i = 0; i < size; ++i) {
      const int shift = 8 * (big_endian ? size - 1 - i : i);
      text += static_cast<char>(value >> shift & 255);
    }
    return text;
  };
  return (big_endian ? "MM" : "II") + number(42, 2) + number(8, 4) + number(2, 2) +
         number(0x0100, 2) + number(4, 2) + number(1, 4) + number(640, 4) + number(0x0112, 2) +
         number(3, 2) + number(1, 4) + number(static_cast<std::uint32_t>(orientation), 2) +
         number(0, 2) + number(0, 4);
}

// The JPEG's smooth ramp comes back within a few grey levels; a wrong turn is off by up to 255.
TEST(ImageFile, JpegIsTurnedUprightAsExifSays) {
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

TEST(ImageFile, DamagedExifLeavesTheImageAsItIs) {
  const std::string whole = Exif(6, true);
  for (std::size_t size = 0; size + 6 < whole.size(); ++size) {
    EXPECT_EQ(ExifOrientation(whole.substr(0, size)), kUpright) << size;
  }
  EXPECT_EQ(ExifOrientation(Exif(0, true)), kUpright);
  EXPECT_EQ(ExifOrientation(Exif(9, false)), kUpright);
}

// With a chunk eXIf after the header, as libpng writes it.
TEST(ImageFile, PngIsTurnedUprightAsExifSays) {
  for (const Orientation& orientation : kOrientations) {
    const GrayImage stored = Stored(Ramp(), orientation);
    std::string exif = Exif(orientation.tag, true);
    std::string bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    const auto append = [](png_structp p, png_bytep data, png_size_t count) {
      static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), count);
    };
    png_set_write_fn(png, &bytes, append, nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(stored.width),
                 static_cast<png_uint_32>(stored.height), 8, PNG_COLOR_TYPE_GRAY,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_eXIf_1(png, info, static_cast<png_uint_32>(exif.size()),
                   reinterpret_cast<png_bytep>(exif.data()));
    png_write_info(png, info);
    for (int y = 0; y < stored.height; ++y) {
      png_write_row(png, &stored.pixels[static_cast<std::size_t>(y * stored.width)]);
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    EXPECT_EQ(DecodeGrayImage(bytes, "held.png"), Ramp()) << orientation.tag;
  }
}

struct TiffImage {
  GrayImage stored;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  int orientation = 1;
};

template <class Sample>
void WriteTiff(const std::filesystem::path& path, Sample scale, const TiffImage& image) {
  const auto& [ramp, photometric, orientation] = image;
  const auto width = static_cast<std::uint32_t>(ramp.width);
  TIFF* const tiff = TIFFOpen(path.c_str(), "w");
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, ramp.width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, ramp.height);
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, orientation);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8 * sizeof(Sample));
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, photometric);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 5);
  for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(ramp.height); ++y) {
    std::vector<Sample> row;
    for (std::uint32_t x = 0; x < width; ++x) {
      const auto level = static_cast<Sample>(ramp.pixels[width * y + x] * scale);
      row.push_back(photometric == PHOTOMETRIC_MINISWHITE ? static_cast<Sample>(~level) : level);
    }
    TIFFWriteScanline(tiff, row.data(), y);
  }
  TIFFClose(tiff);
}

TEST(ImageFile, TiffOfEightAndSixteenBitsBothWaysRound) {
  for (const std::uint16_t photometric : {PHOTOMETRIC_MINISBLACK, PHOTOMETRIC_MINISWHITE}) {
    const TiffImage ramp{.stored = Ramp(), .photometric = photometric};
    WriteTiff<std::uint8_t>(TempFile("ramp8.tif"), 1, ramp);
    EXPECT_EQ(ReadGrayImage(TempFile("ramp8.tif")), Ramp());
    WriteTiff<std::uint16_t>(TempFile("ramp16.tif"), 257, ramp);
    EXPECT_EQ(ReadGrayImage(TempFile("ramp16.tif")), Ramp());
  }
  const std::string bytes = base::ReadFile(TempFile("ramp16.tif"));
  EXPECT_THROW(DecodeGrayImage(bytes.substr(0, 300), "half.tif"), base::ConfigError);
}

// 8 bits go through libtiff's own conversion, which must not turn a second time; 16 bits do not.
TEST(ImageFile, TiffIsTurnedUprightAsItsTagSays) {
  for (const Orientation& orientation : kOrientations) {
    const TiffImage held{.stored = Stored(Ramp(), orientation), .orientation = orientation.tag};
    WriteTiff<std::uint8_t>(TempFile("held8.tif"), 1, held);
    EXPECT_EQ(ReadGrayImage(TempFile("held8.tif")), Ramp()) << orientation.tag;
    WriteTiff<std::uint16_t>(TempFile("held16.tif"), 257, held);
    EXPECT_EQ(ReadGrayImage(TempFile("held16.tif")), Ramp()) << orientation.tag;
  }
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

// Of the memory that this process has ever used.
long PeakMegabytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

void PutBigEndian(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (24 - 8 * i));
}

// 33 bytes of header took 1.5 GB.
TEST(ImageFile, HeaderThatPromisesMoreThanTheFileHoldsTakesNoMemory) {
  std::string png = EncodePng(Ramp());
  PutBigEndian(png, 16, 20000);
  PutBigEndian(png, 20, 10000);
  PutBigEndian(
      png, 29,
      static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(&png[12]), 17)));
  std::string bmp = Bmp();
  for (const std::size_t at : {18, 22}) bmp.replace(at, 4, std::string("\x10\x27\0\0", 4));
  const long before = PeakMegabytes();
  for (const std::string& bytes : {png, bmp}) {
    try {
      DecodeGrayImage(bytes, "big");
      ADD_FAILURE();
    } catch (const base::ConfigError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("do not fit into its"));
    }
  }
  EXPECT_LT(PeakMegabytes() - before, 50);
}

// Adam7, in memory as a whole: the other way of reading a PNG.
TEST(ImageFile, InterlacedPngIsReadAsAnyOther) {
  const GrayImage ramp = Ramp();
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, png_size_t count) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), count);
      },
      nullptr);
  png_set_IHDR(png, info, 37, 21, 8, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_ADAM7,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  png_set_interlace_handling(png);
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < 21; ++y) rows.push_back(const_cast<png_bytep>(&ramp.pixels[37 * y]));
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  EXPECT_EQ(DecodeGrayImage(bytes, "adam7"), ramp);
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
