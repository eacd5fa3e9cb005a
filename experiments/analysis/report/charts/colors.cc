#include "experiments/analysis/report/charts/colors.h"

namespace talus::analysis {
std::string ColorProperties() {
  return std::string(":root { --ink: ") + kInk + "; --soft: " + kSoft + "; --star: " + kStar +
         "; --accent-pale: " + kAccentPale + "; }\n";
}

}  // namespace talus::analysis
