#include "engine/run/state_writer.h"

#include <limits>
#include <utility>

#include "base/files/file.h"
#include "base/text/number_text.h"
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
    const std::vector<Particle> particles = simulation.Particles();
    const std::string stem =
        (folder_ / ("state_" + base::FileNumber(static_cast<std::int64_t>(next_)))).string();
    if (formats_.vtp) base::WriteFileAtomically(stem + ".vtp", VtpOf(particles, simulation.time()));
    if (formats_.csv) base::WriteFileAtomically(stem + ".csv", CsvOf(particles));
  }
}

void StateWriter::SkipUntil(double time) {
  while (NextTime() <= time) ++next_;
}

}  // namespace talus::engine
