#include "imaging/formats/images/image_file.h"
#include "imaging/formats/spheres/sphere_formats.h"
#include "imaging/photos/photo_set.h"
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

constexpr Target kTargets[] = {
    {"png", Image},      {"jpeg", Image},           {"tiff", Image}, {"bmp", Image},
    {"pgm", Image},      {"sphere_csv", SphereCsv}, {"dump", Dump},  {"vtk_legacy", VtkLegacy},
    {"vtk_xml", VtkXml}, {"pattern", Pattern}};

}  // namespace

std::span<const Target> ImagingTargets() { return kTargets; }

}  // namespace talus::fuzz
