// A heap test in a trial folder.
//
// Written there: heap.vtp and heap.csv (the grains connected with the plate), profile.png (when the
// case has a frame), state_NNNN.vtp (at the times of the case), result.json last.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/run/run.h"
#include "engine/run/state_writer.h"
#include "experiments/rigs/lifted_tube/heap_rig.h"

namespace talus::rigs {

class HeapRun : public engine::Run {
 public:
  HeapRun(const HeapCase& heap_case, std::filesystem::path folder);

  // Goes on from a checkpoint of the same case.
  HeapRun(const HeapCase& heap_case, std::filesystem::path folder,
          const engine::RunCheckpoint& checkpoint);

  bool Advance() override;
  engine::RunProgress Progress() const override;
  std::vector<std::string> TakeMessages() override { return rig_.TakeMessages(); }
  std::string Checkpoint(const engine::RunTiming& timing) const override;
  void WriteResults(const engine::RunTiming& timing) const override;

 private:
  HeapCase case_;
  std::filesystem::path folder_;
  HeapRig rig_;
  engine::StateWriter states_;
};

}  // namespace talus::rigs
