#include "engine/run/state_file.h"

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/text/base64.h"

namespace talus::engine {
namespace {

static_assert(std::endian::native == std::endian::little, "the VTP text says LittleEndian");

template <class T>
void Append(std::string& text, T value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  text.append(digits, end);
}

// One DataArray: its size in bytes (UInt64), then its values, in base64 as one block.
template <class T>
std::string Array(const char* type, const char* name, int num_components,
                  const std::vector<T>& values) {
  const std::uint64_t num_bytes = values.size() * sizeof(T);
  std::string bytes(sizeof num_bytes + num_bytes, '\0');
  std::memcpy(bytes.data(), &num_bytes, sizeof num_bytes);
  if (num_bytes > 0) std::memcpy(bytes.data() + sizeof num_bytes, values.data(), num_bytes);
  std::string text = std::string("<DataArray type=\"") + type + "\" Name=\"" + name +
                     "\" NumberOfComponents=\"" + std::to_string(num_components) +
                     "\" format=\"binary\">\n";
  return text + base::Base64(bytes) + "\n</DataArray>\n";
}

std::vector<double> Flat(std::span<const Particle> particles, Vec3 Particle::*field) {
  std::vector<double> values;
  values.reserve(3 * particles.size());
  for (const Particle& p : particles) {
    for (const double v : {(p.*field).x, (p.*field).y, (p.*field).z}) values.push_back(v);
  }
  return values;
}

std::string PointData(std::span<const Particle> particles) {
  std::vector<double> diameters;
  std::vector<std::int32_t> types;
  std::vector<std::int64_t> ids;
  for (const Particle& p : particles) {
    diameters.push_back(2 * p.radius);
    types.push_back(p.material);
    ids.push_back(p.id);
  }
  return "<PointData Scalars=\"diameter_m\" Vectors=\"velocity_m_per_s\">\n" +
         Array("Float64", "diameter_m", 1, diameters) +
         Array("Float64", "velocity_m_per_s", 3, Flat(particles, &Particle::velocity)) +
         Array("Float64", "angular_velocity_rad_per_s", 3,
               Flat(particles, &Particle::angular_velocity)) +
         Array("Int32", "type", 1, types) + Array("Int64", "id", 1, ids) + "</PointData>\n";
}

std::string Vertices(std::size_t num_points) {
  std::vector<std::int64_t> connectivity(num_points);
  std::vector<std::int64_t> offsets(num_points);
  for (std::size_t i = 0; i < num_points; ++i) {
    connectivity[i] = static_cast<std::int64_t>(i);
    offsets[i] = static_cast<std::int64_t>(i) + 1;
  }
  return "<Verts>\n" + Array("Int64", "connectivity", 1, connectivity) +
         Array("Int64", "offsets", 1, offsets) + "</Verts>\n";
}

}  // namespace

std::string CsvOf(std::span<const Particle> particles) {
  std::string text =
      "id,type,x_m,y_m,z_m,diameter_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_per_s,"
      "wz_rad_per_s\n";
  for (const Particle& p : particles) {
    Append(text, p.id);
    text += ',';
    Append(text, p.material);
    const Vec3& x = p.position;
    const Vec3& v = p.velocity;
    const Vec3& w = p.angular_velocity;
    for (const double value : {x.x, x.y, x.z, 2 * p.radius, v.x, v.y, v.z, w.x, w.y, w.z}) {
      text += ',';
      Append(text, value);
    }
    text += '\n';
  }
  return text;
}

std::string VtpOf(std::span<const Particle> particles, double time) {
  const std::string n = std::to_string(particles.size());
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">\n";
  Append(text, time);
  text += "\n</DataArray>\n</FieldData>\n<Piece NumberOfPoints=\"" + n + "\" NumberOfVerts=\"" + n +
          "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n";
  text += PointData(particles);
  text += "<Points>\n" + Array("Float64", "Points", 3, Flat(particles, &Particle::position)) +
          "</Points>\n";
  text += Vertices(particles.size());
  return text + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace talus::engine
