#include <cmath>
#include <cstring>

#include "imaging/formats/images/image_file.h"
#include "imaging/formats/spheres/sphere_formats.h"
#include "imaging/heap/metrics.h"
#include "imaging/photos/photo_set.h"
#include "imaging/spheres/projection.h"
#include "tests/fuzz/targets.h"

namespace talus::fuzz {
namespace {

using imaging::DecodeGrayImage;

void Image(std::string_view bytes) {
  Expect([&] { DecodeGrayImage(bytes, "image"); });
}
void SphereCsv(std::string_view bytes) {
  Expect([&] { imaging::ReadSphereCsv(bytes, "spheres.csv", {}); });
}
void Dump(std::string_view bytes) {
  Expect([&] { imaging::ReadDump(bytes, "heap.dump", {}); });
}
void VtkLegacy(std::string_view bytes) {
  Expect([&] { imaging::SpheresOf(imaging::ReadVtkLegacy(bytes, "heap.vtk"), "heap.vtk", 1); });
}
void VtkXml(std::string_view bytes) {
  Expect([&] { imaging::SpheresOf(imaging::ReadVtkXml(bytes, "heap.vtp").cloud, "heap.vtp", 1); });
}
// A frame and spheres as a program hands them over: width and height, then numbers as they are.
void Projection(std::string_view bytes) {
  constexpr std::size_t kHead = 2 + 4 * sizeof(double);
  if (bytes.size() < kHead) return;
  double head[4];
  std::memcpy(head, bytes.data() + 2, sizeof(head));
  const imaging::Frame frame{.width = static_cast<unsigned char>(bytes[0]),
                             .height = static_cast<unsigned char>(bytes[1]),
                             .pixel_size = head[0],
                             .center_x = head[1],
                             .baseline = head[2],
                             .plate_diameter = head[3]};
  std::vector<base::Sphere> spheres;
  double row[4];
  for (std::size_t at = kHead; at + sizeof(row) <= bytes.size(); at += sizeof(row)) {
    std::memcpy(row, bytes.data() + at, sizeof(row));
    if (!std::isfinite(row[0] + row[1] + row[2]) || !(row[3] > 0 && std::isfinite(row[3]))) return;
    spheres.push_back({.position = {row[0], row[1], row[2]}, .radius = row[3]});
  }
  Expect([&] {
    const imaging::Profile heap = imaging::ProjectHeap(spheres, frame, 3);
    const std::size_t half = spheres.size() / 2;
    const imaging::Profile other = imaging::ProjectHeap(std::span(spheres).first(half), frame, 3);
    imaging::CompareProfiles({.profile = heap, .parts = {}}, {.profile = other, .parts = {}});
  });
}

// The first line is the pattern, the others are names.
void Pattern(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  std::vector<std::filesystem::path> names;
  for (std::size_t at = end; at < bytes.size() && names.size() < 20;) {
    const std::size_t next = std::min(bytes.find('\n', at + 1), bytes.size());
    names.emplace_back(
        std::string(bytes.substr(at + 1, std::min<std::size_t>(next - at - 1, 255))));
    at = next;
  }
  Expect([&] { imaging::SortPhotos(names, std::string(bytes.substr(0, end))); });
}

constexpr Target kTargets[] = {{"png", Image},
                               {"jpeg", Image},
                               {"tiff", Image},
                               {"bmp", Image},
                               {"pgm", Image},
                               {"sphere_csv", SphereCsv},
                               {"dump", Dump},
                               {"vtk_legacy", VtkLegacy},
                               {"vtk_xml", VtkXml},
                               {"pattern", Pattern},
                               {"projection", Projection}};

}  // namespace

std::span<const Target> ImagingTargets() { return kTargets; }

}  // namespace talus::fuzz
