#include "imaging/spheres/render.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace talus::imaging {
namespace {

constexpr Color kBackground{255, 255, 255};
constexpr Color kPlate{88, 98, 107};
constexpr Color kPowder{205, 170, 120};
constexpr double kAmbient = 0.35;  // light from everywhere, of all light [-]

// In the camera's directions: right, up in the picture, towards the camera [m].
struct Seen {
  double right = 0;
  double up = 0;
  double near = 0;
};

class Picture {
 public:
  explicit Picture(const Camera& camera)
      : camera_(camera),
        cos_a_(std::cos(camera.azimuth)),
        sin_a_(std::sin(camera.azimuth)),
        cos_e_(std::cos(camera.elevation)),
        sin_e_(std::sin(camera.elevation)) {
    const auto size =
        static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
    image_ = {.width = camera.width,
              .height = camera.height,
              .pixels = std::vector<Color>(size, kBackground)};
    near_.assign(size, -std::numeric_limits<double>::infinity());
  }

  // The plate's top is seen from above, its rim from the side.
  void DrawPlate() {
    const double radius = camera_.plate_diameter / 2;
    for (int y = 0; y < camera_.height; ++y) {
      for (int x = 0; x < camera_.width; ++x) {
        const double right = RightOf(x);
        const double up = UpOf(y);
        if (std::abs(right) > radius) continue;
        const double rim = std::sqrt(radius * radius - right * right);
        if (sin_e_ > 0 && std::abs(up) <= rim * sin_e_) {
          Put(x, y, -up * cos_e_ / sin_e_, kPlate);
        } else if (up < 0) {
          Put(x, y, rim * cos_e_, {70, 79, 87});
        }
      }
    }
  }

  void DrawSphere(const base::Sphere& sphere) {
    const Seen c = SeenFrom(sphere);
    const double reach = sphere.radius / camera_.pixel_size;
    const double column = camera_.center_x + c.right / camera_.pixel_size;
    const double row = camera_.baseline - c.up / camera_.pixel_size;
    const int left = std::max(0, static_cast<int>(std::floor(column - reach)));
    const int right = std::min(camera_.width - 1, static_cast<int>(std::ceil(column + reach)));
    const int top = std::max(0, static_cast<int>(std::floor(row - reach)));
    const int bottom = std::min(camera_.height - 1, static_cast<int>(std::ceil(row + reach)));
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const double nx = (RightOf(x) - c.right) / sphere.radius;
        const double ny = (UpOf(y) - c.up) / sphere.radius;
        const double rest = 1 - nx * nx - ny * ny;
        if (rest < 0) continue;
        const double nz = std::sqrt(rest);
        Put(x, y, c.near + nz * sphere.radius, Shaded(nx, ny, nz));
      }
    }
  }

  ColorImage Take() { return std::move(image_); }

 private:
  double RightOf(int x) const { return (x + 0.5 - camera_.center_x) * camera_.pixel_size; }
  double UpOf(int y) const { return (camera_.baseline - y - 0.5) * camera_.pixel_size; }

  Seen SeenFrom(const base::Sphere& s) const {
    const double right = s.position.x * cos_a_ + s.position.y * sin_a_;
    const double away = -s.position.x * sin_a_ + s.position.y * cos_a_;
    return {.right = right,
            .up = s.position.z * cos_e_ + away * sin_e_,
            .near = s.position.z * sin_e_ - away * cos_e_};
  }

  // Light from the upper left, in front.
  static Color Shaded(double nx, double ny, double nz) {
    const double light = std::max(0.0, -0.45 * nx + 0.65 * ny + 0.61 * nz);
    const double share = std::min(1.0, kAmbient + (1 - kAmbient) * light);
    Color color;
    for (std::size_t k = 0; k < 3; ++k) {
      color[k] = static_cast<std::uint8_t>(kPowder[k] * share + 0.5);
    }
    return color;
  }

  void Put(int x, int y, double near, const Color& color) {
    double& nearest = near_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width) +
                            static_cast<std::size_t>(x)];
    if (near <= nearest) return;
    nearest = near;
    image_.at(x, y) = color;
  }

  Camera camera_;
  double cos_a_, sin_a_, cos_e_, sin_e_;
  ColorImage image_;
  std::vector<double> near_;  // of what each pixel shows
};

}  // namespace

ColorImage RenderSpheres(std::span<const base::Sphere> spheres, const Camera& camera) {
  Picture picture(camera);
  if (camera.plate_diameter > 0) picture.DrawPlate();
  for (const base::Sphere& sphere : spheres) picture.DrawSphere(sphere);
  return picture.Take();
}

Camera FromTheFront(std::span<const base::Sphere> spheres, int width, double most_height) {
  constexpr double kMargin = 0.03;  // of the spheres' width, each side
  const base::Sphere& any = spheres.front();
  double left = any.position.x, right = left, bottom = any.position.z, top = bottom;
  for (const base::Sphere& s : spheres) {
    left = std::min(left, s.position.x - s.radius);
    right = std::max(right, s.position.x + s.radius);
    bottom = std::min(bottom, s.position.z - s.radius);
    top = std::max(top, s.position.z + s.radius);
  }
  const double margin = kMargin * (right - left);
  const double high = top - bottom + 2 * margin;
  Camera camera{.width = width};
  camera.pixel_size = std::max((right - left + 2 * margin) / width, high / (most_height * width));
  camera.height = static_cast<int>(high / camera.pixel_size + 0.5);
  camera.center_x = width / 2.0 - (left + right) / 2 / camera.pixel_size;
  camera.baseline = (top + margin) / camera.pixel_size;
  return camera;
}

Camera WholeHeap(std::span<const base::Sphere> spheres, double plate_diameter, int width) {
  constexpr double kElevation = 0.35;  // [rad]
  constexpr double kMargin = 0.06;     // of the plate, each side
  double reach = plate_diameter / 2;
  double above = reach * std::sin(kElevation);  // of the baseline in the picture [m]
  for (const base::Sphere& s : spheres) {
    const double from_axis = std::hypot(s.position.x, s.position.y);
    reach = std::max(reach, from_axis + s.radius);
    // Behind, whichever way the camera turns.
    above = std::max(
        above, s.position.z * std::cos(kElevation) + from_axis * std::sin(kElevation) + s.radius);
  }
  Camera camera{.width = width, .plate_diameter = plate_diameter, .elevation = kElevation};
  const double margin = kMargin * plate_diameter;
  camera.pixel_size = 2 * (reach + margin) / width;
  camera.center_x = width / 2.0;
  above += margin;
  const double below = reach * std::sin(kElevation) + margin;
  camera.baseline = above / camera.pixel_size;
  camera.height = static_cast<int>((above + below) / camera.pixel_size + 0.5);
  return camera;
}

}  // namespace talus::imaging
