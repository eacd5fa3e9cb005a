#include "engine/bodies/particle.h"

#include <cmath>
#include <numbers>

#include "base/sphere.h"

namespace talus::engine {

double SphereMass(const Material& material, double radius) {
  return base::SphereVolume(radius) * material.density;
}

double RayleighTime(const Material& material, double radius) {
  const double shear = material.youngs_modulus / (2 * (1 + material.poisson_ratio));
  return std::numbers::pi * radius * std::sqrt(material.density / shear) /
         (0.1631 * material.poisson_ratio + 0.8766);
}

}  // namespace talus::engine
