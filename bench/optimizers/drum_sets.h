// The table of simulated drums: its sets and images.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace talus::bench {

inline constexpr int kSide = 50;
inline constexpr double kLevels = 16;

struct Table {
  Eigen::MatrixXd sets;   // 4 × n, unit cube: the design's steps, evenly spaced
  std::vector<int> cell;  // of each set: all but restitution
  int num_cells = 0;
};

inline Table ReadTable(const std::filesystem::path& folder) {
  std::ifstream file(folder / "parameters.csv");
  std::string line;
  std::getline(file, line);
  std::vector<std::array<double, 4>> rows;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream text(line);
    double row = 0;
    std::array<double, 4> set{};
    text >> row >> set[0] >> set[1] >> set[2] >> set[3];
    rows.push_back(set);
  }
  Table table;
  table.sets.resize(4, static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < 4; ++k) {
    std::set<double> steps;
    for (const auto& set : rows) steps.insert(set[k]);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto below = std::distance(steps.begin(), steps.find(rows[i][k]));
      table.sets(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
          static_cast<double>(below) / static_cast<double>(steps.size() - 1);
    }
  }
  std::map<std::array<double, 3>, int> cells;
  for (const auto& set : rows) {
    const auto size = static_cast<int>(cells.size());
    table.cell.push_back(cells.try_emplace({set[1], set[2], set[3]}, size).first->second);
  }
  table.num_cells = static_cast<int>(cells.size());
  return table;
}

inline Eigen::MatrixXd ReadImages(const std::filesystem::path& folder, int speed,
                                  Eigen::Index count) {
  std::ifstream file(folder / ("images_" + std::to_string(speed) + "rpm.u8"), std::ios::binary);
  Eigen::MatrixXd images(count, kSide * kSide);
  std::vector<char> bytes(kSide * kSide);
  for (Eigen::Index i = 0; i < count; ++i) {
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    for (Eigen::Index k = 0; k < images.cols(); ++k) {
      images(i, k) = static_cast<std::uint8_t>(bytes[static_cast<std::size_t>(k)]) / kLevels;
    }
  }
  if (!file) {
    std::fprintf(stderr, "cannot read the images of %d rpm\n", speed);
    std::exit(1);
  }
  return images;
}

// Slope of the line that divides powder from air, [-]: the direction of the powder's first moment.
inline double SlopeOf(const Eigen::RowVectorXd& image) {
  double x = 0;
  double y = 0;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double powder = image[row * kSide + column];
      x += powder * (column + 0.5 - 0.5 * kSide);
      y += powder * (row + 0.5 - 0.5 * kSide);
    }
  }
  return std::atan2(x, y);
}

}  // namespace talus::bench
