#include "imaging/formats/images/profile_file.h"

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "imaging/formats/images/image_file.h"

namespace talus::imaging {
namespace {

struct Sidecar {
  Frame frame;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("frame", self.frame, {.required = true});
  }
};

std::filesystem::path SidecarOf(std::filesystem::path png) { return png.replace_extension("json"); }

}  // namespace

void WriteProfile(const std::filesystem::path& png, const Profile& profile) {
  WritePng(png, profile.image);
  base::WriteFileAtomically(
      SidecarOf(png), base::JsonText(base::ToJson(Sidecar{.frame = profile.frame}), 2) + "\n");
}

Frame ReadFrame(const std::filesystem::path& json) {
  return base::LoadOptions<Sidecar>(base::ReadJsonFile(json)).frame;
}

Profile ReadProfile(const std::filesystem::path& path) {
  const std::filesystem::path png = std::filesystem::is_directory(path) ? path / "aehp.png" : path;
  const std::filesystem::path json = SidecarOf(png);
  if (!std::filesystem::exists(json)) {
    if (std::filesystem::exists(path / "drum.json")) {
      throw base::ConfigError(
          path.string() +
          ": is a measured drum; spheres are compared with heaps only: give the "
          "folder of a measured heap");
    }
    throw base::ConfigError(json.string() + ": is missing, so that the frame of " + png.string() +
                            " is not known; give the folder that `talus measure … --out` wrote");
  }
  Profile profile{.image = ReadGrayImage(png), .frame = ReadFrame(json)};
  if (profile.image.width != profile.frame.width || profile.image.height != profile.frame.height) {
    throw base::ConfigError(png.string() + ": has " + std::to_string(profile.image.width) + " x " +
                            std::to_string(profile.image.height) + " px, " + json.string() +
                            " says otherwise; measure again");
  }
  return profile;
}

}  // namespace talus::imaging
