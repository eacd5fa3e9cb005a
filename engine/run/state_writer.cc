#include "engine/run/state_writer.h"

#include <cstdio>
#include <limits>
#include <utility>

#include "base/files/file.h"
#include "engine/run/state_file.h"

namespace talus::engine {

StateWriter::StateWriter(std::filesystem::path folder, std::vector<double> times,
                         StateFormats formats)
    : folder_(std::move(folder)), times_(std::move(times)), formats_(formats) {}

double StateWriter::NextTime() const {
  return next_ < times_.size() ? times_[next_] : std::numeric_limits<double>::infinity();
}

void StateWriter::Write(const Simulation& simulation) {
  for (; NextTime() <= simulation.time(); ++next_) {
    char name[32];
    std::snprintf(name, sizeof name, "state_%04zu", next_);
    const std::vector<Particle> particles = simulation.Particles();
    const std::string stem = (folder_ / name).string();
    if (formats_.vtp) base::WriteFileAtomically(stem + ".vtp", VtpOf(particles, simulation.time()));
    if (formats_.csv) base::WriteFileAtomically(stem + ".csv", CsvOf(particles));
  }
}

void StateWriter::SkipUntil(double time) {
  while (NextTime() <= time) ++next_;
}

}  // namespace talus::engine
