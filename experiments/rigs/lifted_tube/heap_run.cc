#include "experiments/rigs/lifted_tube/heap_run.h"

#include <utility>

#include "base/file.h"
#include "base/sphere.h"
#include "engine/run/state_file.h"
#include "experiments/rigs/lifted_tube/heap_result.h"
#include "imaging/formats/image_file.h"
#include "imaging/spheres/projection.h"

namespace talus::rigs {
namespace {

std::vector<base::Sphere> Spheres(const std::vector<engine::Particle>& particles) {
  std::vector<base::Sphere> spheres;
  for (const engine::Particle& p : particles) spheres.push_back({p.position, p.radius});
  return spheres;
}

}  // namespace

HeapRun::HeapRun(const HeapCase& heap_case, std::filesystem::path folder)
    : case_(heap_case),
      folder_(std::move(folder)),
      rig_(heap_case),
      states_(folder_, case_.outputs.times) {}

HeapRun::HeapRun(const HeapCase& heap_case, std::filesystem::path folder,
                 const engine::RunCheckpoint& checkpoint)
    : case_(heap_case),
      folder_(std::move(folder)),
      rig_(heap_case, ParseHeapState(checkpoint.state),
           engine::Simulation::Restore(checkpoint.simulation, heap_case.threads)),
      states_(folder_, case_.outputs.times) {
  states_.SkipUntil(rig_.simulation().time());
}

bool HeapRun::Advance() {
  states_.Write(rig_.simulation());  // the one at time 0
  const bool goes_on = rig_.Advance(states_.NextTime());
  states_.Write(rig_.simulation());
  return goes_on;
}

engine::RunProgress HeapRun::Progress() const {
  const engine::Simulation& simulation = rig_.simulation();
  return {.phase = std::string(base::NameOf(rig_.state().phase)),
          .time = simulation.time(),
          .end_time = rig_.ExpectedEnd(),
          .num_particles = simulation.num_particles(),
          .step = simulation.step(),
          .particle_steps = rig_.state().particle_steps};
}

std::string HeapRun::Checkpoint(const engine::RunTiming& timing) const {
  return engine::Pack({.input_hash = HeapCaseHash(case_),
                       .timing = timing,
                       .state = HeapStateLine(rig_.state()),
                       .simulation = rig_.simulation().Checkpoint()});
}

void HeapRun::WriteResults(const engine::RunTiming& timing) const {
  const std::vector<engine::Particle> heap = GrainsOfHeap(rig_.simulation());
  const double time = rig_.simulation().time();
  if (case_.outputs.vtp) {
    base::WriteFileAtomically(folder_ / "heap.vtp", engine::VtpOf(heap, time));
  }
  if (case_.outputs.csv) base::WriteFileAtomically(folder_ / "heap.csv", engine::CsvOf(heap));
  if (case_.frame) {
    const imaging::Profile profile =
        imaging::ProjectHeap(Spheres(heap), *case_.frame, case_.num_views);
    base::WriteFileAtomically(folder_ / "profile.png", imaging::EncodePng(profile.image));
  }
  base::WriteFileAtomically(folder_ / "result.json", HeapResultText(case_, rig_, heap, timing));
}

}  // namespace talus::rigs
