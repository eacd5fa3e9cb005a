#include "engine/scene/filling.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "base/random.h"
#include "base/sphere.h"

namespace talus::engine {
namespace {

constexpr double kEnlarged =
    1.01;                       // radii while the sweeps go on: leaves gaps in place of overlaps
constexpr double kSkin = 0.25;  // of the pair list, in largest radii

double Between(double low, double x, double high) { return std::max(low, std::min(x, high)); }

// The low-discrepancy sequence of the plastic number in two dimensions [roberts2018], shifted by
// the seed, over the height in order.
std::vector<Vec3> Spread(std::span<const double> radii, const FillRegion& region, double height,
                         std::uint64_t seed) {
  constexpr double kPlastic = 1.32471795724474602596;
  base::Random shift(seed, base::Stream("fill"));
  const double shift_u = shift.Uniform();
  const double shift_v = shift.Uniform();
  std::vector<Vec3> positions(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    base::Random jitter(seed, base::Stream("fill jitter"), i);
    const double k = static_cast<double>(i);
    const double u = std::fmod(shift_u + k / kPlastic, 1);
    const double v = std::fmod(shift_v + k / (kPlastic * kPlastic), 1);
    Vec3& x = positions[i];
    if (region.shape == RegionShape::kCylinder) {
      const double reach = (*region.diameter / 2 - radii[i]) * std::sqrt(u);
      const double angle = 2 * std::numbers::pi * v;
      x = {reach * std::cos(angle), reach * std::sin(angle), 0};
    } else {
      x = {(u - 0.5) * (*region.width_x - 2 * radii[i]),
           (v - 0.5) * (*region.width_y - 2 * radii[i]), 0};
    }
    x.z = height * (k + 0.5) / static_cast<double>(radii.size());
    // Without it the grains of one size would stand in a pattern.
    const double r = radii[i];
    x += {jitter.Uniform(-r, r), jitter.Uniform(-r, r), jitter.Uniform(-r, r)};
  }
  return positions;
}

// Puts a grain back into the region.
void Confine(const FillRegion& region, double radius, Vec3& x) {
  const double highest =
      region.height ? *region.height - radius : std::numeric_limits<double>::infinity();
  x.z = Between(radius, x.z, std::max(radius, highest));
  if (region.shape == RegionShape::kBox) {
    const double reach_x = std::max(0.0, *region.width_x / 2 - radius);
    const double reach_y = std::max(0.0, *region.width_y / 2 - radius);
    x.x = Between(-reach_x, x.x, reach_x);
    x.y = Between(-reach_y, x.y, reach_y);
  } else {
    const double reach = std::max(0.0, *region.diameter / 2 - radius);
    const double distance = std::hypot(x.x, x.y);
    if (distance > reach) {
      x.x *= reach / distance;
      x.y *= reach / distance;
    }
  }
}

struct Pair {
  std::uint32_t i = 0;
  std::uint32_t j = 0;
};

// Cells of the pair search. What lies outside counts to the nearest cell, which keeps neighbours in
// neighbouring cells.
class Grid {
 public:
  Grid(std::span<const Vec3> x, double cell) : cell_(cell) {
    low_ = high_ = x.front();
    for (const Vec3& p : x) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    }
    const Vec3 size = high_ - low_;
    const double most = 1e6 + 64 * static_cast<double>(x.size());
    const auto cells = [&] {
      return (1 + size.x / cell_) * (1 + size.y / cell_) * (1 + size.z / cell_);
    };
    while (cells() > most) cell_ *= 1.25;  // few grains in a large region
    nx_ = Count(size.x);
    ny_ = Count(size.y);
    nz_ = Count(size.z);
    first_.assign(static_cast<std::size_t>(nx_) * ny_ * nz_ + 1, 0);
    members_.resize(x.size());
    for (const Vec3& p : x) ++first_[Cell(p) + 1];
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < x.size(); ++i) members_[next[Cell(x[i])]++] = i;
  }

  // Calls visit(j) for every j in the 27 cells round p.
  template <class Visit>
  void Near(const Vec3& p, Visit&& visit) const {
    const int cx = Index(p.x - low_.x, nx_);
    const int cy = Index(p.y - low_.y, ny_);
    const int cz = Index(p.z - low_.z, nz_);
    for (int z = std::max(0, cz - 1); z <= std::min(nz_ - 1, cz + 1); ++z) {
      for (int y = std::max(0, cy - 1); y <= std::min(ny_ - 1, cy + 1); ++y) {
        const auto row = (static_cast<std::size_t>(z) * ny_ + y) * nx_;  // cells in x are adjacent
        const auto from = first_[row + std::max(0, cx - 1)];
        const auto to = first_[row + std::min(nx_ - 1, cx + 1) + 1];
        for (auto k = from; k < to; ++k) visit(members_[k]);
      }
    }
  }

 private:
  int Count(double length) const { return 1 + static_cast<int>(length / cell_); }
  int Index(double offset, int n) const {
    return std::min(n - 1, static_cast<int>(offset / cell_));
  }
  std::size_t Cell(const Vec3& p) const {
    return (static_cast<std::size_t>(Index(p.z - low_.z, nz_)) * ny_ + Index(p.y - low_.y, ny_)) *
               nx_ +
           Index(p.x - low_.x, nx_);
  }

  double cell_;
  Vec3 low_, high_;
  int nx_ = 1, ny_ = 1, nz_ = 1;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> members_;
};

std::vector<Pair> PairsWithin(std::span<const Vec3> x, std::span<const double> radii, double skin) {
  const double largest = *std::max_element(radii.begin(), radii.end());
  const Grid grid(x, 2 * largest + skin);
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    grid.Near(x[i], [&](std::uint32_t j) {
      if (j <= i) return;
      const Vec3 apart = x[j] - x[i];
      const double reach = radii[i] + radii[j] + skin;
      if (Dot(apart, apart) < reach * reach) pairs.push_back({i, j});
    });
  }
  return pairs;
}

// Pushes a pair apart by its overlap, the lighter grain further.
void Separate(const Pair& pair, std::span<const double> radii, std::span<Vec3> x) {
  const double ri = radii[pair.i];
  const double rj = radii[pair.j];
  const Vec3 apart = x[pair.j] - x[pair.i];
  const double square = Dot(apart, apart);
  if (square >= (ri + rj) * (ri + rj)) return;
  const double distance = std::sqrt(square);
  const double overlap = ri + rj - distance;
  const Vec3 normal = distance > 1e-9 * ri ? apart / distance : Vec3{0, 0, 1};
  const double share_i = rj * rj * rj / (ri * ri * ri + rj * rj * rj);
  x[pair.i] -= (overlap * share_i) * normal;
  x[pair.j] += (overlap * (1 - share_i)) * normal;
}

double LargestOverlap(std::span<const Pair> pairs, std::span<const double> radii,
                      std::span<const Vec3> x) {
  double largest = 0;
  for (const auto [i, j] : pairs) {
    const double overlap = radii[i] + radii[j] - Norm(x[j] - x[i]);
    largest = std::max(largest, overlap / std::min(radii[i], radii[j]));
  }
  return largest;
}

bool MovedBeyond(std::span<const Vec3> x, std::span<const Vec3> origin, double limit) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 moved = x[i] - origin[i];
    if (Dot(moved, moved) > limit * limit) return true;
  }
  return false;
}

// Sweeps until nothing overlaps by more than the request allows, or its cap.
void Relax(std::span<const double> radii, const FillRequest& request, Filling& filling) {
  std::vector<double> enlarged(radii.begin(), radii.end());
  for (double& r : enlarged) r *= kEnlarged;
  const double skin = kSkin * *std::max_element(radii.begin(), radii.end());
  std::vector<Vec3>& x = filling.positions;
  std::vector<Vec3> origin;
  std::vector<Pair> pairs;
  for (filling.num_sweeps = 0;; ++filling.num_sweeps) {
    for (std::size_t i = 0; i < x.size(); ++i) Confine(request.region, radii[i], x[i]);
    if (origin.empty() || MovedBeyond(x, origin, skin / 2)) {
      origin = x;
      pairs = PairsWithin(x, enlarged, skin);
    }
    filling.max_overlap = LargestOverlap(pairs, radii, x);
    const bool done = filling.max_overlap <= request.max_overlap;
    if (done || filling.num_sweeps == request.max_sweeps) return;
    for (const Pair& pair : pairs) Separate(pair, enlarged, x);
  }
}

}  // namespace

double FillRegion::Area() const {
  return shape == RegionShape::kBox ? *width_x * *width_y
                                    : std::numbers::pi / 4 * *diameter * *diameter;
}

double FillRegion::Narrowest() const {
  return shape == RegionShape::kBox ? std::min(*width_x, *width_y) : *diameter;
}

double FillRegion::Widest() const {
  return shape == RegionShape::kBox ? std::max(*width_x, *width_y) : *diameter;
}

void FillRegion::Validate(base::Problems& problems) const {
  const bool box = shape == RegionShape::kBox;
  const auto positive = [&](const char* key, const std::optional<double>& value, bool needed) {
    problems.Require(value.has_value() || !needed, key, "is missing");
    problems.Require(!value || needed, key, "does not belong to this shape");
    problems.RequirePositive(key, value);
  };
  positive("diameter", diameter, !box);
  positive("width_x", width_x, box);
  positive("width_y", width_y, box);
  if (height) positive("height", height, true);
  problems.Require(base::IsFinite(base), "base", "must be finite");
}

void FillRequest::Validate(std::span<const double> radii, base::Problems& problems) const {
  const std::size_t before = problems.size();
  problems.Within("region", [&] { region.Validate(problems); });
  problems.Require(solid_fraction > 0 && solid_fraction <= 0.6, "solid_fraction", solid_fraction,
                   "must be in (0, 0.6]");
  problems.RequirePositive("max_overlap", max_overlap);
  problems.Require(max_sweeps > 0, "max_sweeps", max_sweeps, "must be positive");
  if (problems.size() > before) return;
  const double narrowest = region.Narrowest();
  const double room = std::min(narrowest, region.height.value_or(narrowest));
  const double most = room / 2 * (1 + 1e-9);  // drawn radii are rounded
  const auto fits = [&](double r) { return r > 0 && r <= most; };
  const auto bad = std::ranges::find_if_not(radii, fits);
  if (bad == radii.end()) return;
  problems.Require(false, "radii[" + std::to_string(bad - radii.begin()) + "]", *bad,
                   "must be positive, and at most half of the region's width and height");
}

Filling Fill(std::span<const double> radii, const FillRequest& request) {
  base::Problems problems;
  request.Validate(radii, problems);
  problems.ThrowIfAny();
  Filling filling;
  if (radii.empty()) return filling;
  const FillRegion& region = request.region;
  double volume = 0;
  for (const double r : radii) volume += base::SphereVolume(r);
  const double height = region.height.value_or(volume / (request.solid_fraction * region.Area()));
  filling.positions = Spread(radii, region, height, request.seed);
  Relax(radii, request, filling);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    filling.height = std::max(filling.height, filling.positions[i].z + radii[i]);
    filling.positions[i] += region.base;
  }
  return filling;
}

std::string TooManyGrains(double num_grains) {
  constexpr double kBytesOfGrain = 1000;  // state, neighbour list and what the filling needs
  constexpr double kMostIndices = 2.6e8;  // of eight numbers each, counted in 32 bits
  const double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (num_grains <= std::min(memory / kBytesOfGrain, kMostIndices)) return {};
  std::ostringstream text;
  text.precision(3);
  text << "makes " << num_grains << " grains, which need about " << num_grains * kBytesOfGrain / 1e9
       << " GB; this machine has " << memory / 1e9
       << " GB; take less, coarser grains, or check the units";
  return text.str();
}

std::vector<double> Shuffled(std::vector<double> values, std::uint64_t seed) {
  for (std::size_t i = values.size(); i > 1; --i) {
    base::Random random(seed, base::Stream("shuffle"), i);
    std::swap(values[i - 1], values[random.Below(i)]);
  }
  return values;
}

}  // namespace talus::engine
