#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include "base/error.h"
#include "imaging/formats/images/image_codecs.h"

namespace talus::imaging {
namespace {

// A file in memory, as libtiff's callbacks want it.
struct TiffSource {
  std::string_view bytes;
  std::size_t position = 0;
};

tmsize_t Read(thandle_t handle, void* out, tmsize_t count) {
  auto& source = *static_cast<TiffSource*>(handle);
  const std::size_t left = source.bytes.size() - std::min(source.position, source.bytes.size());
  const std::size_t taken = std::min(left, static_cast<std::size_t>(count));
  std::memcpy(out, source.bytes.data() + source.position, taken);
  source.position += taken;
  return static_cast<tmsize_t>(taken);
}
tmsize_t Write(thandle_t, void*, tmsize_t) { return 0; }
toff_t Seek(thandle_t handle, toff_t offset, int whence) {
  auto& source = *static_cast<TiffSource*>(handle);
  const std::size_t from = whence == SEEK_SET   ? 0
                           : whence == SEEK_CUR ? source.position
                                                : source.bytes.size();
  return source.position = from + offset;
}
int Close(thandle_t) { return 0; }
toff_t FileSize(thandle_t handle) { return static_cast<TiffSource*>(handle)->bytes.size(); }
void OnWarning(const char*, const char*, std::va_list) {}

struct TiffLayout {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t bits = 1;
  std::uint16_t channels = 1;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  std::uint16_t planar = PLANARCONFIG_CONTIG;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::uint16_t orientation = ORIENTATION_TOPLEFT;  // numbered as in EXIF
};

TiffLayout ReadTiffLayout(TIFF* tiff, std::size_t num_bytes, const std::string& name) {
  TiffLayout layout;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &layout.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &layout.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &layout.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &layout.channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PHOTOMETRIC, &layout.photometric);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &layout.planar);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &layout.format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &layout.orientation);
  // We turn the image ourselves: libtiff mirrors, but does not turn by a quarter.
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  CheckImageSize({.width = layout.width, .height = layout.height, .num_bytes = num_bytes}, name);
  if (layout.bits > 16 || layout.format == SAMPLEFORMAT_IEEEFP) {
    throw base::ConfigError(name + ": is a TIFF of " + std::to_string(layout.bits) +
                            " bits a sample, as programs write it, not cameras; save it with 8 or "
                            "16 whole-number bits");
  }
  // Before libtiff takes memory for a row of them all.
  constexpr int kMostChannels = 16;
  if (layout.channels < 1 || layout.channels > kMostChannels) {
    ThrowDamaged(name, "it says that a pixel has " + std::to_string(layout.channels) + " channels");
  }
  return layout;
}

RawImage EmptyImage(const TiffLayout& layout, int channels, int bits) {
  RawImage image{.width = static_cast<int>(layout.width),
                 .height = static_cast<int>(layout.height),
                 .channels = channels,
                 .bits = bits,
                 .orientation = layout.orientation};
  return image;
}

// Which samples of a pixel count: the colours come first, its alpha among what follows.
struct CountedSamples {
  std::size_t num_colors = 1;
  std::optional<std::size_t> alpha{};  // which sample
  bool is_multiplied = false;          // whether the colours are, by alpha
  bool is_inverted = false;            // whether 0 is white

  int channels() const { return static_cast<int>(num_colors) + (alpha ? 1 : 0); }
};

// A sample of which the file does not say that it is alpha may be anything.
CountedSamples SamplesOf(TIFF* tiff, const TiffLayout& layout) {
  CountedSamples samples;
  if (layout.photometric == PHOTOMETRIC_RGB && layout.channels >= 3) samples.num_colors = 3;
  samples.is_inverted = layout.photometric == PHOTOMETRIC_MINISWHITE;
  std::uint16_t num_extra = 0;
  const std::uint16_t* kinds = nullptr;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &num_extra, &kinds);
  for (std::size_t i = 0; i < num_extra && samples.num_colors + i < layout.channels; ++i) {
    if (kinds[i] != EXTRASAMPLE_ASSOCALPHA && kinds[i] != EXTRASAMPLE_UNASSALPHA) continue;
    samples.alpha = samples.num_colors + i;
    samples.is_multiplied = kinds[i] == EXTRASAMPLE_ASSOCALPHA;
    break;
  }
  return samples;
}

// From a pixel as it is stored to one as RawImage has it. Levels count from `white` down where 0 is
// white; before white is known, as they are stored, since the largest tells how many bits they
// have.
void TakePixel(const CountedSamples& samples, double white, const std::uint16_t* from,
               std::uint16_t* to) {
  constexpr std::uint32_t kFull = 65535;
  const auto full = static_cast<std::uint32_t>(white);
  const std::uint32_t alpha = samples.alpha ? from[*samples.alpha] : kFull;
  for (std::size_t c = 0; c < samples.num_colors; ++c) {
    std::uint32_t level = from[c];
    if (samples.is_multiplied && alpha > 0) level = std::min(kFull, level * kFull / alpha);
    if (samples.is_inverted && full > 0) level = full - std::min(full, level);
    to[c] = static_cast<std::uint16_t>(level);
  }
  if (samples.alpha) to[samples.num_colors] = static_cast<std::uint16_t>(alpha);
}

// 16-bit rows in strips, which libtiff's ready-made conversion would cut to 8 bits.
RawImage ReadDeep(TIFF* tiff, const TiffLayout& layout, const std::string& name, double white) {
  const CountedSamples samples = SamplesOf(tiff, layout);
  RawImage image = EmptyImage(layout, samples.channels(), 16);
  image.white = white;
  const auto num_counted = static_cast<std::size_t>(samples.channels());
  std::vector<std::uint16_t> stored(static_cast<std::size_t>(layout.width) * layout.channels);
  std::vector<std::uint16_t> row(layout.width * num_counted);
  for (std::uint32_t y = 0; y < layout.height; ++y) {
    if (TIFFReadScanline(tiff, stored.data(), y) != 1) ThrowDamaged(name, "row cannot be decoded");
    for (std::size_t x = 0; x < layout.width; ++x) {
      TakePixel(samples, white, &stored[x * layout.channels], &row[x * num_counted]);
    }
    image.AddRow(row);
  }
  return image;
}

// Everything else through libtiff's own conversion to RGBA (palettes, tiles, 1-bit, CMYK, YCbCr),
// whose colours are multiplied by alpha already; it takes a sample of unknown kind for alpha.
// Before white, as other formats.
RawImage ReadConverted(TIFF* tiff, const TiffLayout& layout, const std::string& name) {
  const bool has_alpha = SamplesOf(tiff, layout).alpha.has_value();
  RawImage image = EmptyImage(layout, 3, 8);
  std::vector<std::uint32_t> raster(static_cast<std::size_t>(layout.width) * layout.height);
  if (TIFFReadRGBAImageOriented(tiff, layout.width, layout.height, raster.data(),
                                ORIENTATION_TOPLEFT, 1) != 1) {
    ThrowDamaged(name, "cannot be decoded");
  }
  for (const std::uint32_t pixel : raster) {
    std::uint16_t samples[3];
    int channel = 0;
    for (const std::uint32_t sample : {TIFFGetR(pixel), TIFFGetG(pixel), TIFFGetB(pixel)}) {
      const std::uint32_t behind = has_alpha ? 255 - TIFFGetA(pixel) : 0;
      samples[channel++] = static_cast<std::uint16_t>(sample + behind);
    }
    image.AddRow(samples);
  }
  return image;
}

}  // namespace

RawImage DecodeTiff(std::string_view bytes, const std::string& name, double white) {
  TIFFSetErrorHandler(OnWarning);  // the exception says it
  TIFFSetWarningHandler(OnWarning);
  TiffSource source{.bytes = bytes};
  const std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(
      TIFFClientOpen(name.c_str(), "rm", &source, Read, Write, Seek, Close, FileSize, nullptr,
                     nullptr),
      TIFFClose);
  if (!tiff) ThrowDamaged(name, "not a readable TIFF");
  const TiffLayout layout = ReadTiffLayout(tiff.get(), bytes.size(), name);
  const bool deep = layout.bits == 16 && layout.channels <= 4 &&
                    layout.planar == PLANARCONFIG_CONTIG && layout.format == SAMPLEFORMAT_UINT &&
                    layout.photometric <= PHOTOMETRIC_RGB && !TIFFIsTiled(tiff.get());
  return deep ? ReadDeep(tiff.get(), layout, name, white) : ReadConverted(tiff.get(), layout, name);
}

}  // namespace talus::imaging
