// Images that the tests of readers write, as other programs store them.
#pragma once

#include <tiffio.h>
// clang-format off
#include <cstdio>  // jpeglib.h needs it first
#include <jpeglib.h>
// clang-format on

#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "imaging/formats/images/image_file.h"

namespace talus::imaging {

// A slanted ramp: no row or column equals another, so that a wrong stride or order shows.
inline GrayImage Ramp() {
  GrayImage image{.width = 37, .height = 21, .pixels = {}};
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 37; ++x) image.pixels.push_back(static_cast<std::uint8_t>(5 * x + 3 * y));
  }
  return image;
}

inline std::filesystem::path TempFile(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

struct JpegKind {
  int components = 1;
  J_COLOR_SPACE space = JCS_GRAYSCALE;
  int quality = 95;
  std::string app1{};  // EXIF; none where empty
};

// `rows` of width × components samples each; RGB is stored as cameras do, with its colour at half
// the resolution.
inline std::string CompressJpeg(std::vector<std::vector<JSAMPLE>> rows, const JpegKind& kind) {
  jpeg_compress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &buffer, &size);
  jpeg.image_width =
      static_cast<JDIMENSION>(rows[0].size() / static_cast<std::size_t>(kind.components));
  jpeg.image_height = static_cast<JDIMENSION>(rows.size());
  jpeg.input_components = kind.components;
  jpeg.in_color_space = kind.space;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, kind.quality, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  if (!kind.app1.empty()) {
    jpeg_write_marker(&jpeg, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(kind.app1.data()),
                      static_cast<unsigned>(kind.app1.size()));
  }
  for (std::vector<JSAMPLE>& samples : rows) {
    JSAMPLE* row = samples.data();
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  const std::string bytes(reinterpret_cast<char*>(buffer), size);
  std::free(buffer);
  return bytes;
}

// `num_inks` 1 grey, 4 CMYK, all inks alike.
inline std::string EncodeJpeg(const GrayImage& image, const std::string& app1 = {},
                              int num_inks = 1) {
  std::vector<std::vector<JSAMPLE>> rows(static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    std::vector<JSAMPLE>& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < image.width; ++x) {
      row.insert(row.end(), static_cast<std::size_t>(num_inks), image.at(x, y));
    }
  }
  return CompressJpeg(
      std::move(rows),
      {.components = num_inks, .space = num_inks == 1 ? JCS_GRAYSCALE : JCS_CMYK, .app1 = app1});
}

// 16 × 16 px of one colour.
inline std::string EncodeFlatJpeg(const Color& color) {
  std::vector<JSAMPLE> row;
  for (int x = 0; x < 16; ++x) row.insert(row.end(), color.begin(), color.end());
  return CompressJpeg(std::vector(16, row), {.components = 3, .space = JCS_RGB, .quality = 100});
}

struct PngKind {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int bits = 8;
  int color_type = PNG_COLOR_TYPE_GRAY;
  std::string exif{};  // a chunk eXIf after the header, as libpng writes it; none where empty
};

// `row` gives the bytes of each row from the top. Compressed little, which is fast.
inline std::string CompressPng(PngKind kind,
                               const std::function<const png_byte*(png_uint_32)>& row) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  const auto append = [](png_structp writer, png_bytep data, png_size_t count) {
    static_cast<std::string*>(png_get_io_ptr(writer))->append(reinterpret_cast<char*>(data), count);
  };
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, kind.width, kind.height, kind.bits, kind.color_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 1);
  if (!kind.exif.empty()) {
    png_set_eXIf_1(png, info, static_cast<png_uint_32>(kind.exif.size()),
                   reinterpret_cast<png_bytep>(kind.exif.data()));
  }
  png_write_info(png, info);
  for (png_uint_32 y = 0; y < kind.height; ++y) png_write_row(png, row(y));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
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

}  // namespace talus::imaging
