#include "experiments/analysis/compare/labels.h"

#include <algorithm>
#include <array>
#include <utility>

#include "experiments/campaign/spec/parameter_ranges.h"
#include "experiments/journal/objective.h"
#include "experiments/rigs/observables/observable.h"

namespace talus::analysis {
namespace {

using Entry = std::pair<std::string_view, std::string_view>;

template <std::size_t N>
std::string Find(const std::array<Entry, N>& list, std::string_view key) {
  for (const auto& [name, text] : list) {
    if (name == key) return std::string(text);
  }
  return std::string(key);
}

}  // namespace

std::string SymbolOf(std::string_view parameter) {
  static constexpr std::array kSymbols{
      Entry{"sliding_friction", "μₜ"},
      Entry{"rolling_friction", "μᵣ"},
      Entry{"surface_energy", "γ"},
      Entry{"restitution", "e"},
      Entry{"youngs_modulus", "Y"},
      Entry{"poisson_ratio", "ν"},
      Entry{"rolling_damping", "ηᵣ"},
      Entry{"plate_sliding_friction", "μₜ plate"},
      Entry{"plate_rolling_friction", "μᵣ plate"},
      Entry{"plate_surface_energy", "γ plate"},
      Entry{"tube_sliding_friction", "μₜ tube"},
      Entry{"tube_rolling_friction", "μᵣ tube"},
      Entry{"tube_surface_energy", "γ tube"},
      Entry{"plate_pair_sliding_friction", "μₜ powder–plate"},
      Entry{"plate_pair_rolling_friction", "μᵣ powder–plate"},
      Entry{"plate_pair_restitution", "e powder–plate"},
      Entry{"tube_pair_sliding_friction", "μₜ powder–tube"},
      Entry{"tube_pair_rolling_friction", "μᵣ powder–tube"},
      Entry{"tube_pair_restitution", "e powder–tube"},
      Entry{"mass", "m"},
      Entry{"fill", "fill"},
      Entry{"particle_size", "d/d₀"},
  };
  return Find(kSymbols, parameter);
}

std::string WordsOf(std::string_view parameter) {
  if (SymbolOf(parameter) == parameter) return "";
  std::string words = campaign::PlaceOf(std::string(parameter)).property;
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string LongNameOf(std::string_view parameter) {
  const std::string words = WordsOf(parameter);
  return words.empty() ? std::string(parameter) : words + " " + SymbolOf(parameter);
}

std::string MetricTitle(std::string_view metric) {
  for (const journal::ObjectiveInfo& info : journal::kObjectives) {
    if (info.metric == metric) return std::string(info.title);
  }
  static constexpr std::array kTitles{
      Entry{"sad_relative", "SAD / NEBP"},
      Entry{"sad_px", "SAD"},
      Entry{"iou", "IoU"},
      Entry{"nebp_px", "NEBP"},
      Entry{"nebp_mm2", "NEBP"},
      Entry{"triangle_angle_deg", "Triangle angle"},
      Entry{"static_cohesive_index", "Static cohesive index"},
      Entry{"repose_angle_1_left_deg", "AOR 1 left"},
      Entry{"repose_angle_1_right_deg", "AOR 1 right"},
      Entry{"repose_angle_2_left_deg", "AOR 2 left"},
      Entry{"repose_angle_2_right_deg", "AOR 2 right"},
      Entry{"repose_angle_3_left_deg", "AOR 3 left"},
      Entry{"repose_angle_3_right_deg", "AOR 3 right"},
  };
  if (const rigs::ObservableInfo* info = rigs::FindObservable(metric)) return info->title;
  return Find(kTitles, metric);
}

}  // namespace talus::analysis
