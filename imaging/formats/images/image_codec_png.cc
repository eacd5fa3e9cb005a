#include <png.h>

#include <cstring>

#include "base/error.h"
#include "imaging/formats/images/exif.h"
#include "imaging/formats/images/image_codecs.h"
#include "imaging/formats/images/image_file.h"

namespace talus::imaging {
namespace {

// libpng reports an error by a call that must not return; throwing through it is what its manual
// allows C++ programs built with unwind tables, as on every platform we build for.
void OnError(png_structp png, png_const_charp message) {
  ThrowDamaged(*static_cast<const std::string*>(png_get_error_ptr(png)), message);
}
void OnWarning(png_structp, png_const_charp) {}

struct PngSource {
  std::string_view bytes;
  std::size_t position = 0;
};

void ReadBytes(png_structp png, png_bytep out, png_size_t count) {
  auto& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (source.bytes.size() - source.position < count) png_error(png, "ends early");
  std::memcpy(out, source.bytes.data() + source.position, count);
  source.position += count;
}

struct PngReader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  explicit PngReader(const std::string& name)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, const_cast<std::string*>(&name), OnError,
                                   OnWarning)),
        info(png_create_info_struct(png)) {}
  PngReader(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

// Palettes become RGB, packed grey becomes 8 bits, a transparent colour becomes alpha.
// Returns how often the rows are gone through.
int ReadHeader(PngReader& reader, PngSource& source, RawImage& image, const std::string& name) {
  png_set_read_fn(reader.png, &source, ReadBytes);
  png_read_info(reader.png, reader.info);
  CheckImageSize({.width = png_get_image_width(reader.png, reader.info),
                  .height = png_get_image_height(reader.png, reader.info),
                  .num_bytes = source.bytes.size()},
                 name);
  png_set_expand(reader.png);
  const int passes = png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  image.width = static_cast<int>(png_get_image_width(reader.png, reader.info));
  image.height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  image.channels = png_get_channels(reader.png, reader.info);
  image.bits = png_get_bit_depth(reader.png, reader.info);
  return passes;
}

void AddRow(std::span<const png_byte> bytes, std::vector<std::uint16_t>& samples, RawImage& image) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = image.bits == 8 ? bytes[i]
                                 : static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]);
  }
  image.AddRow(samples);
}

// An interlaced image is whole only after its last pass, so that it is held in memory.
std::vector<png_byte> ReadInterlaced(PngReader& reader, const RawImage& image, std::size_t stride,
                                     const std::string& name) {
  constexpr std::size_t kLargest = 400'000'000;  // [bytes]
  const auto height = static_cast<std::size_t>(image.height);
  if (stride * height > kLargest) {
    throw base::ConfigError(name +
                            ": is an interlaced PNG of more than 400 MB; save it without "
                            "interlacing");
  }
  std::vector<png_byte> data(stride * height);
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < height; ++y) rows.push_back(&data[y * stride]);
  png_read_image(reader.png, rows.data());
  return data;
}

// After the whole file is read: the chunk may follow the pixels.
void AddExif(PngReader& reader, RawImage& image) {
  png_uint_32 size = 0;
  png_bytep bytes = nullptr;
  if (png_get_eXIf_1(reader.png, reader.info, &size, &bytes) == 0) return;
  const std::string_view exif(reinterpret_cast<const char*>(bytes), size);
  image.orientation = ExifOrientation(exif);
  image.taken = ExifTime(exif);
  image.is_for_display = ExifIsForDisplay(exif);
}

void Append(png_structp png, png_bytep data, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(data), count);
}

std::string Encode(const std::uint8_t* pixels, int width, int height, int channels) {
  const std::string name = "a PNG in memory";
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, const_cast<std::string*>(&name),
                                            OnError, OnWarning);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, Append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8,
               channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  // Silhouettes and maps are like the row above. A fifth of the time of the library's own choice,
  // for files a third larger: the photographs of a campaign are drawn by the hundred.
  png_set_compression_level(png, 2);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
  png_write_info(png, info);
  const std::size_t stride = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  for (int y = 0; y < height; ++y) {
    png_write_row(png, pixels + static_cast<std::size_t>(y) * stride);
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace

RawImage DecodePng(std::string_view bytes, const std::string& name, double white) {
  RawImage image{.white = white};
  PngSource source{.bytes = bytes};
  PngReader reader(name);
  const int passes = ReadHeader(reader, source, image, name);
  const std::size_t stride = png_get_rowbytes(reader.png, reader.info);
  std::vector<std::uint16_t> samples(static_cast<std::size_t>(image.width) *
                                     static_cast<std::size_t>(image.channels));
  std::vector<png_byte> data =
      passes > 1 ? ReadInterlaced(reader, image, stride, name) : std::vector<png_byte>(stride);
  for (int y = 0; y < image.height; ++y) {
    if (passes == 1) png_read_row(reader.png, data.data(), nullptr);
    AddRow(std::span(data).subspan(passes > 1 ? static_cast<std::size_t>(y) * stride : 0, stride),
           samples, image);
  }
  png_read_end(reader.png, reader.info);
  AddExif(reader, image);
  return image;
}

std::string EncodePng(const GrayImage& image) {
  return Encode(image.pixels.data(), image.width, image.height, 1);
}

std::string EncodePng(const ColorImage& image) {
  return Encode(image.pixels.empty() ? nullptr : image.pixels[0].data(), image.width, image.height,
                3);
}

}  // namespace talus::imaging
