#include "bench/optimizers/problems.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus::bench {
namespace {

constexpr double kPi = 3.14159265358979323846;
using Mat = std::array<Vec, D>;

const Vec kLower = {0.001, 0.001, 1e-6};
const Vec kUpper = {0.7, 0.7, 40e-5};

// random numbers
inline std::uint64_t Mix(std::uint64_t z) {  // splitmix64 finaliser
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}
struct Rng {
  std::uint64_t s;
  bool have = false;
  double spare = 0;
  explicit Rng(std::uint64_t seed) : s(Mix(seed)) {}
  std::uint64_t Next() { return s = Mix(s); }
  double Uniform() { return ((Next() >> 11) + 0.5) * (1.0 / 9007199254740992.0); }
  double Uniform(double a, double b) { return a + (b - a) * Uniform(); }
  double Normal() {
    if (have) {
      have = false;
      return spare;
    }
    double u = Uniform(), v = Uniform(), r = std::sqrt(-2 * std::log(u));
    spare = r * std::sin(2 * kPi * v);
    have = true;
    return r * std::cos(2 * kPi * v);
  }
};
inline std::uint64_t HashString(const std::string& t) {
  std::uint64_t h = 1469598103934665603ULL;
  for (unsigned char c : t) h = (h ^ c) * 1099511628211ULL;
  return h;
}
inline std::uint64_t HashPoint(std::uint64_t h, const Vec& u) {
  for (double v : u)
    h = Mix(h ^ static_cast<std::uint64_t>(static_cast<int64_t>(std::llround(v * 1e10))));
  return h;
}

// small helpers
inline double Clamp01(double v) { return std::min(1.0, std::max(0.0, v)); }
inline Vec ClampUnit(Vec u) {
  for (double& v : u) v = Clamp01(v);
  return u;
}
inline double SoftPlus(double t) { return t > 30 ? t : std::log1p(std::exp(t)); }

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

// heap physics imitation
// A smooth, nonlinear map of the three parameters on the shape of a heap of fixed volume.
struct HeapShape {
  double tan_theta;  // Flank slope
  double round;      // apex rounding radius
  double toe;        // width of the toe (run-out)
  double cohesion;   // saturating cohesion number in [0,1)
};
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

constexpr int kW = 96, kH = 48;
constexpr double kXMax = 1.0, kYMax = 0.75, kVolume = 0.22;

// Seed-dependent disturbance of a heap; all zero for the noise-free heap.
struct HeapNoise {
  double slope_left = 0, slope_right = 0, shift = 0;
  std::vector<double> amp, phase;  // rough free surface
};

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
double Sad(const Image& a, const Image& b) {  // mean absolute grey difference, per cent
  double acc = 0;
  for (size_t i = 0; i < a.px.size(); ++i) acc += std::fabs(double(a.px[i]) - double(b.px[i]));
  return 100 * acc / a.px.size();
}

// problems
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
  double k = level == 1 ? 1 : 3;
  double sd = k * (0.03 * (Median() - fs) + 0.05 * std::fabs(f - fs));
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
      double k = level == 1 ? 0.4 : 1.2;
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
std::unique_ptr<Problem> MakeProblem(const std::string& name, int instance) {
  Rng r(Mix(HashString(name)) ^ Mix(static_cast<std::uint64_t>(instance) * 7919u));
  std::unique_ptr<Problem> p;
  if (name == "ellipsoid")
    p.reset(new Ellipsoid(r));
  else if (name == "rosenbrock")
    p.reset(new Rosenbrock(r));
  else if (name == "rastrigin")
    p.reset(new RastriginMild(r));
  else if (name == "sector")
    p.reset(new AttractiveSector(r));
  else if (name == "branin3")
    p.reset(new Branin3(r));
  else if (name == "hartmann3")
    p.reset(new Hartmann3(r));
  else if (name == "banana")
    p.reset(new Banana(r));
  else if (name == "heap")
    p.reset(new Heap(r));
  else if (name == "heap_misfit")
    p.reset(new HeapMisfit(r));
  else
    return nullptr;
  p->name = name;
  p->instance = instance;
  return p;
}

namespace {

// Numerical optimum (only for the problems without a known one): random search, then Nelder-Mead
// restarts.
void NumericalOptimum(const Problem& p, Vec& best, double& fbest) {
  Rng rng(HashString("optimum"));
  std::vector<std::pair<double, Vec>> pool;
  for (int i = 0; i < 3000; ++i) {
    Vec u{rng.Uniform(), rng.Uniform(), rng.Uniform()};
    pool.push_back({p.Value(u), u});
  }
  std::sort(pool.begin(), pool.end(), [](auto& a, auto& b) { return a.first < b.first; });
  fbest = 1e300;
  for (int s = 0; s < 8; ++s) {
    Vec x0 = pool[s * 3].second;
    for (int round = 0; round < 4; ++round) {
      double step = 0.12 * std::pow(0.3, round);
      std::vector<std::pair<double, Vec>> S;
      S.push_back({p.Value(x0), x0});
      for (int k = 0; k < D; ++k) {
        Vec y = x0;
        y[k] = Clamp01(y[k] + (y[k] > 0.5 ? -step : step));
        S.push_back({p.Value(y), y});
      }
      for (int it = 0; it < 150; ++it) {
        std::sort(S.begin(), S.end(), [](auto& a, auto& b) { return a.first < b.first; });
        if (S[D].first - S[0].first < 1e-12) break;
        Vec c{};
        for (int i = 0; i < D; ++i)
          for (int k = 0; k < D; ++k) c[k] += S[i].second[k] / D;
        auto at = [&](double t) {
          Vec y;
          for (int k = 0; k < D; ++k) y[k] = Clamp01(c[k] + t * (S[D].second[k] - c[k]));
          return y;
        };
        Vec r = at(-1);
        double fr = p.Value(r);
        if (fr < S[0].first) {
          Vec e = at(-2);
          double fe = p.Value(e);
          S[D] = fe < fr ? std::make_pair(fe, e) : std::make_pair(fr, r);
        } else if (fr < S[D - 1].first)
          S[D] = {fr, r};
        else {
          Vec k2 = at(fr < S[D].first ? -0.5 : 0.5);
          double fk = p.Value(k2);
          if (fk < std::min(fr, S[D].first))
            S[D] = {fk, k2};
          else
            for (int i = 1; i <= D; ++i) {
              for (int k = 0; k < D; ++k) S[i].second[k] = 0.5 * (S[i].second[k] + S[0].second[k]);
              S[i].first = p.Value(S[i].second);
            }
        }
      }
      std::sort(S.begin(), S.end(), [](auto& a, auto& b) { return a.first < b.first; });
      x0 = S[0].second;
      if (S[0].first < fbest) {
        fbest = S[0].first;
        best = x0;
      }
    }
  }
}

}  // namespace

void Optimum(const Problem& p, Vec& x, double& f) {
  if (!p.KnownOptimum(x, f)) NumericalOptimum(p, x, f);
}

}  // namespace talus::bench
