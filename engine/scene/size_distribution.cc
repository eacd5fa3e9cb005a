#include "engine/scene/size_distribution.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "base/normal.h"
#include "base/text/number_text.h"

namespace talus::engine {
namespace {

constexpr double kSphere = std::numbers::pi / 6;  // V / d³
constexpr double kCellRatio = 0.005;              // ln of a cell's width: its error is ~ 1e-5
constexpr double kTail = 3;                       // standard deviations kept without a cut-off

// A share below each diameter (not normalised), and the diameters at which its slope may jump.
struct Curve {
  std::vector<double> breaks;  // [m], increasing
  std::function<double(double)> share_below;
};

Curve Interpolated(std::vector<double> diameters, std::vector<double> below) {
  Curve curve{.breaks = diameters, .share_below = {}};
  curve.share_below = [d = std::move(diameters), s = std::move(below)](double x) {
    if (x <= d.front()) return s.front();
    if (x >= d.back()) return s.back();
    const auto i = static_cast<std::size_t>(std::upper_bound(d.begin(), d.end(), x) - d.begin());
    return s[i - 1] + (s[i] - s[i - 1]) * (x - d[i - 1]) / (d[i] - d[i - 1]);
  };
  return curve;
}

Curve CurveOf(const SizeDistribution& s) {
  switch (s.kind) {
    case SizeKind::kMono:
      return {.breaks = {*s.diameter, *s.diameter}, .share_below = {}};
    case SizeKind::kUniform:
      return Interpolated({*s.min, *s.max}, {0, 1});
    case SizeKind::kNormal:
      return {.breaks = {*s.mean - kTail * *s.standard_deviation,
                         *s.mean + kTail * *s.standard_deviation},
              .share_below = [m = *s.mean, sd = *s.standard_deviation](double d) {
                return base::NormalProbability((d - m) / sd);
              }};
    case SizeKind::kLogNormal:
      return {.breaks = {*s.median * std::exp(-kTail * *s.sigma),
                         *s.median * std::exp(kTail * *s.sigma)},
              .share_below = [m = *s.median, sigma = *s.sigma](double d) {
                return base::NormalProbability(std::log(d / m) / sigma);
              }};
    case SizeKind::kClasses: {
      std::vector<double> below{0};
      for (const double share : s.shares) below.push_back(below.back() + share);
      return Interpolated(s.diameters, std::move(below));
    }
    case SizeKind::kCumulative:
      return Interpolated(s.diameters, s.shares);
    case SizeKind::kFile:
      break;
  }
  return {};
}

// The curve's breaks with the cut-offs in place of what lies beyond them.
std::vector<double> CutBreaks(const Curve& curve, const SizeDistribution& sizes) {
  const bool analytic = sizes.kind == SizeKind::kNormal || sizes.kind == SizeKind::kLogNormal;
  double low = curve.breaks.front();
  double high = curve.breaks.back();
  if (sizes.min) low = analytic ? *sizes.min : std::max(low, *sizes.min);
  if (sizes.max) high = analytic ? *sizes.max : std::min(high, *sizes.max);
  std::vector<double> breaks{low};
  for (const double d : curve.breaks) {
    if (d > low && d < high) breaks.push_back(d);
  }
  breaks.push_back(high);
  return breaks;
}

std::vector<double> CellEdges(const std::vector<double>& breaks) {
  std::vector<double> edges{breaks.front()};
  for (std::size_t b = 1; b < breaks.size(); ++b) {
    const double ratio = breaks[b] / breaks[b - 1];
    const int num_cells = std::max(64, static_cast<int>(std::ceil(std::log(ratio) / kCellRatio)));
    for (int i = 1; i < num_cells; ++i) {
      edges.push_back(breaks[b - 1] * std::pow(ratio, static_cast<double>(i) / num_cells));
    }
    edges.push_back(breaks[b]);
  }
  return edges;
}

// Means over a narrow cell in which the density is even.
double MeanCube(double a, double b) { return (a + b) * (a * a + b * b) / 4; }
double MeanInverseCube(double a, double b) { return (a + b) / (2 * a * a * b * b); }

// Running sum that starts at 0 and ends at 1.
std::vector<double> Cumulative(const std::vector<double>& weights) {
  std::vector<double> sums{0};
  for (const double w : weights) sums.push_back(sums.back() + w);
  for (double& s : sums) s /= sums.back() > 0 ? sums.back() : 1;
  sums.back() = 1;
  return sums;
}

double Inverse(const std::vector<double>& edges, const std::vector<double>& sums, double q) {
  const auto found = std::upper_bound(sums.begin(), sums.end(), q);
  if (found == sums.begin()) return edges.front();
  if (found == sums.end()) return edges.back();
  const auto i = static_cast<std::size_t>(found - sums.begin());
  return edges[i - 1] + (edges[i] - edges[i - 1]) * (q - sums[i - 1]) / (sums[i] - sums[i - 1]);
}

// `owner`: the kind that needs it. Cut-offs may be given for all kinds but one size.
void RequireGiven(base::Problems& problems, const char* key, const std::optional<double>& value,
                  SizeKind owner, const SizeDistribution& s) {
  const std::string kind(base::NameOf(s.kind));
  if (s.kind == owner && !value) {
    problems.Add(key, "is missing; sizes of kind \"" + kind + "\" need it");
  }
  const bool is_cut_off = owner == SizeKind::kUniform && s.kind != SizeKind::kMono;
  if (value && s.kind != owner && !is_cut_off) {
    problems.Add(key, "does not belong to sizes of kind \"" + kind + "\"; remove it");
  } else {
    problems.RequirePositive(key, value);
  }
}

void RequireLists(base::Problems& problems, const SizeDistribution& s) {
  const bool classes = s.kind == SizeKind::kClasses;
  const std::size_t expected = s.shares.size() + (classes ? 1 : 0);
  problems.Require(s.diameters.size() >= 2, "diameters", "must have two values at least");
  problems.Require(s.diameters.size() == expected, "shares",
                   classes ? "must have one value less than diameters: one for each class"
                           : "must have as many values as diameters");
  double sum = 0;
  for (std::size_t i = 0; i < s.diameters.size(); ++i) {
    const double previous = i == 0 ? 0 : s.diameters[i - 1];
    problems.Require(s.diameters[i] > previous && std::isfinite(s.diameters[i]),
                     "diameters[" + std::to_string(i) + "]", s.diameters[i],
                     "must be positive and above the one before");
  }
  for (std::size_t i = 0; i < s.shares.size(); ++i) {
    const double least = classes || i == 0 ? 0 : s.shares[i - 1];
    problems.Require(s.shares[i] >= least && std::isfinite(s.shares[i]),
                     "shares[" + std::to_string(i) + "]", s.shares[i],
                     classes ? "must not be negative" : "must not be below the one before");
    sum += s.shares[i];
  }
  const bool some = classes ? sum > 0 : s.shares.empty() || s.shares.back() > s.shares.front();
  problems.Require(some, "shares", "must not all be the same or zero");
}

// Every length of a distribution.
struct LengthScaler {
  double factor;
  void operator()(std::string_view, std::optional<double>& field,
                  const base::FieldInfo& info = {}) const {
    if (field && info.dimension == base::Dimension::kLength) *field *= factor;
  }
  void operator()(std::string_view, std::vector<double>& field,
                  const base::FieldInfo& info = {}) const {
    if (info.dimension != base::Dimension::kLength) return;
    for (double& one : field) one *= factor;
  }
  template <class Field>
  void operator()(std::string_view, Field&, const base::FieldInfo& = {}) const {}
};

}  // namespace

void SizeDistribution::Validate(base::Problems& problems) const {
  RequireGiven(problems, "diameter", diameter, SizeKind::kMono, *this);
  RequireGiven(problems, "mean", mean, SizeKind::kNormal, *this);
  RequireGiven(problems, "standard_deviation", standard_deviation, SizeKind::kNormal, *this);
  RequireGiven(problems, "median", median, SizeKind::kLogNormal, *this);
  RequireGiven(problems, "sigma", sigma, SizeKind::kLogNormal, *this);
  RequireGiven(problems, "min", min, SizeKind::kUniform, *this);
  RequireGiven(problems, "max", max, SizeKind::kUniform, *this);
  const bool lists = kind == SizeKind::kClasses || kind == SizeKind::kCumulative;
  if (lists) RequireLists(problems, *this);
  problems.Require(lists || (diameters.empty() && shares.empty()), "diameters",
                   "belongs to sizes of kind \"classes\" or \"cumulative\"; remove it");
  problems.Require(file.has_value() == (kind == SizeKind::kFile), "file",
                   "must be given for sizes of kind \"file\", and only for them");
  if (!problems.empty() || kind == SizeKind::kFile || kind == SizeKind::kMono) return;
  const std::vector<double> breaks = CutBreaks(CurveOf(*this), *this);
  problems.Require(breaks.front() > 0, "min", breaks.front(),
                   "must be given: three standard deviations below the mean is not positive");
  problems.Require(breaks.back() >= breaks.front(), "max", breaks.back(),
                   "must not be below the smallest diameter");
  const Curve curve = CurveOf(*this);
  const bool is_cut = breaks.back() > breaks.front();
  problems.Require(!is_cut || curve.share_below(breaks.back()) > curve.share_below(breaks.front()),
                   min ? "min" : "max", "leaves no grains: the distribution has none between");
}

SizeCurve::SizeCurve(const SizeDistribution& sizes) {
  const Curve curve = CurveOf(sizes);
  const std::vector<double> breaks = CutBreaks(curve, sizes);
  if (breaks.front() == breaks.back()) {
    edges_ = {breaks.front(), breaks.front()};
    number_ = volume_ = {0, 1};
    mean_volume_ = kSphere * std::pow(breaks.front(), 3);
    return;
  }
  edges_ = CellEdges(breaks);
  std::vector<double> number;
  std::vector<double> volume;
  double sum_number = 0;
  double sum_volume = 0;
  for (std::size_t i = 1; i < edges_.size(); ++i) {
    const double a = edges_[i - 1];
    const double b = edges_[i];
    const double share = curve.share_below(b) - curve.share_below(a);
    const bool by_volume = sizes.by == Weighting::kVolume;
    number.push_back(by_volume ? share * MeanInverseCube(a, b) : share);
    volume.push_back(by_volume ? share : share * MeanCube(a, b));
    sum_number += number.back();
    sum_volume += volume.back();
  }
  number_ = Cumulative(number);
  volume_ = Cumulative(volume);
  mean_volume_ = kSphere * sum_volume / sum_number;
}

double SizeCurve::NumberQuantile(double q) const { return Inverse(edges_, number_, q); }
double SizeCurve::VolumeQuantile(double q) const { return Inverse(edges_, volume_, q); }

SizeDistribution Enlarged(SizeDistribution sizes, double factor) {
  SizeDistribution::Visit(sizes, LengthScaler{factor});
  return sizes;
}

std::vector<double> DrawDiameters(const SizeCurve& curve, double volume) {
  const auto draw = [&](std::int64_t n) {
    std::vector<double> diameters(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i) {
      diameters[static_cast<std::size_t>(i)] =
          curve.NumberQuantile((static_cast<double>(i) + 0.5) / static_cast<double>(n));
    }
    return diameters;
  };
  const auto excess = [&](const std::vector<double>& diameters) {  // in mean grains
    double sum = 0;
    for (const double d : diameters) sum += kSphere * d * d * d;
    return (sum - volume) / curve.mean_volume();
  };
  // The quantiles' volume is all but proportional to their number, so this ends at once.
  auto n = std::max<std::int64_t>(1, std::llround(volume / curve.mean_volume()));
  std::vector<double> diameters = draw(n);
  for (int i = 0; i < 20; ++i) {
    const auto too_many = std::llround(excess(diameters));
    if (too_many == 0 || n - too_many < 1) break;
    n -= too_many;
    diameters = draw(n);
  }
  return diameters;
}

std::string LostSizes(const SizeCurve& curve, double volume) {
  constexpr double kManyGrains = 1e6;  // of which no distribution that is used loses a class
  constexpr double kLittle = 0.05;     // of D90
  const double num_grains = volume / curve.mean_volume();
  if (!(num_grains >= 1 && num_grains < kManyGrains)) return {};
  const double drawn = SampleVolumeQuantile(DrawDiameters(curve, volume), 0.9);
  const double stated = curve.VolumeQuantile(0.9);
  if (drawn >= (1 - kLittle) * stated) return {};
  return "the grains' D90 is " + base::ShortNumber(drawn / stated, 2) +
         " of the distribution's: so few grains (" + base::ShortNumber(num_grains, 3) +
         ") have hardly any of its coarse end; take more powder, or finer grains";
}

double SampleVolumeQuantile(std::span<const double> diameters, double q) {
  std::vector<double> sorted(diameters.begin(), diameters.end());
  std::sort(sorted.begin(), sorted.end());
  double total = 0;
  for (const double d : sorted) total += d * d * d;
  double below = 0;
  for (const double d : sorted) {
    below += d * d * d;
    if (below >= q * total) return d;
  }
  return sorted.empty() ? 0 : sorted.back();
}

}  // namespace talus::engine
