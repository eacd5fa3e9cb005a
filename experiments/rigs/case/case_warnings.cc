#include "experiments/rigs/case/case_warnings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text/number_text.h"
#include "engine/laws/pair_constants.h"
#include "engine/scene/scene_warnings.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/case/time_step.h"

namespace talus::rigs {
namespace {

// Below it a heap is a pile of boulders.
constexpr double kBoulders = 15;

// Cohesive stress over the weight of a bed as high as the tube is wide, F_po / (d² ρ g D_i) (A1).
// With γ_used = f γ (C1) it does not depend on the scale factor.
double Cohesion(const Case& c) {
  if (c.models.adhesion == engine::Adhesion::kNone) return 0;
  const engine::Material powder =
      engine::With(UsedMaterial(c), engine::StatedOf(PairsOf(c), kPowder, kPowder));
  const double pull_off = engine::MakePairConstants(powder, powder, c.models).pull_off / 4;
  return pull_off / (EstimatePowder(c).mean_diameter * powder.density * c.gravity *
                     c.rig.lifted_tube.tube_inner_diameter);
}

// Below 0.1 wet sand makes one heap however it is filled, from 0.3 on its dense bed may stand
// (docs/validation.md, How the powder got there).
std::string FillingWarning(const Case& c) {
  if (c.filling.kind != FillingKind::kDense || Cohesion(c) < 0.2) return {};
  return "COHESIVE: placed densely, such a powder may keep the shape of its tube where it slumps "
         "when poured; fill it as the experiment was filled, most likely with filling.kind "
         "\"pour\"";
}

// The dense bed is near its tapped state, however cohesive the powder.
std::string PackedWarning(const Case& c) {
  if (c.filling.kind != FillingKind::kDense) return {};
  return "FILLED DENSELY: such a bed starts near its packed state, so that poured_density is too "
         "high and hausner_ratio near 1; pour it: \"filling\": {\"kind\": \"pour\"}";
}

// An opening that powder runs out of: by Beverloo's law at a rate of (D - k d)^power.
struct Opening {
  const char* name;
  double size;   // D [m]
  double lost;   // k, diameters at its edges that nothing runs through
  double power;  // 5/2 of a round one, 3/2 of a slot
};

// Coarse grains run out more slowly than true ones, and arch where those flow: the scale factor
// decides the test, whatever the contact.
std::string OpeningWarning(const Case& c, const Opening& opening) {
  constexpr double kMostSlower = 0.1;
  const double f = c.coarse_graining.scale_factor;
  const double coarse = EstimatePowder(c).mean_diameter;
  const auto free = [&](double diameter) {
    return std::max(0.0, opening.size - opening.lost * diameter);
  };
  const double rate = std::pow(free(coarse) / free(coarse / f), opening.power);
  if (!(rate < 1 - kMostSlower)) return {};
  return "COARSE: the " + std::string(opening.name) + " is " +
         base::ShortNumber(opening.size / coarse, 2) + " grains across at scale factor " +
         base::ShortNumber(f) + ", which by Beverloo's law run out at " +
         base::ShortNumber(100 * rate, 2) +
         " % of the rate of true ones, and may arch where those flow: take a smaller scale factor, "
         "or several";
}

struct Bound {
  const char* what;  // allows no longer step
  const char* less;  // of it takes fewer steps
};

Bound TextsOf(engine::StepBound bound) {
  switch (bound) {
    case engine::StepBound::kRollingDashpot:
      return {"rolling dashpot", "M6); a smaller rolling_damping"};
    case engine::StepBound::kRollingSpring:
      return {"rolling spring", "M6); a smaller rolling_friction"};
    case engine::StepBound::kSlidingDashpot:
      break;
  }
  return {"friction's dashpot", "M7); a larger restitution or Young's modulus"};
}

// A step that the contacts shorten much costs as many more.
std::string ShortStepWarning(const Case& c) {
  constexpr double kWorthSaying = 0.8;
  const double fraction = StepFraction(c);
  if (fraction >= kWorthSaying * c.rayleigh_fraction) return {};
  const Bound bound = TextsOf(BoundOf(c));
  return "the time step is " + base::ShortNumber(fraction, 2) + " Rayleigh times in place of " +
         base::ShortNumber(c.rayleigh_fraction) + ": the " + bound.what +
         " would keep grains spinning at a longer one (docs/physics.md, " + bound.less +
         " takes fewer steps";
}

// Grains that are nearly as large as the gap are carried along by the spreader or stop it.
std::string GapWarning(const Case& c) {
  constexpr double kLeast = 1.5;  // largest grains
  const double f = c.coarse_graining.scale_factor;
  const double across = SpreadingGap(c) / LargestDiameter(c);
  if (f == 1 || across >= kLeast) return {};
  return "COARSE: the spreader's gap is " + base::ShortNumber(across, 2) +
         " of the largest grains at scale factor " + base::ShortNumber(f) +
         ": they hardly pass below it; take a smaller scale factor";
}

}  // namespace

double GrainsAcrossPlate(const Case& c) {
  const double plate = c.rig.kind == RigKind::kFunnelHeap ? c.rig.funnel_heap.plate_diameter
                                                          : c.rig.lifted_tube.plate_diameter;
  return plate / EstimatePowder(c).mean_diameter;
}

std::string FewGrainsText(double across, double scale_factor, const std::string& plate) {
  const std::string remedy =
      scale_factor == 1
          ? " at their true size: single grains show in its outline, and a wider tube and plate"
          : " at scale factor " + base::ShortNumber(scale_factor) + ": a smaller scale factor";
  return "only " + base::ShortNumber(across, 3) + " grains across the plate" +
         (plate.empty() ? "" : " of \"" + plate + "\"") + remedy + " would say more (" +
         base::ShortNumber(kAdvisedAcross) + " or more are advised)";
}

std::vector<std::string> CaseWarnings(const Case& c) {
  std::vector<std::string> warnings;
  const double across = GrainsAcrossPlate(c);
  if (IsRoundHeap(c.rig.kind) && across < kAdvisedAcross) {
    warnings.push_back((across < kBoulders ? "COARSE: " : "") +
                       FewGrainsText(across, c.coarse_graining.scale_factor, ""));
  }
  for (std::string& text : SetUpWarnings(c)) warnings.push_back(std::move(text));
  return warnings;
}

std::vector<std::string> SetUpWarnings(const Case& c) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::string text) {
    if (!text.empty()) warnings.push_back(std::move(text));
  };
  if (c.rig.kind == RigKind::kLiftedTube) warn(FillingWarning(c));
  if (c.rig.kind == RigKind::kTappedDensity) warn(PackedWarning(c));
  if (c.rig.kind == RigKind::kOrificeFlow) {
    warn(OpeningWarning(
        c, {.name = "orifice", .size = c.rig.orifice_flow.orifice, .lost = 1.5, .power = 2.5}));
  }
  if (c.rig.kind == RigKind::kDrawDown) {
    warn(OpeningWarning(c,
                        {.name = "slot", .size = c.rig.draw_down.slot, .lost = 1.4, .power = 1.5}));
  }
  if (c.rig.kind == RigKind::kSpreading) warn(GapWarning(c));
  const double f = c.coarse_graining.scale_factor;
  const double volume = c.powder.mass / c.powder.material.density;
  warn(engine::LostSizes(engine::SizeCurve(c.powder.sizes), volume / (f * f * f)));
  if (c.rayleigh_fraction > kUsualRayleighFraction) {
    warn("rayleigh_fraction is above 0.3: heaps have been compared up to there only");
  }
  warn(ShortStepWarning(c));
  const int grains[] = {kPowder};
  for (std::string& text : engine::AdhesionWarnings(c.models, MaterialsOf(c), PairsOf(c), grains)) {
    warn(std::move(text));
  }
  if (c.models.rolling == engine::Rolling::kConstant && c.rayleigh_fraction > 0.15) {
    warn(
        "constant rolling resistance creeps in proportion to the time step: set rayleigh_fraction "
        "to 0.15 or less");
  }
  return warnings;
}

}  // namespace talus::rigs
