// What a camera writes beside the picture: how it was held, when, and whether it has a tone curve.
//
// All read a TIFF structure, as APP1 of a JPEG and eXIf of a PNG hold one. A photograph is not
// lost to a damaged description: what cannot be read is not known.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace talus::imaging {

// Tag 0x0112, 1 to 8 (orientation.h); kUpright where there is none.
int ExifOrientation(std::string_view tiff);

// When the shutter opened (tag 0x9003), by the camera's clock [s]: for differences only.
std::optional<std::int64_t> ExifTime(std::string_view tiff);

// Whether its levels are coded for a display (tag 0xA001, sRGB or another such space), as a
// camera's JPEG are, and not in proportion to the light.
bool ExifIsForDisplay(std::string_view tiff);

// A date and a time in 14 digits, with or without signs between them, as EXIF and the names of
// telephones have it, "2026:01:31 17:05:09" or "IMG_20260131_170509": seconds since 1970.
std::optional<std::int64_t> TimeIn(std::string_view text);

}  // namespace talus::imaging
