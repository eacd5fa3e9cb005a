#include "bench/optimizers/heap_shape.h"

#include <algorithm>
#include <cmath>

#include "bench/optimizers/random_numbers.h"

namespace talus::bench {
namespace {

const Vec kLower = {0.001, 0.001, 1e-6};
const Vec kUpper = {0.7, 0.7, 40e-5};

inline double SoftPlus(double t) { return t > 30 ? t : std::log1p(std::exp(t)); }

double Flank(double r, double L, const HeapShape& s) {
  double d = std::sqrt(r * r + s.round * s.round) - s.round;
  return s.tan_theta * s.toe * SoftPlus((L - d) / s.toe);
}
double HalfWidth(const HeapShape& s) {  // volume conservation, 2 pi int r h(r) dr = V
  auto vol = [&](double L) {
    const int n = 64;
    const double R = 2.2;
    double acc = 0;
    for (int i = 0; i < n; ++i) {
      double r = R * (i + 0.5) / n;
      acc += r * Flank(r, L, s);
    }
    return 2 * kPi * acc * R / n;
  };
  double a = 0.02, b = 2.0;
  for (int it = 0; it < 44; ++it) {
    double m = 0.5 * (a + b);
    (vol(m) < kVolume ? a : b) = m;
  }
  return 0.5 * (a + b);
}

}  // namespace

HeapShape ShapeOf(const Vec& u) {
  double mt = kLower[0] + u[0] * (kUpper[0] - kLower[0]);
  double mr = kLower[1] + u[1] * (kUpper[1] - kLower[1]);
  double ga = kLower[2] + u[2] * (kUpper[2] - kLower[2]);
  double s = mt / (mt + 0.18);    // sliding friction saturates
  double r = mr / (mr + 0.12);    // rolling friction saturates sooner
  double c = ga / (ga + 1.5e-4);  // cohesion number
  HeapShape h;
  h.tan_theta = 0.10 + 0.95 * s * (0.32 + 0.68 * r) + 0.30 * c * (0.3 + 0.7 * s);
  h.round = 0.05 + 0.16 * (1 - r) * s + 0.12 * c * c;
  h.toe = 0.02 + 0.13 * (1 - s) * (1 - 0.5 * c) + 0.05 * (1 - r) * (1 - c);
  h.cohesion = c;
  return h;
}

std::vector<double> HeapProfile(const HeapShape& s, const HeapNoise& n) {
  std::vector<double> h(kW);
  HeapShape l = s, r = s;
  l.tan_theta *= 1 + n.slope_left;
  r.tan_theta *= 1 + n.slope_right;
  double L = HalfWidth(s);
  double apex_left = Flank(0, L, l), apex_right = Flank(0, L, r),
         apex = 0.5 * (apex_left + apex_right);
  for (int i = 0; i < kW; ++i) {
    double x = -kXMax + 2 * kXMax * (i + 0.5) / kW - n.shift;
    double v = x < 0 ? Flank(-x, L, l) * apex / apex_left : Flank(x, L, r) * apex / apex_right;
    if (!n.amp.empty()) {
      double bump = 0;
      for (size_t k = 0; k < n.amp.size(); ++k)
        bump += n.amp[k] * std::cos((k + 3) * kPi * x + n.phase[k]);
      v += bump * std::min(1.0, v / 0.05);
    }
    h[i] = std::max(0.0, v);
  }
  return h;
}
Image Render(const std::vector<double>& h, double blur) {
  Image im;
  im.w = kW;
  im.h = kH;
  im.px.resize(kW * kH);
  const double inv = 1 / (blur * std::sqrt(2.0));
  for (int j = 0; j < kH; ++j) {
    double y = kYMax * (1 - (j + 0.5) / kH);
    for (int i = 0; i < kW; ++i) {
      double t = (h[i] - y) * inv;
      im.px[j * kW + i] = static_cast<float>(t > 4 ? 1.0 : t < -4 ? 0.0 : 0.5 * (1 + std::erf(t)));
    }
  }
  return im;
}
double Sad(const Image& a, const Image& b) {
  double acc = 0;
  for (size_t i = 0; i < a.px.size(); ++i) acc += std::fabs(double(a.px[i]) - double(b.px[i]));
  return 100 * acc / a.px.size();
}

}  // namespace talus::bench
