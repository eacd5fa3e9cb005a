// One of a campaign's experiments as its user writes it: photographs or a map, or numbers that were
// measured, or both; and the rig and device that it was made with where those are not the
// campaign's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "engine/scene/pair_spec.h"
#include "experiments/campaign/spec/measured_numbers.h"
#include "experiments/rigs/case/case.h"
#include "experiments/rigs/options/filling_rule.h"
#include "experiments/rigs/options/rig_options.h"
#include "experiments/rigs/options/rules.h"
#include "imaging/drums/drum.h"
#include "imaging/photos/experiment.h"

namespace talus::campaign {

struct ExperimentSpec {
  std::string name;
  imaging::ExperimentOptions images;
  std::optional<rigs::Device> device{};                  // default: the campaign's
  std::optional<std::vector<engine::PairSpec>> pairs{};  // default: the campaign's
  std::optional<rigs::PhaseRules> rules{};               // default: the campaign's
  std::optional<rigs::RigOptions> rig{};                 // default: the campaign's
  std::optional<rigs::FillingRule> filling{};            // default: the campaign's
  std::optional<double> mass{};                          // filled [kg], > 0; default: the powder's
  std::optional<imaging::Turning> turning{};  // of a drum's photographs; default: as they show it
  std::optional<double> circle_diameter{};    // of a drum's photographs: the ring's outside [m], >=
                                              // the rig's diameter, which is the default
  MeasuredNumbers numbers;
  double weight = 1;  // power of its likelihood, > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name, {.required = true, .doc = "what tables and messages call it"});
    VisitData(self, visit);
    visit("device", self.device, {.doc = "tube and plate, instead of the campaign's device"});
    visit("pairs", self.pairs, {.doc = "of the powder with its walls, instead of the campaign's"});
    visit("rules", self.rules, {.doc = "when each phase ends, instead of the campaign's rules"});
    visit("rig", self.rig, {.doc = "kind of bulk test, instead of the campaign's rig"});
    visit("filling", self.filling, {.doc = "how the powder gets in, instead of the campaign's"});
    visit("mass", self.mass,
          {.dimension = base::Dimension::kMass, .doc = "filled, > 0, instead of the powder's"});
    visit(
        "weight", self.weight,
        {.doc = "power of its likelihood, > 0; above 1 the answer is narrower than the data say"});
  }
  // What was measured: images, how a drum's are read, numbers.
  template <class Self, class Visitor>
  static void VisitData(Self& self, Visitor&& visit) {
    imaging::ExperimentOptions::Visit(self.images, visit);
    visit("turning", self.turning,
          {.doc = "how a drum's photographs show it turn: clockwise carries the powder up on the "
                  "left; default: read from the picture"});
    visit("circle_diameter", self.circle_diameter,
          {.dimension = base::Dimension::kLength,
           .doc = "of the outermost circle on a drum's photographs, the outside of its ring; "
                  "default: the rig's diameter"});
    MeasuredNumbers::Visit(self.numbers, visit);
  }
  void Validate(base::Problems& problems) const;
};

inline rigs::RigKind KindOf(const ExperimentSpec& experiment) {
  return rigs::KindOf(experiment.rig);
}

// A case with its rig and device, and nothing else.
rigs::Case RigOf(const ExperimentSpec& experiment);

// Whether images that are scaled by this width [m] can be of this rig: within 1 % of its own.
bool IsWidthOf(const rigs::Case& rig_case, double width);

inline std::vector<ScalarSpec> ScalarsOf(const ExperimentSpec& experiment) {
  return ScalarsOf(experiment.numbers);
}

}  // namespace talus::campaign
