#include "experiments/trials/simulate/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/text/lower.h"
#include "base/text/number_text.h"
#include "imaging/drawing/canvas.h"
#include "imaging/formats/images/gif_file.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/spheres/render.h"

namespace talus::trials {
namespace {

constexpr double kMostHeight = 4.0 / 3;           // of a frame, in its widths
constexpr double kLength = 9.6;                   // of the whole film [s]
constexpr std::size_t kMostSpheres = 20'000'000;  // kept until the film is drawn: 640 MB
constexpr imaging::Color kTube{120, 150, 175};

// A comment before the end of the file: a film may be written over, no other picture.
constexpr std::string_view kFilmMark("\x21\xfe\x0atalus film\x00", 14);

bool IsOwnGif(const std::filesystem::path& file) {
  const std::string tail = base::ReadTail(file, kFilmMark.size() + 1);
  return tail.starts_with(kFilmMark) && tail.ends_with('\x3b');
}

// Where a point of the scene is in the picture of a camera in front.
imaging::CanvasPoint At(const imaging::Camera& camera, const base::Vec3& p) {
  const double up = p.z * std::cos(camera.elevation) + p.y * std::sin(camera.elevation);
  return {.x = camera.center_x + p.x / camera.pixel_size,
          .y = camera.baseline - up / camera.pixel_size};
}

// The two rims of an upright tube and its outermost lines: what is inside stays seen.
void DrawTube(const engine::OpenCylinder& tube, const imaging::Camera& camera,
              imaging::ColorImage& image) {
  constexpr int kSides = 48;
  for (const double share : {0.0, 1.0}) {
    const base::Vec3 center = tube.base + share * tube.length * tube.axis;
    std::vector<imaging::CanvasPoint> rim;
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      rim.push_back(At(camera, center + base::Vec3{tube.radius * std::cos(angle),
                                                   tube.radius * std::sin(angle), 0}));
    }
    imaging::DrawPolygon(image, rim, {.color = kTube});
  }
  for (const double side : {-1.0, 1.0}) {
    const base::Vec3 foot = tube.base + base::Vec3{side * tube.radius, 0, 0};
    imaging::DrawLine(image, At(camera, foot), At(camera, foot + tube.length * tube.axis),
                      {.color = kTube});
  }
}

// All of the powder, and room beside the plate for what falls.
imaging::Camera CameraOf(std::vector<base::Sphere> powder, double plate_diameter, int width) {
  constexpr double kRoom = 0.65;  // from the plate's centre, of its diameter
  powder.push_back({.position = {kRoom * plate_diameter, 0, 0}, .radius = 0});
  const imaging::Camera camera = imaging::WholeHeap(powder, plate_diameter, width);
  const int most = static_cast<int>(kMostHeight * width);
  if (camera.height <= most) return camera;
  return imaging::WholeHeap(powder, plate_diameter, width * most / camera.height);
}

// Endings of what people ask for; "film.v2" is a folder.
void RequireFormat(const std::filesystem::path& out) {
  constexpr std::array kOthers{".mp4", ".webm", ".avi",  ".mov", ".mkv", ".mpg",
                               ".png", ".jpg",  ".jpeg", ".bmp", ".tif", ".tiff"};
  const std::string ending = base::Lower(out.extension().string());
  if (std::ranges::find(kOthers, ending) == kOthers.end()) return;
  throw base::ConfigError(
      "--film: writes .gif, or one PNG a frame into a folder, not \"" + ending +
      "\"; make it of the folder: ffmpeg -framerate 16 -i FOLDER/%04d.png film.mp4");
}

bool IsGifName(const std::filesystem::path& out) {
  return base::Lower(out.extension().string()) == ".gif";
}

bool IsUpright(const engine::OpenCylinder& tube) { return std::abs(tube.axis.z) > 0.999; }

}  // namespace

Film::Film(std::filesystem::path out, const rigs::Case& rig_case, FilmSize size)
    : out_(std::move(out)), size_(size) {
  if (rig_case.rig.kind == rigs::RigKind::kLiftedTube) {
    plate_diameter_ = rig_case.rig.lifted_tube.plate_diameter;
  }
}

void Film::Look(const rigs::RigRun& run) {
  const engine::Simulation& simulation = run.rig().simulation();
  if (simulation.time() < next_) return;
  Scene scene;
  for (const engine::Particle& p : simulation.Particles()) {
    scene.spheres.push_back({p.position, p.radius});
  }
  for (std::size_t i = 0; i < simulation.Walls().size(); ++i) {
    const auto* tube = std::get_if<engine::OpenCylinder>(&simulation.Walls()[i].shape);
    if (tube == nullptr || !IsUpright(*tube) || simulation.IsRemoved(static_cast<int>(i))) continue;
    scene.tubes.push_back(*tube);
  }
  if (scenes_.empty()) first_ = simulation.time();
  scenes_.push_back(std::move(scene));
  if (IsFull()) {
    for (std::size_t i = 1; 2 * i < scenes_.size(); ++i) scenes_[i] = std::move(scenes_[2 * i]);
    scenes_.resize(scenes_.size() / 2);
    interval_ = (simulation.time() - first_) / static_cast<double>(scenes_.size());
  }
  next_ = simulation.time() + interval_;
}

double Film::Scene::Top() const {
  double top = 0;
  for (const base::Sphere& s : spheres) top = std::max(top, s.position.z + s.radius);
  return top;
}

bool Film::IsFull() const {
  const std::size_t most = kMostSpheres / std::max<std::size_t>(scenes_.back().spheres.size(), 1);
  return scenes_.size() >= std::clamp<std::size_t>(most, 2, size_.most_frames);
}

// A heap on its plate; else all that the powder comes to.
imaging::Camera Film::CameraOfAll() const {
  if (plate_diameter_ > 0) {
    // A poured powder is not there at first, and a lifted one gone at last.
    const Scene& highest = *std::ranges::max_element(scenes_, {}, &Scene::Top);
    return CameraOf(highest.spheres, plate_diameter_, size_.width);
  }
  std::vector<base::Sphere> all;
  for (const Scene& scene : scenes_) {
    all.insert(all.end(), scene.spheres.begin(), scene.spheres.end());
  }
  if (all.empty()) all.push_back({.position = {}, .radius = 1e-3});
  return imaging::FromTheFront(all, size_.width, kMostHeight);
}

void Film::Write() const {
  if (scenes_.empty()) return;
  const imaging::Camera camera = CameraOfAll();
  std::vector<imaging::ColorImage> frames;
  for (const Scene& scene : scenes_) {
    frames.push_back(imaging::RenderSpheres(scene.spheres, camera));
    for (const engine::OpenCylinder& tube : scene.tubes) DrawTube(tube, camera, frames.back());
  }
  if (IsGifName(out_)) {
    const double frame_time = kLength / static_cast<double>(size_.most_frames);
    std::string gif = imaging::EncodeGif(frames, frame_time);
    gif.insert(gif.size() - 1, kFilmMark);
    base::WriteFileAtomically(out_, gif);
    return;
  }
  base::RemoveFormerFiles(out_, "0");  // a longer film's frames, "0001.png"
  for (std::size_t i = 0; i < frames.size(); ++i) {
    imaging::WritePng(out_ / (base::FileNumber(static_cast<std::int64_t>(i) + 1) + ".png"),
                      frames[i]);
  }
}

void ClaimFilm(const std::filesystem::path& out) {
  RequireFormat(out);
  if (!IsGifName(out)) return base::ClaimOutputFolder(out, "simulate --film");
  const std::filesystem::path folder = out.has_parent_path() ? out.parent_path() : ".";
  if (!std::filesystem::is_directory(folder)) {
    throw base::ConfigError("--film " + out.string() + ": there is no folder " + folder.string() +
                            "; make it, or name another");
  }
  if (std::filesystem::is_directory(out)) {
    throw base::ConfigError("--film " + out.string() + ": is a folder; name a file");
  }
  if (std::filesystem::exists(std::filesystem::symlink_status(out)) && !IsOwnGif(out)) {
    throw base::ConfigError("--film " + out.string() +
                            ": is a file that `talus simulate --film` has not written; name "
                            "another");
  }
}

}  // namespace talus::trials
