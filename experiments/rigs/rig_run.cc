#include "experiments/rigs/rig_run.h"

#include <string>
#include <utility>

#include "base/files/file.h"
#include "engine/run/state_file.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/rigs/phased/camera.h"
#include "experiments/rigs/phased/spheres.h"
#include "experiments/rigs/rig_list.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/film_strip.h"
#include "imaging/spheres/projection.h"

namespace talus::rigs {
RigRun::RigRun(const Case& rig_case, std::filesystem::path folder)
    : case_(rig_case),
      folder_(std::move(folder)),
      rig_(MakeRig(rig_case)),
      states_(folder_, case_.outputs.times) {}

RigRun::RigRun(const Case& rig_case, std::filesystem::path folder,
               const engine::RunCheckpoint& checkpoint)
    : case_(rig_case),
      folder_(std::move(folder)),
      rig_(RestoreRig(rig_case, checkpoint.state,
                      engine::Simulation::Restore(checkpoint.simulation, rig_case.threads))),
      states_(folder_, case_.outputs.times) {
  states_.SkipUntil(rig_->simulation().time());
}

bool RigRun::Advance() {
  states_.Write(rig_->simulation());  // the one at time 0
  const bool goes_on = rig_->Advance(states_.NextTime());
  states_.Write(rig_->simulation());
  return goes_on;
}

std::string RigRun::Checkpoint(const engine::RunTiming& timing) const {
  return engine::Pack({.input_hash = CaseHash(case_),
                       .timing = timing,
                       .state = rig_->StateLine(),
                       .simulation = rig_->simulation().Checkpoint()});
}

void RigRun::WriteResults(const engine::RunTiming& timing) const {
  const std::vector<engine::Particle> grains = rig_->Grains();
  const double time = rig_->simulation().time();
  if (case_.outputs.vtp) {
    base::WriteFileAtomically(folder_ / kHeapFile, engine::VtpOf(grains, time));
  }
  if (case_.outputs.csv) base::WriteFileAtomically(folder_ / "heap.csv", engine::CsvOf(grains));
  if (case_.rig.camera) {
    WritePictures();
  } else if (case_.frame) {
    const imaging::Profile profile =
        imaging::ProjectHeap(SpheresOf(grains), *case_.frame, NumViewsOf(case_));
    base::WriteFileAtomically(folder_ / kProfileFile, imaging::EncodePng(profile.image));
  }
  if (const auto picture = rig_->FromAbove(grains)) {
    base::WriteFileAtomically(folder_ / "from_above.png", imaging::EncodePng(*picture));
  }
  base::WriteFileAtomically(folder_ / kResultFile, rig_->ResultText(grains, timing));
}

void RigRun::WritePictures() const {
  const CameraOptions& camera = *case_.rig.camera;
  Pictures pictures = PicturesOf(rig_->state().camera, case_.frame.value(), camera);
  const auto write = [&](const std::string& file, const imaging::GrayImage& image) {
    base::WriteFileAtomically(folder_ / file, imaging::EncodePng(image));
  };
  write(kProfileFile, pictures.profile);
  write("profile_sd.png", pictures.standard_deviation);
  if (camera.num_pictures() == 1) return;
  const imaging::Profile film{.image = std::move(pictures.profile), .frame = ProfileFrameOf(case_)};
  for (int i = 0; i < camera.num_pictures(); ++i) {
    write(PictureFile(i), imaging::PictureOf(film, i).image);
  }
}

}  // namespace talus::rigs
