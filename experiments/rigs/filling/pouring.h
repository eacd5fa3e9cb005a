// The pouring of a test's powder into its tube or box.
#pragma once

#include <optional>
#include <vector>

#include "engine/scene/pour.h"
#include "experiments/rigs/case/case.h"
#include "experiments/rigs/filling/vessel.h"

namespace talus::rigs {

inline constexpr double kLooseSolidFraction = 0.4;  // poured spheres have 0.55 to 0.6

// Radii of the scaled grains, in the order in which they come [m].
std::vector<double> DrawRadii(const Case& rig_case);

// The mouth's diameter [m].
double MouthDiameter(const Case& rig_case, const Vessel& vessel);

engine::Pour MakePour(const Case& rig_case, const Vessel& vessel);

// How much higher than their powder a vessel's walls must be, so that no grain hops over them:
// those that are poured appear above the mouth, and a tap throws them up [m].
double Headroom(const Case& rig_case, const Vessel& vessel, const std::optional<TapRule>& taps);

// Height of the mouth above the powder, which it follows as the vessel fills to a solid fraction of
// a half [m].
double DropHeight(const Case& rig_case, const Vessel& vessel);

// How far a grain of the stream falls at most, onto the floor of the empty vessel [m].
double FallHeight(const Case& rig_case, const Vessel& vessel, const engine::Pour& pour);

// What walls that have no height of their own must hold [m].
double PouredHeight(const Case& rig_case, const Vessel& vessel);

// Overlap over radius of a grain that meets the floor, the walls or a grain at rest at this speed
// [m²/s²], alone. From the energy of a Hertz contact,
//
//   (8/15) E* √R* δ^(5/2) = m* v²/2
double BlowShare(const Case& rig_case, double square_speed);

// The heaviest blow that a grain gets when it comes down: v² = v₀² + 2 g H.
double ImpactShare(const Case& rig_case, const Vessel& vessel);

// Beyond this share, grains were pressed through the plate: a blow on a small grain that lies on it
// is that of a larger one. Of wet sand at 0.28 none of 300 pours lost one, at 0.3 one of 250
// (docs/validation.md, Filling).
inline constexpr double kMaxImpactShare = 0.28;

}  // namespace talus::rigs
