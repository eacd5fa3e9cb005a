// A film of a bulk test as it is simulated, drawn as the report draws heaps.
#pragma once

#include <filesystem>
#include <vector>

#include "base/sphere.h"
#include "engine/bodies/wall.h"
#include "experiments/rigs/case/case.h"
#include "experiments/rigs/rig_run.h"
#include "imaging/spheres/render.h"

namespace talus::trials {

struct FilmSize {
  int width = 420;                // of a frame [px]
  std::size_t most_frames = 160;  // > 1
};

// A trial's film: small enough for a page that is mailed.
inline constexpr FilmSize kTrialFilm{.width = 300, .most_frames = 48};
inline constexpr const char* kTrialFilmName = "film.gif";

class Film {
 public:
  // A file that ends with .gif, or a folder for one PNG a frame (ClaimFilm).
  Film(std::filesystem::path out, const rigs::Case& rig_case, FilmSize size);

  // Keeps the scene as it is now, if it is time for a frame. However long the test, there are at
  // most `most_frames`, and of millions of grains fewer: where there would be more, every second
  // one goes.
  void Look(const rigs::RigRun& run);

  void Write() const;

 private:
  struct Scene {
    std::vector<base::Sphere> spheres;
    std::vector<engine::OpenCylinder> tubes;
    double Top() const;  // of the grains, 0 without any [m]
  };

  bool IsFull() const;
  imaging::Camera CameraOfAll() const;

  std::filesystem::path out_;
  FilmSize size_;
  double plate_diameter_ = 0;  // 0: none is drawn [m]
  std::vector<Scene> scenes_;
  double first_ = 0;     // of the first scene; not 0 after a checkpoint [s]
  double next_ = 0;      // when the next frame is due [s]
  double interval_ = 0;  // between two frames; 0: each slice of the simulation [s]
};

// Makes what a film is to be written into, before anything is simulated. Throws ConfigError for a
// film that needs another program, where there is no place for the file, and for a file or a folder
// that holds anything but an earlier film.
void ClaimFilm(const std::filesystem::path& out);

}  // namespace talus::trials
