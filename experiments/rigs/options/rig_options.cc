#include "experiments/rigs/options/rig_options.h"

namespace talus::rigs {

std::vector<RigOptions> RigOptions::Alternatives() {
  std::vector<RigOptions> all;
  for (const auto& [name, kind] : base::Names<RigKind>::kList) {
    RigOptions options;
    options.kind = kind;
    all.push_back(options);
  }
  return all;
}

}  // namespace talus::rigs
