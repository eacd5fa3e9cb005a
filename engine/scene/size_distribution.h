// Grain sizes: what a user states, and the curve that it means.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "base/field.h"
#include "base/problems.h"

namespace talus::engine {

enum class SizeKind { kMono, kUniform, kNormal, kLogNormal, kClasses, kCumulative, kFile };
constexpr SizeKind LastOf(SizeKind) { return SizeKind::kFile; }
enum class Weighting { kVolume, kNumber };
constexpr Weighting LastOf(Weighting) { return Weighting::kNumber; }

// Which of the optional fields a kind needs stands at the field.
struct SizeDistribution {
  SizeKind kind = SizeKind::kMono;
  Weighting by = Weighting::kVolume;           // what the shares, and a kind's density, count
  std::optional<double> diameter{};            // [m], > 0: mono
  std::optional<double> mean{};                // [m], > 0: normal
  std::optional<double> standard_deviation{};  // [m], > 0: normal
  std::optional<double> median{};              // [m], > 0: log_normal
  std::optional<double> sigma{};               // of ln d [-], > 0: log_normal
  std::optional<double> min{};                 // [m], > 0: uniform; else cut-off
  std::optional<double> max{};                 // [m], >= min: uniform; else cut-off
  std::vector<double> diameters{};  // [m], increasing: class edges, or points of the curve
  std::vector<double> shares{};     // >= 0: of each class, or finer than each diameter
  std::optional<std::filesystem::path> file{};  // CSV of an instrument: file

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    constexpr auto kLength = base::Dimension::kLength;
    visit("kind", self.kind,
          {.required = true, .doc = "shape of the distribution; a file holds classes or a curve"});
    visit("by", self.by, {.doc = "what the shares or the density count: volume or number"});
    visit("diameter", self.diameter, {.dimension = kLength, .doc = "of every grain; mono"});
    visit("mean", self.mean, {.dimension = kLength, .doc = "mean diameter; normal"});
    visit("standard_deviation", self.standard_deviation,
          {.dimension = kLength, .doc = "of the diameter; normal"});
    visit("median", self.median, {.dimension = kLength, .doc = "median diameter; log_normal"});
    visit("sigma", self.sigma, {.doc = "standard deviation of ln(diameter); log_normal"});
    visit("min", self.min,
          {.dimension = kLength,
           .doc = "smallest diameter; without it normal and log_normal end "
                  "three standard deviations below"});
    visit("max", self.max,
          {.dimension = kLength,
           .doc = "largest diameter; without it normal and log_normal end "
                  "three standard deviations above"});
    visit("diameters", self.diameters,
          {.dimension = kLength, .doc = "increasing: n + 1 class edges, or n points of the curve"});
    visit("shares", self.shares,
          {.doc = "one a class in any unit, or the share finer than each diameter, from 0 up"});
    visit("file", self.file, {.doc = "CSV file as a laser-diffraction instrument exports it"});
  }
  void Validate(base::Problems& problems) const;
};

// Puts the content of `file` in its place, so that the struct is complete without it. Does nothing
// for the other kinds. Throws ConfigError that names the file, the line and the remedy.
void ReadSizeFile(SizeDistribution& sizes);

// The same with the file's content at hand; `sizes.file` is its name.
void ReadSizeText(std::string text, SizeDistribution& sizes);

// The cumulative curves by number and by volume of a valid distribution without `file`.
class SizeCurve {
 public:
  explicit SizeCurve(const SizeDistribution& sizes);

  double smallest() const { return edges_.front(); }   // [m]
  double largest() const { return edges_.back(); }     // [m]
  double mean_volume() const { return mean_volume_; }  // of a grain, by number [m³]

  // Diameter [m] that the share `q` in [0, 1] of all grains, or of their volume, is finer than.
  double NumberQuantile(double q) const;
  double VolumeQuantile(double q) const;

 private:
  std::vector<double> edges_;   // [m], of narrow cells
  std::vector<double> number_;  // share of the grains below each edge, 0 … 1
  std::vector<double> volume_;  // share of the volume below each edge, 0 … 1
  double mean_volume_ = 0;
};

// `sizes`, all of them so many times as large; `factor` > 0.
SizeDistribution Enlarged(SizeDistribution sizes, double factor);

// Diameters [m], increasing, of the grains that make up `volume` [m³] to within one grain: the
// quantiles (i + 1/2)/n by number, so that the sample follows the curve as closely as n grains can.
std::vector<double> DrawDiameters(const SizeCurve& curve, double volume);

// What drawing from a distribution so wide that few grains make up its coarse end loses of it;
// empty where that is little.
std::string LostSizes(const SizeCurve& curve, double volume);

// Diameter [m] that the share `q` of the total volume of `diameters` is finer than.
double SampleVolumeQuantile(std::span<const double> diameters, double q);

}  // namespace talus::engine
