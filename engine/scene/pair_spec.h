// A pair of materials as a scene file states it.
#pragma once

#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "engine/laws/material_pair.h"

namespace talus::engine {

struct PairSpec {
  std::vector<std::string> between{};  // two names of materials
  PairProperties stated{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("between", self.between,
          {.required = true, .doc = "names of two materials; one twice is that with itself"});
    PairProperties::Visit(self.stated, visit);
  }
  void Validate(base::Problems& problems) const;
};

}  // namespace talus::engine
