// What our own lifted tube measures, of a heap that another engine has left.
#pragma once

#include <vector>

#include "base/sphere.h"
#include "engine/bodies/particle.h"
#include "experiments/journal/records.h"
#include "experiments/rigs/case/case.h"

namespace talus::trials {

std::vector<engine::Particle> ParticlesOf(const std::vector<base::Sphere>& spheres);

// Masses, height and angles of a heap on a plate of this diameter [m]; one grain or more. The mass
// that is filled in is the case's, whatever the other engine's grains come to.
std::vector<journal::MetricRecord> TubeNumbersOf(const rigs::Case& rig_case, double plate,
                                                 const std::vector<base::Sphere>& heap);

}  // namespace talus::trials
