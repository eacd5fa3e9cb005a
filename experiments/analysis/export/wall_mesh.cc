#include "experiments/analysis/export/wall_mesh.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "base/text/number_text.h"

namespace talus::analysis {
namespace {

using base::Vec3;

constexpr int kCorners = 64;

// Two unit vectors across a direction.
std::pair<Vec3, Vec3> Across(const Vec3& direction) {
  const Vec3 other = std::abs(direction.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 first = Cross(direction, other);
  const Vec3 unit = first / Norm(first);
  return {unit, Cross(direction, unit)};
}

struct Circle {
  Vec3 center;
  Vec3 normal;
  double radius = 0;
};

// The index of its first corner; the others follow.
int AddCircle(const Circle& circle, WallMesh& mesh) {
  const int first = static_cast<int>(mesh.points.size());
  const auto [u, v] = Across(circle.normal);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    mesh.points.push_back(circle.center + circle.radius * std::cos(angle) * u +
                          circle.radius * std::sin(angle) * v);
  }
  return first;
}

void AddFace(int first, WallMesh& mesh) {
  std::vector<int> face;
  for (int i = 0; i < kCorners; ++i) face.push_back(first + i);
  mesh.polygons.push_back(std::move(face));
}

// Between two circles.
void AddBand(int from, int to, WallMesh& mesh) {
  for (int i = 0; i < kCorners; ++i) {
    const int next = (i + 1) % kCorners;
    mesh.polygons.push_back({from + i, from + next, to + next, to + i});
  }
}

struct Mesher {
  WallMesh mesh{};

  void operator()(const engine::Plane&) {}
  void operator()(const engine::Disc& d) {
    AddFace(AddCircle({d.center, d.normal, d.radius}, mesh), mesh);
  }
  void operator()(const engine::Annulus& a) {
    const int hole = AddCircle({a.center, a.normal, a.inner_radius}, mesh);
    AddBand(hole, AddCircle({a.center, a.normal, a.radius}, mesh), mesh);
  }
  void operator()(const engine::Rectangle& r) {
    const Vec3 along = 0.5 * r.width * r.edge;
    const Vec3 across = 0.5 * r.height * Cross(r.normal, r.edge);
    mesh.points = {r.center - along - across, r.center + along - across, r.center + along + across,
                   r.center - along + across};
    mesh.polygons = {{0, 1, 2, 3}};
  }
  void operator()(const engine::Cone& c) {
    const int base = AddCircle({c.base, c.axis, c.radius}, mesh);
    AddBand(base, AddCircle({c.base + c.length * c.axis, c.axis, c.top_radius}, mesh), mesh);
  }
  void operator()(const engine::OpenCylinder& c) {
    (*this)(engine::Cone{.base = c.base,
                         .axis = c.axis,
                         .radius = c.radius,
                         .top_radius = c.radius,
                         .length = c.length});
  }
  void operator()(const engine::SolidCylinder& c) {
    (*this)(engine::OpenCylinder{
        .base = c.base, .axis = c.axis, .radius = c.radius, .length = c.length});
    AddFace(0, mesh);
    AddFace(kCorners, mesh);
  }
};

}  // namespace

WallMesh MeshOf(const engine::WallShape& shape) {
  Mesher mesher;
  std::visit(mesher, shape);
  return std::move(mesher.mesh);
}

std::string VtpOf(const WallMesh& mesh) {
  std::string points, corners, ends;
  std::size_t end = 0;
  for (const Vec3& p : mesh.points) {
    points +=
        base::ExactNumber(p.x) + " " + base::ExactNumber(p.y) + " " + base::ExactNumber(p.z) + "\n";
  }
  for (const std::vector<int>& polygon : mesh.polygons) {
    for (const int corner : polygon) corners += std::to_string(corner) + " ";
    corners += "\n";
    end += polygon.size();
    ends += std::to_string(end) + "\n";
  }
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
         "<PolyData>\n<Piece NumberOfPoints=\"" +
         std::to_string(mesh.points.size()) + "\" NumberOfPolys=\"" +
         std::to_string(mesh.polygons.size()) +
         "\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n" +
         points +
         "</DataArray></Points>\n<Polys>\n"
         "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n" +
         corners + "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n" +
         ends + "</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace talus::analysis
