// Designs of experiments: points of the unit cube chosen before anything is known.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace talus::optimizer {

using Points = std::vector<Eigen::VectorXd>;

// Every combination of levels.size() coordinates, the last one running fastest. Coordinate i takes
// levels[i] >= 1 even values from 0 to 1 (the middle when there is one only).
Points FullFactorial(std::span<const int> levels);

// The distinct points half a step (or none) from any of `centers` in each coordinate, inside the
// cube and not themselves on the grid: at most 3ⁿ - 1 a centre. Centres are points of the grid.
Points HalfStepNeighbours(std::span<const int> levels, std::span<const Eigen::VectorXd> centers);

// Latin hypercube of cell centres: each of the num_points slices of each coordinate holds one
// point. Exchanges between points make the smallest distance large (maximin).
Points LatinHypercube(int num_points, int num_parameters, std::uint64_t seed);

// Sobol's sequence with the direction numbers of Joe and Kuo [joe2008], 1 to 12 parameters, its
// bits flipped by a seeded pattern, which keeps its even spread. Seed 0 flips nothing.
Points Sobol(int num_points, int num_parameters, std::uint64_t seed);

}  // namespace talus::optimizer
