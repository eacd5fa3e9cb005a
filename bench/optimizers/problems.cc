#include "bench/optimizers/problems.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bench/optimizers/arguments.h"
#include "bench/optimizers/heap_shape.h"
#include "bench/optimizers/random_numbers.h"

namespace talus::bench {
namespace {

using Mat = std::array<Vec, D>;

Mat RandomRotation(Rng& rng) {
  Mat q;
  for (int i = 0; i < D; ++i) {
    while (true) {
      for (int k = 0; k < D; ++k) q[i][k] = rng.Normal();
      for (int j = 0; j < i; ++j) {
        double d = 0;
        for (int k = 0; k < D; ++k) d += q[i][k] * q[j][k];
        for (int k = 0; k < D; ++k) q[i][k] -= d * q[j][k];
      }
      double n = 0;
      for (int k = 0; k < D; ++k) n += q[i][k] * q[i][k];
      n = std::sqrt(n);
      if (n < 1e-3) continue;
      for (int k = 0; k < D; ++k) q[i][k] /= n;
      break;
    }
  }
  return q;
}
inline Vec Multiply(const Mat& m, const Vec& v) {
  Vec r{};
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k) r[i] += m[i][k] * v[k];
  return r;
}

// Monotone instance-dependent warp of the cube: permutation, reflection and power.
struct CubeWarp {
  std::array<int, D> perm{0, 1, 2};
  std::array<bool, D> flip{};
  Vec power{1, 1, 1};
  explicit CubeWarp(Rng& rng, double lo = 0.75, double hi = 1.35) {
    for (int i = D - 1; i > 0; --i)
      std::swap(perm[i], perm[static_cast<int>(rng.Uniform() * (i + 1))]);
    for (int i = 0; i < D; ++i) {
      flip[i] = rng.Uniform() < 0.5;
      power[i] = rng.Uniform(lo, hi);
    }
  }
  Vec operator()(const Vec& u) const {
    Vec r;
    for (int i = 0; i < D; ++i) {
      double v = Clamp01(u[perm[i]]);
      if (flip[i]) v = 1 - v;
      r[i] = std::pow(v, power[i]);
    }
    return r;
  }
  Vec Inverse(const Vec& r) const {
    Vec u;
    for (int i = 0; i < D; ++i) {
      double v = std::pow(Clamp01(r[i]), 1 / power[i]);
      u[perm[i]] = flip[i] ? 1 - v : v;
    }
    return u;
  }
};

// The factor of levels 1, 2 and 3; RECORD.md has the noise of simulated heaps.
double NoiseFactor(int level) {
  static constexpr std::array<double, 3> kFactors{1, 3, 2.1};
  return kFactors.at(static_cast<std::size_t>(level - 1));
}

}  // namespace

std::uint64_t Problem::Key() const {
  return Mix(HashString(name) ^ Mix(static_cast<std::uint64_t>(instance)));
}
// Scale of the problem: median over 1024 fixed points minus the optimum.
double Problem::Median() const {
  if (std::isnan(median_)) {
    std::vector<double> v;
    Rng rng(HashString("median"));
    double off[3] = {rng.Uniform(), rng.Uniform(), rng.Uniform()};
    const double g[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    for (int i = 1; i <= 1024; ++i) {
      Vec u;
      for (int k = 0; k < D; ++k) {
        double t = off[k] + i * g[k];
        u[k] = t - std::floor(t);
      }
      v.push_back(Value(u));
    }
    std::nth_element(v.begin(), v.begin() + 512, v.end());
    median_ = v[512];
  }
  return median_;
}
double Problem::Noisy(const Vec& u, std::uint64_t seed, int level) const {
  double f = Value(u);
  if (level <= 0) return f;
  Vec x;
  double fs = 0;
  KnownOptimum(x, fs);
  Rng rng(HashPoint(Mix(Key() ^ Mix(seed ^ 0x5eedULL)), u));
  double sd = NoiseFactor(level) * (0.03 * (Median() - fs) + 0.05 * std::fabs(f - fs));
  return f + sd * rng.Normal();
}

namespace {

struct Ellipsoid : Problem {  // sphere with an offset, condition number 10, rotated
  Vec c;
  Mat q;
  explicit Ellipsoid(Rng& r) {
    for (double& v : c) v = r.Uniform(0.12, 0.88);
    q = RandomRotation(r);
  }
  double Value(const Vec& u) const override {
    Vec d;
    for (int i = 0; i < D; ++i) d[i] = u[i] - c[i];
    Vec z = Multiply(q, d);
    return z[0] * z[0] + 3.1622776601683795 * z[1] * z[1] + 10 * z[2] * z[2];
  }
  bool KnownOptimum(Vec& x, double& f) const override {
    x = c;
    f = 0;
    return true;
  }
};
struct Rosenbrock : Problem {
  Vec c, sg;
  explicit Rosenbrock(Rng& r) {
    for (int i = 0; i < D; ++i) {
      c[i] = r.Uniform(0.25, 0.75);
      sg[i] = r.Uniform() < 0.5 ? -1 : 1;
    }
  }
  double Value(const Vec& u) const override {
    Vec z;
    for (int i = 0; i < D; ++i) z[i] = 1 + 3 * sg[i] * (u[i] - c[i]);
    double f = 0;
    for (int i = 0; i + 1 < D; ++i)
      f += 100 * std::pow(z[i] * z[i] - z[i + 1], 2) + std::pow(z[i] - 1, 2);
    return f;
  }
  bool KnownOptimum(Vec& x, double& f) const override {
    x = c;
    f = 0;
    return true;
  }
};
struct RastriginMild
    : Problem {  // rippled bowl, rotated; the ripple has no period a lattice could resonate with
  Vec c, k;
  Mat q;
  explicit RastriginMild(Rng& r) {
    for (double& v : c) v = r.Uniform(0.15, 0.85);
    for (double& v : k) v = r.Uniform(3.1, 4.9);
    q = RandomRotation(r);
  }
  double Value(const Vec& u) const override {
    Vec d;
    for (int i = 0; i < D; ++i) d[i] = u[i] - c[i];
    Vec z = Multiply(q, d);
    double f = 0;
    for (int i = 0; i < D; ++i) f += z[i] * z[i] + 0.035 * (1 - std::cos(2 * kPi * k[i] * z[i]));
    return f;
  }
  bool KnownOptimum(Vec& x, double& f) const override {
    x = c;
    f = 0;
    return true;
  }
};
struct AttractiveSector
    : Problem {  // strongly asymmetric cone-like basin, not differentiable across faces
  Vec c;
  Mat q;
  explicit AttractiveSector(Rng& r) {
    for (double& v : c) v = r.Uniform(0.2, 0.8);
    q = RandomRotation(r);
  }
  double Value(const Vec& u) const override {
    Vec d;
    for (int i = 0; i < D; ++i) d[i] = u[i] - c[i];
    Vec z = Multiply(q, d);
    double f = 0;
    for (int i = 0; i < D; ++i) {
      double s = z[i] > 0 ? 6.0 : 1.0;
      f += s * s * z[i] * z[i];
    }
    return std::pow(f, 0.8);
  }
  bool KnownOptimum(Vec& x, double& f) const override {
    x = c;
    f = 0;
    return true;
  }
};
struct Branin3
    : Problem {  // Branin in two coordinates, third one coupled by a curved valley; 3 global optima
  CubeWarp w;
  explicit Branin3(Rng& r) : w(r) {}
  static double Third(double a) { return 0.5 + 0.3 * std::sin(2 * kPi * a); }
  double Value(const Vec& u) const override {
    Vec v = w(u);
    double x = 15 * v[0] - 5, y = 15 * v[1];
    double b = y - 5.1 / (4 * kPi * kPi) * x * x + 5 / kPi * x - 6;
    double f = b * b + 10 * (1 - 1 / (8 * kPi)) * std::cos(x) + 10;
    double t = v[2] - Third(v[0]);
    return f + 150 * t * t;
  }
  bool KnownOptimum(Vec& x, double& f) const override {
    Vec v;
    v[0] = (kPi + 5) / 15;
    v[1] = 2.275 / 15;
    v[2] = Third(v[0]);
    x = w.Inverse(v);
    f = 0.39788735772973816;
    return true;
  }
};
struct Hartmann3 : Problem {
  CubeWarp w;
  explicit Hartmann3(Rng& r) : w(r) {}
  double Value(const Vec& u) const override {
    static const double al[4] = {1.0, 1.2, 3.0, 3.2};
    static const double A[4][3] = {{3, 10, 30}, {0.1, 10, 35}, {3, 10, 30}, {0.1, 10, 35}};
    static const double P[4][3] = {{0.3689, 0.1170, 0.2673},
                                   {0.4699, 0.4387, 0.7470},
                                   {0.1091, 0.8732, 0.5547},
                                   {0.03815, 0.5743, 0.8828}};
    Vec v = w(u);
    double f = 0;
    for (int i = 0; i < 4; ++i) {
      double e = 0;
      for (int k = 0; k < 3; ++k) e += A[i][k] * (v[k] - P[i][k]) * (v[k] - P[i][k]);
      f -= al[i] * std::exp(-e);
    }
    return f;
  }
  bool KnownOptimum(Vec& x, double& f) const override {
    x = w.Inverse({0.11458887, 0.55564885, 0.85254698});
    f = -3.86278214782076;
    return true;
  }
};
// The degeneracy of the angle of repose: a strong scalar feature and two weak ones.
struct Banana : Problem {
  Vec c;
  HeapShape t;
  explicit Banana(Rng& r) {
    c = {r.Uniform(0.15, 0.8), r.Uniform(0.08, 0.7), r.Uniform(0.05, 0.75)};
    t = ShapeOf(c);
  }
  double Value(const Vec& u) const override {
    HeapShape h = ShapeOf(u);
    double a = (std::atan(h.tan_theta) - std::atan(t.tan_theta)) * 180 / kPi / 3.0;
    double b = (h.toe - t.toe) / 0.08, d = (h.round - t.round) / 0.12;
    return a * a + 0.35 * b * b + 0.35 * d * d;
  }
  bool KnownOptimum(Vec& x, double& f) const override {
    x = c;
    f = 0;
    return true;
  }
};
struct HeapBase : Problem {
  Image tgt;
  bool HasImage() const override { return true; }
  Image Target() const override { return tgt; }
  Image MakeImage(const Vec& u, std::uint64_t seed, int level) const override {
    HeapShape s = ShapeOf(u);
    HeapNoise n;
    double blur = 0.014 + 0.012 * s.cohesion;
    if (level > 0) {
      double k = 0.4 * NoiseFactor(level);
      Rng rng(HashPoint(Mix(Key() ^ Mix(seed ^ 0x5eedULL)), u));
      double grow = k * (1 + 1.0 * s.cohesion);
      n.slope_left = 0.030 * grow * rng.Normal();
      n.slope_right = 0.030 * grow * rng.Normal();
      n.shift = 0.008 * k * rng.Normal();
      s.round *= std::exp(0.08 * grow * rng.Normal());
      s.toe *= std::exp(0.08 * grow * rng.Normal());
      for (int i = 0; i < 8; ++i) {
        n.amp.push_back(0.0035 * grow * rng.Normal());
        n.phase.push_back(rng.Uniform(0, 2 * kPi));
      }
    }
    return Render(HeapProfile(s, n), blur);
  }
  double Value(const Vec& u) const override { return Sad(MakeImage(u, 0, 0), tgt); }
  double Noisy(const Vec& u, std::uint64_t seed, int level) const override {
    return Sad(MakeImage(u, seed, level), tgt);
  }
};
struct Heap : HeapBase {  // target made by the same noise-free map: Optimum 0
  Vec c;
  explicit Heap(Rng& r) {
    c = {r.Uniform(0.15, 0.8), r.Uniform(0.08, 0.7), r.Uniform(0.05, 0.75)};
    tgt = MakeImage(c, 0, 0);
  }
  bool KnownOptimum(Vec& x, double& f) const override {
    x = c;
    f = 0;
    return true;
  }
};
struct HeapMisfit : HeapBase {  // target outside the family of the model, as a measured heap is
  explicit HeapMisfit(Rng& r) {
    Vec c = {r.Uniform(0.2, 0.8), r.Uniform(0.1, 0.7), r.Uniform(0.05, 0.7)};
    HeapShape s = ShapeOf(c);
    HeapNoise n;
    n.slope_left = r.Uniform(-0.06, 0.06);
    n.slope_right = r.Uniform(-0.06, 0.06);
    n.shift = r.Uniform(-0.015, 0.015);
    for (int i = 0; i < 8; ++i) {
      n.amp.push_back(0.006 * r.Normal());
      n.phase.push_back(r.Uniform(0, 2 * kPi));
    }
    std::vector<double> h = HeapProfile(s, n);
    double lip = r.Uniform(0.01, 0.035),
           pos = r.Uniform(0.25, 0.5);  // slumped shoulder the model cannot make
    for (int i = 0; i < kW; ++i) {
      double x = -kXMax + 2 * kXMax * (i + 0.5) / kW;
      h[i] += lip * std::exp(-std::pow((std::fabs(x) - pos) / 0.10, 2));
    }
    tgt = Render(h, 0.020);
  }
};

}  // namespace

std::vector<std::string> ProblemNames() {
  return {"ellipsoid", "rosenbrock", "rastrigin", "sector",     "branin3",
          "hartmann3", "banana",     "heap",      "heap_misfit"};
}
Vec TwinTruth(int instance) {
  const Vec step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  Vec truth;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const double t = 0.5 + instance * step[k];
    truth[k] = 0.2 + 0.5 * (t - std::floor(t));
  }
  return truth;
}

namespace {

template <class Kind>
std::unique_ptr<Problem> Make(Rng& r) {
  return std::make_unique<Kind>(r);
}

}  // namespace

std::unique_ptr<Problem> MakeProblem(const std::string& name, int instance) {
  static const std::map<std::string, std::unique_ptr<Problem> (*)(Rng&)> kMakers = {
      {"ellipsoid", Make<Ellipsoid>},     {"rosenbrock", Make<Rosenbrock>},
      {"rastrigin", Make<RastriginMild>}, {"sector", Make<AttractiveSector>},
      {"branin3", Make<Branin3>},         {"hartmann3", Make<Hartmann3>},
      {"banana", Make<Banana>},           {"heap", Make<Heap>},
      {"heap_misfit", Make<HeapMisfit>}};
  const auto maker = kMakers.find(name);
  if (maker == kMakers.end()) Arguments::Fail("there is no problem " + name);
  Rng r(Mix(HashString(name)) ^ Mix(static_cast<std::uint64_t>(instance) * 7919u));
  std::unique_ptr<Problem> p = maker->second(r);
  p->name = name;
  p->instance = instance;
  return p;
}

}  // namespace talus::bench
