// One of a campaign's experiments as its user writes it: photographs or a map of a heap, the device
// that it was made with where that is not the campaign's, and numbers that were measured beside.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/lifted_tube/device.h"
#include "experiments/rigs/lifted_tube/heap_rules.h"
#include "imaging/photos/experiment.h"

namespace talus::campaign {

// A mass from a balance, with the error of what is given (of the mean, where it is a mean).
struct MeasuredMass {
  double value = 0;           // [kg], >= 0
  double standard_error = 0;  // [kg], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("value", self.value,
          {.dimension = Dimension::kMass, .required = true, .doc = "what was weighed, >= 0"});
    visit("sd", self.standard_error,
          {.dimension = Dimension::kMass,
           .required = true,
           .doc = "standard error of the value given, > 0"});
  }
  void Validate(base::Problems& problems) const;
};

struct ExperimentSpec {
  std::string name;
  imaging::ExperimentOptions images;
  std::optional<rigs::Device> device{};    // default: the campaign's
  std::optional<rigs::HeapRules> rules{};  // default: the campaign's
  std::optional<MeasuredMass> mass_on_plate{};
  std::optional<MeasuredMass> mass_fallen{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name, {.required = true, .doc = "what tables and messages call it"});
    imaging::ExperimentOptions::Visit(self.images, visit);
    visit("device", self.device, {.doc = "tube and plate, instead of the campaign's device"});
    visit("rules", self.rules, {.doc = "when each phase ends, instead of the campaign's rules"});
    visit("mass_on_plate", self.mass_on_plate, {.doc = "of the heap that stays on the plate"});
    visit("mass_fallen", self.mass_fallen, {.doc = "of the powder that fell over the rim"});
  }
  void Validate(base::Problems& problems) const;
};

// A number of an experiment under the name of the metric that trials are measured by.
struct ScalarSpec {
  std::string metric;  // "mass_fallen_kg"
  double value = 0;
  double standard_error = 0;
};
std::vector<ScalarSpec> ScalarsOf(const ExperimentSpec& experiment);

}  // namespace talus::campaign
