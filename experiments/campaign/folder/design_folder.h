// The folder of a design: simulations of a test that has not been made, in DIR/next/NAME. `talus
// next` and `talus design` make them; `talus add-experiment` and `talus calibrate --reuse` take
// them over once the test is made.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

// design.json: what was simulated where.
struct DesignRecord {
  std::string test;  // the case in the middle of the ranges: of another one this is no design
  double scale_factor = 1;
  std::uint64_t seed = 1;                              // DesignSeed's
  std::vector<journal::ParameterRecord> parameters{};  // that are searched
  std::vector<std::vector<double>> points{};           // unit cube of these

  TALUS_FIELDS(test, scale_factor, seed, parameters, points);
};

// Where a simulation lies, unit cube.
Eigen::VectorXd PointOf(const DesignRecord& record, std::size_t index);

struct DesignFolder {
  std::filesystem::path root;

  std::filesystem::path trial(std::size_t index) const;  // trials/0001 is index 0
  // Nothing where there is none, or where it is damaged: it is simulated again.
  std::optional<DesignRecord> Read() const;
  // Replaces what is there.
  void Make(const DesignRecord& record) const;
};

// Seed of a design's trial, with the campaign's seed.
inline std::uint64_t DesignSeed(std::uint64_t seed, std::size_t index) { return seed + index; }

// DIR/next, absolute.
std::filesystem::path NextFolder(const std::filesystem::path& campaign);

// All that there are of a campaign, by name.
std::vector<DesignFolder> DesignsOf(const std::filesystem::path& campaign);

}  // namespace talus::campaign
