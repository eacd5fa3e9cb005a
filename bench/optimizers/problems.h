// Nine three-parameter problems that imitate the calibration of a powder, noise-free and noisy; two
// of them are synthetic heaps whose every evaluation is an image. README.md says how the
// score is made of them. An instance number draws position, rotation, reflection, warp and target.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace talus::bench {

constexpr int D = 3;
using Vec = std::array<double, D>;

struct Image {
  int w = 0, h = 0;
  std::vector<float> px;  // grey levels in [0, 1], row 0 at the top, 1 = powder
};

// All points are in the unit cube. `level` of the noise: 0 none, 1 standard, 2 three times, 3 as
// noisy as heaps of 524 simulated grains; noise is a function of problem, instance, point
// and seed.
struct Problem {
  std::string name;
  int instance = 1;
  virtual ~Problem() = default;
  virtual double Value(const Vec& u) const = 0;  // noiseless
  virtual bool KnownOptimum(Vec&, double&) const { return false; }
  virtual bool HasImage() const { return false; }
  virtual Image MakeImage(const Vec&, std::uint64_t, int) const { return {}; }
  virtual Image Target() const { return {}; }
  virtual double Noisy(const Vec& u, std::uint64_t seed, int level) const;
  std::uint64_t Key() const;
  double Median() const;  // of the noiseless value over 1024 fixed points
  mutable double median_ = std::nan("");
};

std::vector<std::string> ProblemNames();
std::unique_ptr<Problem> MakeProblem(const std::string& name, int instance);

// The parameters of a twin calibration, by an additive recurrence: even over a box in which every
// parameter shows.
Vec TwinTruth(int instance);

// The noiseless optimum: exact, or by a long numerical search for heap_misfit.
void Optimum(const Problem& problem, Vec& point, double& value);

}  // namespace talus::bench
