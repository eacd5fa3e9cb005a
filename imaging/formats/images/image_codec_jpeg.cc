// clang-format off
#include <cstdio>  // jpeglib.h needs it first
#include <jpeglib.h>
// clang-format on

#include "base/error.h"
#include "imaging/formats/images/exif.h"
#include "imaging/formats/images/image_codecs.h"

namespace talus::imaging {
namespace {

// Throwing out of libjpeg is safe: it is built with unwind tables, and the destructor below frees
// what it holds.
void OnError(j_common_ptr jpeg) {
  char message[JMSG_LENGTH_MAX];
  jpeg->err->format_message(jpeg, message);
  ThrowDamaged(*static_cast<const std::string*>(jpeg->client_data), message);
}

// A corrupt or truncated file is only a warning to libjpeg, which fills in grey: an error here.
void OnMessage(j_common_ptr jpeg, int level) {
  if (level < 0) OnError(jpeg);
}

struct JpegReader {
  jpeg_error_mgr errors;
  jpeg_decompress_struct jpeg;
  explicit JpegReader(const std::string& name) {
    jpeg.err = jpeg_std_error(&errors);
    errors.error_exit = OnError;
    errors.emit_message = OnMessage;
    jpeg_create_decompress(&jpeg);
    jpeg.client_data = const_cast<std::string*>(&name);
  }
  JpegReader(const JpegReader&) = delete;
  ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
};

// The first APP1 segment that holds EXIF, behind its name; empty where none does.
std::string_view ExifOf(const jpeg_decompress_struct& jpeg) {
  constexpr std::string_view kExif("Exif\0\0", 6);
  for (const jpeg_marker_struct* marker = jpeg.marker_list; marker; marker = marker->next) {
    const std::string_view data(reinterpret_cast<const char*>(marker->data), marker->data_length);
    if (data.starts_with(kExif)) return data.substr(kExif.size());
  }
  return {};
}

}  // namespace

RawImage DecodeJpeg(std::string_view bytes, const std::string& name) {
  JpegReader reader(name);
  jpeg_decompress_struct& jpeg = reader.jpeg;
  jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  constexpr unsigned kWholeSegment = 0xffff;
  jpeg_save_markers(&jpeg, JPEG_APP0 + 1, kWholeSegment);
  jpeg_read_header(&jpeg, TRUE);
  CheckImageSize(
      {.width = jpeg.image_width, .height = jpeg.image_height, .num_bytes = bytes.size()}, name);
  if (jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK) {
    throw base::ConfigError(name +
                            ": is a CMYK image, which is made for print; save it as RGB or grey");
  }
  jpeg.out_color_space = JCS_GRAYSCALE;  // the luma channel as the camera stored it
  jpeg_start_decompress(&jpeg);
  RawImage image{.width = static_cast<int>(jpeg.output_width),
                 .height = static_cast<int>(jpeg.output_height),
                 .channels = 1,
                 .bits = 8,
                 .orientation = ExifOrientation(ExifOf(jpeg)),
                 .taken = ExifTime(ExifOf(jpeg)),
                 .is_for_display = ExifIsForDisplay(ExifOf(jpeg))};
  image.Reserve();
  std::vector<JSAMPLE> row(jpeg.output_width);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPLE* rows[] = {row.data()};
    jpeg_read_scanlines(&jpeg, rows, 1);
    image.gray.insert(image.gray.end(), row.begin(), row.end());  // luma already
  }
  jpeg_finish_decompress(&jpeg);
  return image;
}

}  // namespace talus::imaging
