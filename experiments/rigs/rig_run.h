// A bulk test in a trial folder.
//
// Written there: heap.vtp and heap.csv (the grains that the image shows), profile.png (when the
// case has a frame; with a camera the mean of its pictures, and profile_sd.png; of a film the
// strip, and its pictures profile_1.png …), from_above.png (of a spread layer), state_NNNN.vtp (at
// the times of the case), result.json last.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/run/run.h"
#include "engine/run/state_writer.h"
#include "experiments/rigs/case/case.h"
#include "experiments/rigs/phased/rig.h"

namespace talus::rigs {

class RigRun : public engine::Run {
 public:
  RigRun(const Case& rig_case, std::filesystem::path folder);

  // Goes on from a checkpoint of the same case.
  RigRun(const Case& rig_case, std::filesystem::path folder,
         const engine::RunCheckpoint& checkpoint);

  bool Advance() override;
  engine::RunProgress Progress() const override { return rig_->Progress(); }
  std::vector<std::string> TakeMessages() override { return rig_->TakeMessages(); }
  std::string Checkpoint(const engine::RunTiming& timing) const override;
  void WriteResults(const engine::RunTiming& timing) const override;

  const Rig& rig() const { return *rig_; }

 private:
  void WritePictures() const;

  Case case_;
  std::filesystem::path folder_;
  std::unique_ptr<Rig> rig_;
  engine::StateWriter states_;
};

}  // namespace talus::rigs
