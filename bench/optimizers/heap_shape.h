// Imitates the physics of a heap of fixed volume: three parameters give its shape, the shape and a
// disturbance give its profile, the profile gives a grey image.
#pragma once

#include <vector>

#include "bench/optimizers/problems.h"

namespace talus::bench {

constexpr int kW = 96, kH = 48;
constexpr double kXMax = 1.0, kYMax = 0.75, kVolume = 0.22;

// A smooth, nonlinear map of the three parameters on the shape of a heap of fixed volume.
struct HeapShape {
  double tan_theta;  // Flank slope
  double round;      // apex rounding radius
  double toe;        // width of the toe (run-out)
  double cohesion;   // saturating cohesion number in [0,1)
};
HeapShape ShapeOf(const Vec& u);

// Seed-dependent disturbance of a heap; all zero for the noise-free heap.
struct HeapNoise {
  double slope_left = 0, slope_right = 0, shift = 0;
  std::vector<double> amp, phase;  // rough free surface
};

// Heights of the columns.
std::vector<double> HeapProfile(const HeapShape& s, const HeapNoise& n);
Image Render(const std::vector<double>& h, double blur);
double Sad(const Image& a, const Image& b);  // mean absolute grey difference, per cent

}  // namespace talus::bench
