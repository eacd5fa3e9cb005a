#include "imaging/heap/film_strip.h"

namespace talus::imaging {

Frame StripOf(const Frame& picture, int num_pictures) {
  Frame strip = picture;
  if (num_pictures == 1) return strip;
  strip.width *= num_pictures;
  strip.pictures = num_pictures;
  return strip;
}

Frame OnePicture(const Frame& strip) {
  Frame picture = strip;
  picture.width = strip.picture_width();
  picture.pictures.reset();
  return picture;
}

GrayImage SideBySide(std::span<const GrayImage> pictures) {
  const GrayImage& first = pictures.front();
  GrayImage strip{.width = first.width * static_cast<int>(pictures.size()),
                  .height = first.height,
                  .pixels = {}};
  strip.pixels.reserve(first.pixels.size() * pictures.size());
  for (int y = 0; y < first.height; ++y) {
    for (const GrayImage& picture : pictures) {
      for (int x = 0; x < first.width; ++x) strip.pixels.push_back(picture.at(x, y));
    }
  }
  return strip;
}

Profile PictureOf(const Profile& strip, int index) {
  Profile picture{.image = {}, .frame = OnePicture(strip.frame)};
  picture.image = {.width = picture.frame.width, .height = picture.frame.height, .pixels = {}};
  const int left = index * picture.frame.width;
  for (int y = 0; y < picture.frame.height; ++y) {
    for (int x = 0; x < picture.frame.width; ++x) {
      picture.image.pixels.push_back(strip.image.at(left + x, y));
    }
  }
  return picture;
}

}  // namespace talus::imaging
