// What the kernels work on, and the table of them that exists once for each instruction set.
//
// Plain pointers and numbers only: the kernels are compiled for instructions that the machine may
// not have, so they share no code with the rest of the program.
//
// A particle i owns three rows of four doubles:
//   motion[8 i] = {x, y, z, R, vx, vy, vz, 1/m}      spin[4 i] = {ωx, ωy, ωz, 1/I}
// Positions are at the full step, velocities half a step behind (M3). For the contacts there is a
// second row of what they need of the motion:
//   single[8 i] = {vx, vy, vz, 1/m, ωx, ωy, ωz, 1/I}
// and, so that pairs out of reach cost little, a rough place:
//   spot[4 i] = {x, y, z, R}
//
// Overlaps come from positions in double precision. All else of a contact is single precision, in
// the units of engine/laws/units.h; forces are added up and motions integrated in double precision.
#pragma once

#include <cstdint>

#include "engine/laws/law_list.h"
#include "engine/laws/units.h"

namespace talus::engine {

inline constexpr int kBlock = 16;  // pairs in a block, for every width of vector

// Sixteen pairs with what they remember. `second` is a particle, or unused in contacts with a wall.
struct alignas(64) PairBlock {
  std::int32_t first[kBlock];
  std::int32_t second[kBlock];
  float spring[3][kBlock];  // δ_t [units] (K4), as `first` sees it
  float moment[3][kBlock];  // M [units] (R2), as `first` sees it
};

enum class ShapeKind : std::int32_t {
  kPlane,
  kDisc,
  kOpenCylinder,
  kSolidCylinder,
  kAnnulus,
  kRectangle,
  kCone
};

// A wall now. `point` and `axis` are point and normal, or base and axis of engine/bodies/wall.h.
struct WallView {
  ShapeKind kind;
  double point[3];     // [m]
  double axis[3];      // unit vector
  double across[3];    // unit vector perpendicular to the axis; a rectangle's edge
  double radius;       // [m], 0 for a plane; half the width of a rectangle
  double length;       // [m], 0 for a plane and a disc
  double velocity[3];  // of the pivot [m/s]
  double second = 0;   // [m]: radius of an annulus' hole or of a cone's far end, half the height
                       // of a rectangle
  bool turns = false;  // about the pivot
  double angular_velocity[3] = {};  // [rad/s]
  double pivot[3] = {};             // [m]
};

// Consecutive blocks whose pairs have the same two materials, or the same material and wall.
struct PairRun {
  std::int64_t first_block;
  std::int64_t num_pairs;  // lanes beyond these in the last block are void
  std::int32_t constants;  // index into StepView::constants
  std::int32_t wall;       // index into StepView::walls, -1 between spheres
};

// What the kernels need of two materials.
struct KernelConstants {
  SingleConstants law;
  double adhesion_gap;  // as in `law`, but in [m]
};

// What numbers in SI units are multiplied by to be in the kernels' units, and, of forces, back.
struct Scales {
  float length, length_squared, speed, spin;
  float time_step;  // in the kernels' units
  double motion_speed, motion_spin, inverse_mass, inverse_inertia, position;  // of rounded motions
  double force, torque;  // from the kernels' units to SI units
};

struct StepView {
  double* motion;
  double* spin;
  float* single;
  float* spot;
  const KernelConstants* constants;
  const WallView* walls;
  double gravity[3];  // [m/s²]
  double time_step;   // Δt [s]
  Scales scales;
  double speed_limit;  // [m/s]
};

// The particles [begin, end) and the pairs whose first particle is among them. Force rows
// {fx, fy, fz, 0, tx, ty, tz, 0} in those units exist for [begin, window_end), which holds all
// second ones; those before `fresh` have been in use a moment ago.
struct PanelView {
  std::int64_t begin, end, window_end, fresh;
  PairBlock* blocks;
  std::uint16_t* touching;  // of each block: lanes with δ > 0 at the last evaluation
  const PairRun* runs;
  std::int64_t num_runs;
  double* forces;
};

// Largest squared speed [m²/s²], and whether every speed is a number below the limit.
struct MotionCheck {
  double max_speed_squared;
  bool sound;
};

// Force rows of an earlier chunk that reach into this one.
struct Overhang {
  double* forces;  // row of `begin`
  std::int64_t begin, end;
};

// Positions at the last rebuild, in the order of the particles.
struct CloudView {
  const double* x;
  const double* y;
  const double* z;
  const double* radius;
};

// Particles of [begin, end) nearer to particle i than radii plus `reach`; `touching` those nearer
// than the radii. The lists must have room for end − begin more, and a block beyond.
struct SearchQuery {
  std::int64_t i, begin, end;
  double reach;  // [m]
};
struct SearchLists {
  std::int32_t* touching;
  std::int32_t* near;
  std::int64_t num_touching;
  std::int64_t num_near;
};

struct Displacements {
  double largest_squared;  // [m²]
  double second_squared;   // [m²]
};

using ForcesFunction = void (*)(const StepView&, const PanelView&);

struct KernelTable {
  const char* name;
  int width;  // doubles in a vector
  ForcesFunction forces[kNumLawRows][kNumRollingLaws];
  MotionCheck (*integrate)(const StepView&, const PanelView&, const Overhang*, std::int64_t);
  // The single rows and spots of particles [begin, end), whole blocks, from their motion.
  void (*round_motion)(const StepView&, std::int64_t begin, std::int64_t end);
  void (*search)(const CloudView&, const SearchQuery&, SearchLists&);
  Displacements (*displacements)(const CloudView&, const double* motion, std::int64_t begin,
                                 std::int64_t end);
  // Distance of each sphere's surface from the wall [m], to gap[0 … end − begin), rounded up to a
  // whole block.
  void (*wall_gaps)(const StepView&, std::int64_t wall, std::int64_t begin, std::int64_t end,
                    double* gap);
};

namespace avx512 {
extern const KernelTable kTable;
}
namespace avx2 {
extern const KernelTable kTable;
}
namespace sse2 {
extern const KernelTable kTable;
}

}  // namespace talus::engine
