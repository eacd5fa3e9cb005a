// The pictures that a rig's camera takes while the powder moves: their mean, as an average heap
// profile is the mean of views, or where any of them shows powder; and their standard deviation. Of
// a camera with several times each is a film strip (imaging/heap/film_strip.h).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/scene.h"
#include "experiments/rigs/observables/observable.h"
#include "experiments/rigs/options/camera_options.h"
#include "imaging/heap/profile.h"

namespace talus::rigs {

// What has been seen so far. Runs of the strip's pixels, row by row, that showed powder equally
// often: the number of frames with powder, and how many pixels follow that have it.
struct CameraMemory {
  int num_frames = 0;
  std::vector<int> runs{};

  TALUS_FIELDS(num_frames, runs);
};

// One frame more, seen from the front. `frame` here and below is that of one picture.
void TakePicture(std::span<const engine::Particle> grains, const imaging::Frame& frame,
                 const CameraOptions& camera, CameraMemory& memory);

// With p the share of the frames of its picture in which a pixel is powder:
struct Pictures {
  imaging::GrayImage profile;             // 255 (1 - p); shown any: 0 where p > 0, closed
  imaging::GrayImage standard_deviation;  // of the silhouettes, 255 √(p (1 - p)): 127 at most
};
Pictures PicturesOf(const CameraMemory& memory, const imaging::Frame& frame,
                    const CameraOptions& camera);

// The file of one of a film's pictures, from 0: "profile_1.png".
std::string PictureFile(int picture);

// How much the surface moves: ∫ √(p (1 - p)) dA / D, over the picture, D the width that it is
// scaled by; of a film the mean over its pictures. Level surfaces whose heights are normally
// distributed give 1.61 of their standard deviations, in 20 pictures 1.36.
Reading CohesiveIndex(const CameraMemory& memory, const imaging::Frame& frame,
                      const CameraOptions& camera);

}  // namespace talus::rigs
