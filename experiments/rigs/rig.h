// A kind of bulk test: it builds its scene from a powder, a device and parameters, advances its
// phases, and measures its observables. Physics only; RigRun does the files. rig_list.h knows all.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/run/run.h"
#include "engine/simulation.h"

namespace talus::rigs {

// A number that a test gives.
struct Observable {
  std::string name;                                         // with its unit: "runout_m"
  double value = std::numeric_limits<double>::quiet_NaN();  // in that unit
  std::string undefined{};                                  // why it has no value; else empty
};

// "kg/m3" of "tapped_density_kg_per_m3", "-" of "hausner_ratio".
std::string UnitOfObservable(const std::string& name);

class Rig {
 public:
  virtual ~Rig() = default;

  // Advances by a slice that ends, at the latest, with the first step at or after `until` [s];
  // false when the test has ended.
  virtual bool Advance(double until = std::numeric_limits<double>::infinity()) = 0;

  virtual const engine::Simulation& simulation() const = 0;
  virtual engine::RunProgress Progress() const = 0;
  virtual std::vector<std::string> TakeMessages() = 0;

  // What it knows beside the engine's state: one line of a checkpoint.
  virtual std::string StateLine() const = 0;

  // The grains that an image shows, in a frame whose centre is x = 0 and whose baseline is z = 0.
  virtual std::vector<engine::Particle> Grains() const = 0;

  // The content of result.json.
  virtual std::string ResultText(const std::vector<engine::Particle>& grains,
                                 const engine::RunTiming& timing) const = 0;
};

}  // namespace talus::rigs
