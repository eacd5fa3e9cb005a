#include "imaging/formats/images/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "imaging/formats/images/photograph_file.h"
#include "tests/imaging/stored_images.h"
#include "tests/peak_memory.h"

namespace talus::imaging {
namespace image_file_test {

TEST(ImageFile, PngComesBackUnchanged) {
  WritePng(TempFile("ramp.png"), Ramp());
  EXPECT_EQ(ReadGrayImage(TempFile("ramp.png")), Ramp());
}

// Red, green and blue, and their luma: 0.299, 0.587 and 0.114 of 255 (Rec. 601).
const ColorImage kPrimaries{
    .width = 3, .height = 1, .pixels = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}};
const std::vector<std::uint8_t> kLuma{76, 150, 29};

// Grey as red = green = blue has the same luma, up to the rounding of its three weights.
TEST(ImageFile, ColourBecomesLuma) {
  EXPECT_EQ(DecodeGrayImage(EncodePng(ToColor(Ramp())), "ramp"), Ramp());
  EXPECT_EQ(DecodeGrayImage(EncodePng(kPrimaries), "colours").pixels, kLuma);
}

std::string PngOf(png_image image, const void* samples, const void* palette = nullptr) {
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, samples, 0, palette);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, samples, 0, palette);
  return bytes;
}

// 16 bits a sample; all samples of a pixel alike but for alpha, which is full.
std::string DeepPng(int shift, png_uint_32 format = PNG_FORMAT_LINEAR_Y) {
  std::vector<std::uint16_t> samples;
  for (const std::uint8_t level : Ramp().pixels) {
    const int sample = shift == 8 ? level * 257 : level << shift;
    samples.insert(samples.end(), (format & PNG_FORMAT_FLAG_COLOR) != 0 ? 3 : 1,
                   static_cast<std::uint16_t>(sample));
    if ((format & PNG_FORMAT_FLAG_ALPHA) != 0) samples.push_back(65535);
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 37;
  image.height = 21;
  image.format = format;
  return PngOf(image, samples.data());
}

TEST(ImageFile, SixteenBitsBecomeEight) { EXPECT_EQ(DecodeGrayImage(DeepPng(8), "deep"), Ramp()); }

// A camera's 12 bits in 16: the brightest pixel is 4080 of 4095, not of 65535.
TEST(ImageFile, TwelveBitsInSixteenAreRecognised) {
  const GrayImage image = DecodeGrayImage(DeepPng(4), "camera");
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_NEAR(image.pixels[i], Ramp().pixels[i], 1);
  }
}

// Alpha, 65535 everywhere, was taken for white, and a picture of 10 bits for black.
TEST(ImageFile, AlphaDoesNotHideHowManyBitsTheCameraHas) {
  for (const png_uint_32 format :
       {PNG_FORMAT_LINEAR_RGB_ALPHA, PNG_FORMAT_LINEAR_Y | PNG_FORMAT_FLAG_ALPHA}) {
    for (const int shift : {2, 4, 8}) {
      const GrayImage image = DecodeGrayImage(DeepPng(shift, format), "camera");
      ASSERT_EQ(image.pixels.size(), Ramp().pixels.size());
      for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        EXPECT_NEAR(image.pixels[i], Ramp().pixels[i], 1) << shift;
      }
    }
  }
}

// Programs store pictures of few colours so: two bits a pixel here, each an entry of the palette.
TEST(ImageFile, PngWithAPalette) {
  const std::vector<png_byte> palette{255, 0, 0, 0, 255, 0, 0, 0, 255};
  const std::vector<png_byte> entries{2, 0, 1};
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 3;
  image.height = 1;
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.colormap_entries = 3;
  const std::string bytes = PngOf(image, entries.data(), palette.data());
  ASSERT_EQ(bytes[24], 2) << "bits a pixel";
  EXPECT_THAT(DecodeGrayImage(bytes, "palette.png").pixels,
              ::testing::ElementsAre(kLuma[2], kLuma[0], kLuma[1]));
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

// A telephone's. Nothing is lost but the rounding of the three components.
TEST(ImageFile, JpegInColour) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Color& color = kPrimaries.pixels[i];
    const GrayImage image = DecodeGrayImage(EncodeFlatJpeg(color), "colour.jpg");
    ASSERT_EQ(image.pixels.size(), 256u);
    for (const std::uint8_t level : image.pixels) EXPECT_NEAR(level, kLuma[i], 2) << i;
  }
}

// It was called damaged, to be copied from the camera again.
TEST(ImageFile, AJpegForPrintIsToBeSavedAsAnotherKind) {
  try {
    DecodeGrayImage(EncodeJpeg(Ramp(), "", 4), "print.jpg");
    FAIL() << "a CMYK image was read";
  } catch (const base::ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "print.jpg: is a CMYK image, which is made for print; save it as RGB or grey");
  }
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

// As a program writes the mean of photographs. It was called damaged.
TEST(ImageFile, ATiffOfThirtyTwoBitsIsToBeSavedWithFewer) {
  WriteTiff<std::uint32_t>(TempFile("mean.tif"), 16843009, {.stored = Ramp()});
  try {
    ReadGrayImage(TempFile("mean.tif"));
    FAIL() << "32 bits were read";
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("mean.tif: is a TIFF of 32 bits a sample"));
  }
}

// One pixel; of `samples` one beyond the colours is of the kind `extra`.
template <class Sample>
std::string WriteTiffPixel(std::vector<Sample> samples, std::uint16_t photometric,
                           std::optional<std::uint16_t> extra) {
  const std::string file = TempFile("pixel.tif");
  TIFF* const tiff = TIFFOpen(file.c_str(), "w");
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 1);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(samples.size()));
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(Sample)));
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, photometric);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  if (extra) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &*extra);
  EXPECT_EQ(TIFFWriteScanline(tiff, samples.data(), 0), 1);
  TIFFClose(tiff);
  return file;
}

TEST(ImageFile, TiffInColour) {
  for (std::size_t i = 0; i < kLuma.size(); ++i) {
    const auto& [red, green, blue] = kPrimaries.pixels[i];
    const auto grey = [](const std::string& file) { return ReadGrayImage(file).pixels[0]; };
    EXPECT_NEAR(grey(WriteTiffPixel<std::uint8_t>({red, green, blue}, PHOTOMETRIC_RGB, {})),
                kLuma[i], 1);
    const auto deep = [](std::uint8_t level) { return static_cast<std::uint16_t>(257 * level); };
    EXPECT_NEAR(grey(WriteTiffPixel<std::uint16_t>({deep(red), deep(green), deep(blue)},
                                                   PHOTOMETRIC_RGB, {})),
                kLuma[i], 1);
  }
}

// A red of 200 that lets half of what is behind it through, before white: as in any other format.
TEST(ImageFile, TransparentTiffIsSeenBeforeWhite) {
  const std::string file =
      WriteTiffPixel<std::uint8_t>({200, 0, 0, 128}, PHOTOMETRIC_RGB, EXTRASAMPLE_UNASSALPHA);
  // 0.299 × 200 × 128/255 + 127; the conversion rounds to whole levels.
  EXPECT_NEAR(ReadGrayImage(file).pixels[0], 157, 1);
}

// Some programs save 8 bits so: it was called black everywhere.
TEST(ImageFile, EightBitsInSixteenAreReadAsTheyAre) {
  const auto path = WriteTiffPixel<std::uint16_t>({200}, PHOTOMETRIC_MINISBLACK, {});
  EXPECT_EQ(ReadGrayImage(path).pixels[0], 200);
}

// The same red in 16 bits, the colours as they are or multiplied by alpha; what is not said to be
// alpha was taken for it, and what is multiplied was multiplied again.
TEST(ImageFile, SixteenBitTiffSaysWhatIsItsAlpha) {
  const auto level = [](int red, std::uint16_t extra) {
    const auto sample = [](int of_255) { return static_cast<std::uint16_t>(257 * of_255); };
    return ReadGrayImage(WriteTiffPixel<std::uint16_t>({sample(red), 0, 0, sample(128)},
                                                       PHOTOMETRIC_RGB, extra))
        .pixels[0];
  };
  EXPECT_NEAR(level(200, EXTRASAMPLE_UNASSALPHA), 157, 1);
  EXPECT_NEAR(level(100, EXTRASAMPLE_ASSOCALPHA), 157, 1);  // 200 × 128/255
  EXPECT_NEAR(level(200, EXTRASAMPLE_UNSPECIFIED), 60, 1);  // 0.299 × 200
  // White is 0: that is not so of alpha.
  EXPECT_NEAR(ReadGrayImage(WriteTiffPixel<std::uint16_t>(
                                {200 * 257, 65535}, PHOTOMETRIC_MINISWHITE, EXTRASAMPLE_UNASSALPHA))
                  .pixels[0],
              55, 1);
}

TEST(ImageFile, EightBitTiffSaysWhatIsItsAlpha) {
  EXPECT_NEAR(ReadGrayImage(WriteTiffPixel<std::uint8_t>({200, 0, 0, 128}, PHOTOMETRIC_RGB,
                                                         EXTRASAMPLE_UNSPECIFIED))
                  .pixels[0],
              60, 1);  // 0.299 × 200
}

// A camera's 12 bits, 0 white and 4095 black: inverted in 16 bits all of them were nearly white.
TEST(ImageFile, TwelveBitsAreRecognisedWhereZeroIsWhite) {
  EXPECT_NEAR(
      ReadGrayImage(WriteTiffPixel<std::uint16_t>({4000}, PHOTOMETRIC_MINISWHITE, {})).pixels[0],
      255.0 * 95 / 4095, 1);
}

// 24 bits, rows padded to four bytes, as Windows writes them: the bottom row first, or the top one
// where the height is negative.
std::string Bmp(const ColorImage& image = ToColor(Ramp()), bool is_top_down = false) {
  const auto number = [](std::uint32_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 255);
    return text;
  };
  const auto width = static_cast<std::uint32_t>(image.width);
  const auto height = static_cast<std::uint32_t>(image.height);
  const std::uint32_t stride = (width * 3 + 3) / 4 * 4;
  std::string bytes = "BM" + number(54 + stride * height, 4) + number(0, 4) + number(54, 4) +
                      number(40, 4) + number(width, 4) +
                      number(is_top_down ? ~height + 1 : height, 4) + number(1, 2) + number(24, 2) +
                      number(0, 4) + number(stride * height, 4) + std::string(16, '\0');
  for (std::uint32_t row = 0; row < height; ++row) {
    const std::size_t y = is_top_down ? row : height - 1 - row;
    for (std::uint32_t x = 0; x < width; ++x) {
      const Color& color = image.pixels[y * width + x];
      bytes.append(color.rbegin(), color.rend());  // blue first
    }
    bytes += std::string(stride - width * 3, '\0');
  }
  return bytes;
}

TEST(ImageFile, Bmp) {
  EXPECT_EQ(DecodeGrayImage(Bmp(), "ramp.bmp"), Ramp());
  EXPECT_EQ(DecodeGrayImage(Bmp(ToColor(Ramp()), true), "top_down.bmp"), Ramp());
  EXPECT_EQ(DecodeGrayImage(Bmp(kPrimaries), "colours.bmp").pixels, kLuma);
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
  // A dark picture of 10 bits was taken for one of fewer.
  EXPECT_EQ(DecodeGrayImage("P2 2 1 1023 60 0", "dark.pgm").pixels[0], 15);
}

void PutBigEndian(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (24 - 8 * i));
}

// 16-bit RGBA, all white: 32 MB of samples in a file a thousandth as large.
std::string DeepWhite(png_uint_32 side) {
  const std::vector<png_byte> row(std::size_t{8} * side, 255);
  return CompressPng({.width = side, .height = side, .bits = 16, .color_type = PNG_COLOR_TYPE_RGBA},
                     [&](png_uint_32) { return row.data(); });
}

// It took 8 bytes a pixel for the samples and more for their growth: 200 Mpx in 1.6 MB took 1.9 GB.
TEST(ImageFile, SixteenBitsTakeNoMoreMemoryThanEight) {
  const std::string png = DeepWhite(2000);
  const long before = PeakMegabytes();
  const GrayImage image = DecodeGrayImage(png, "deep");
  EXPECT_EQ(image.pixels.size(), 4'000'000u);
  EXPECT_EQ(image.pixels[3'654'321], 255);
  EXPECT_LT(PeakMegabytes() - before, 15);
}

TEST(ImageFile, SquaresOfPixelsBecomeTheirMean) {
  const GrayImage image{.width = 5, .height = 2, .pixels = {0, 10, 20, 20, 99, 30, 41, 20, 21, 99}};
  const GrayImage small = Reduced(image, 2);
  EXPECT_EQ(small.width, 2);  // the fifth column is left over
  EXPECT_EQ(small.pixels, (std::vector<std::uint8_t>{20, 20}));
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

// 134 bytes made libtiff ask for 6.7 GB for a row of 65280 channels.
TEST(ImageFile, TiffOfTooManyChannelsIsRefusedBeforeItsRowsTakeMemory) {
  const std::string bytes =
      base::ReadFile(TALUS_SOURCE_DIR "/tests/fuzz/corpus/tiff/many_channels.tif");
  try {
    DecodeGrayImage(bytes, "wide");
    ADD_FAILURE();
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("a pixel has 65280 channels"));
  }
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

}  // namespace image_file_test
}  // namespace talus::imaging
