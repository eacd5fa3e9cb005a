#include "experiments/rigs/case/device_text.h"

#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "base/text/joined.h"
#include "base/text/key_text.h"
#include "base/text/number_text.h"
#include "base/units.h"

namespace talus::rigs {
namespace {

// Collects the quantities that a Visit list names.
struct Quantities {
  std::string text{};

  void operator()(std::string_view key, double value, const base::FieldInfo& info = {}) {
    if (key != "plate_height")
      Add(key, {QuantityText(value, info.dimension)});  // no heap depends on it
  }
  void operator()(std::string_view key, const std::vector<double>& values,
                  const base::FieldInfo& info = {}) {
    std::vector<std::string> quantities;
    for (const double value : values) quantities.push_back(QuantityText(value, info.dimension));
    Add(key, quantities);
  }
  void operator()(std::string_view key, const std::optional<double>& value,
                  const base::FieldInfo& info = {}) {
    if (value) (*this)(key, *value, info);
  }
  template <class Other>
  void operator()(std::string_view, const Other&, const base::FieldInfo& = {}) {}

 private:
  void Add(std::string_view key, const std::vector<std::string>& quantities) {
    if (quantities.empty() || quantities.front().empty()) return;
    text += (text.empty() ? ": " : ", ") + base::Spaced(key) + " " + base::Listed(quantities);
  }
};

// "200 Pa", "4 kPa"
std::string PressureText(double value) {
  constexpr double kKilo = 1e3;
  return value < kKilo ? base::ShortNumber(value) + " Pa"
                       : base::ShortNumber(value / kKilo) + " kPa";
}

// In rpm, unless deg/s make a rounder number: a box that tilts by 20 deg/s turns by 3.333 rpm.
std::string TurnText(double value) {
  constexpr std::size_t kRounder = 2;  // digits
  const std::string rpm = base::ShortNumber(30 / std::numbers::pi * value);
  const std::string degrees = base::ShortNumber(value / base::kDegree);
  return rpm.size() > degrees.size() + kRounder ? degrees + " deg/s" : rpm + " rpm";
}

}  // namespace

std::string QuantityText(double value, base::Dimension dimension) {
  switch (dimension) {
    case base::Dimension::kLength:
      return base::ShortNumber(1e3 * value) + " mm";
    case base::Dimension::kVelocity:
      return base::ShortNumber(1e2 * value) + " cm/s";
    case base::Dimension::kAngularVelocity:
      return TurnText(value);
    case base::Dimension::kAngle:
      return base::ShortNumber(value / base::kDegree) + " deg";
    case base::Dimension::kTime:
      return base::ShortNumber(value) + " s";
    case base::Dimension::kPressure:
      return PressureText(value);
    default:
      return "";
  }
}

std::string DeviceText(const RigOptions& rig) {
  Quantities quantities;
  if (rig.kind == RigKind::kLiftedTube) {
    LiftedTubeOptions::Visit(rig.lifted_tube, quantities);
  } else {
    RigOptions::Visit(rig, quantities);
  }
  return base::Spaced(base::NameOf(rig.kind)) + quantities.text;
}

}  // namespace talus::rigs
