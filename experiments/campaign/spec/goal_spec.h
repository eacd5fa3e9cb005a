// What a campaign is for: a number of another test that is to be predicted well enough.
#pragma once

#include <filesystem>
#include <string>

#include "base/field.h"
#include "base/problems.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::campaign {

struct GoalSpec {
  std::filesystem::path file{};  // case of a bulk test
  std::string observable{};      // a key of the table of observables
  double half_width = 0;         // of its 90 %, > 0, in SI

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("case", self.file,
          {.required = true,
           .doc = "of the bulk test that is to be predicted, as talus predict "
                  "takes it"});
    visit("observable", self.observable,
          {.required = true, .doc = "number of it that counts, such as packing_fraction"});
    visit("half_width", self.half_width,
          {.dimension = DimensionOf(self.observable),
           .required = true,
           .doc = "the search ends when the parameters leave no more of it open than ± this, "
                  "90 %; > 0, in SI or with a unit"});
  }
  void Validate(base::Problems& problems) const;

  // The half-width in the unit that results have, which follows from the name there.
  std::string metric() const;
  double half_width_in_results() const;

 private:
  static base::Dimension DimensionOf(const std::string& observable);  // none where it is not known
};

}  // namespace talus::campaign
