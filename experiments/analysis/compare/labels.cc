#include "experiments/analysis/compare/labels.h"

#include "base/text/key_text.h"
#include "experiments/campaign/spec/parameter_ranges.h"
#include "experiments/journal/objective.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::analysis {

std::string SymbolOf(std::string_view parameter) {
  static constexpr base::KeyText kSymbols[]{
      {"sliding_friction", "μₜ"},
      {"rolling_friction", "μᵣ"},
      {"surface_energy", "γ"},
      {"restitution", "e"},
      {"youngs_modulus", "Y"},
      {"poisson_ratio", "ν"},
      {"rolling_damping", "ηᵣ"},
      {"hamaker_constant", "A"},
      {"density", "ρ"},
      {"plate_sliding_friction", "μₜ plate"},
      {"plate_rolling_friction", "μᵣ plate"},
      {"plate_surface_energy", "γ plate"},
      {"tube_sliding_friction", "μₜ tube"},
      {"tube_rolling_friction", "μᵣ tube"},
      {"tube_surface_energy", "γ tube"},
      {"plate_pair_sliding_friction", "μₜ powder–plate"},
      {"plate_pair_rolling_friction", "μᵣ powder–plate"},
      {"plate_pair_restitution", "e powder–plate"},
      {"tube_pair_sliding_friction", "μₜ powder–tube"},
      {"tube_pair_rolling_friction", "μᵣ powder–tube"},
      {"tube_pair_restitution", "e powder–tube"},
      {"mass", "m"},
      {"fill", "fill"},
      {"particle_size", "d/d₀"},
  };
  return base::TextOf(kSymbols, parameter);
}

std::string WordsOf(std::string_view parameter) {
  if (SymbolOf(parameter) == parameter) return "";
  static constexpr base::KeyText kWords[]{{"youngs_modulus", "Young's modulus"},
                                          {"poisson_ratio", "Poisson's ratio"},
                                          {"hamaker_constant", "Hamaker constant"}};
  const std::string property = campaign::PlaceOf(std::string(parameter)).property;
  const std::string words = base::TextOf(kWords, property);
  return words == property ? base::Spaced(property) : words;
}

std::string LongNameOf(std::string_view parameter) {
  const std::string words = WordsOf(parameter);
  return words.empty() ? std::string(parameter) : words + " " + SymbolOf(parameter);
}

std::string MetricTitle(std::string_view metric) {
  for (const journal::ObjectiveInfo& info : journal::kObjectives) {
    if (info.metric == metric) return std::string(info.title);
  }
  static constexpr base::KeyText kTitles[]{
      {"sad_relative", "SAD / NEBP"},
      {"sad_px", "SAD"},
      {"iou", "IoU"},
      {"nebp_px", "NEBP"},
      {"nebp_mm2", "NEBP"},
      {"triangle_angle_deg", "Triangle angle"},
      {"static_cohesive_index", "Static cohesive index"},
      {"repose_angle_1_left_deg", "AOR 1 left"},
      {"repose_angle_1_right_deg", "AOR 1 right"},
      {"repose_angle_2_left_deg", "AOR 2 left"},
      {"repose_angle_2_right_deg", "AOR 2 right"},
      {"repose_angle_3_left_deg", "AOR 3 left"},
      {"repose_angle_3_right_deg", "AOR 3 right"},
  };
  if (const rigs::ObservableInfo* info = rigs::FindObservable(metric)) return info->title;
  return base::TextOf(kTitles, metric);
}

}  // namespace talus::analysis
