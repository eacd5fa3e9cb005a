// States as files that people open: CSV, and VTP for ParaView and VTK.
//
// Both have, for each sphere in the order of its id: position and diameter [m], velocity [m/s],
// angular velocity [rad/s], type (index of its material) and id.
#pragma once

#include <span>
#include <string>

#include "engine/scene.h"

namespace talus::engine {

// Head:
// id,type,x_m,y_m,z_m,diameter_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_per_s,wz_rad_per_s.
// All digits.
std::string CsvOf(std::span<const Particle> particles);

// PolyData, one vertex a sphere; arrays in base64: Points (x, y, z), and as point data diameter_m,
// velocity_m_per_s, angular_velocity_rad_per_s, type, id. `time` [s] is the field TimeValue.
std::string VtpOf(std::span<const Particle> particles, double time);

}  // namespace talus::engine
