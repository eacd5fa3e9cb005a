#include "experiments/rigs/case/device_text.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <string_view>

#include "base/text/number_text.h"

namespace talus::rigs {
namespace {

std::string Spaced(std::string_view key) {
  std::string text(key);
  std::ranges::replace(text, '_', ' ');
  return text;
}

// Collects the quantities that a Visit list names.
struct Quantities {
  std::string text{};

  void operator()(std::string_view key, double value, const base::FieldInfo& info = {}) {
    const std::string quantity = QuantityText(value, info.dimension);
    if (quantity.empty() || key == "plate_height") return;  // no heap depends on that
    text += (text.empty() ? ": " : ", ") + Spaced(key) + " " + quantity;
  }
  void operator()(std::string_view key, const std::optional<double>& value,
                  const base::FieldInfo& info = {}) {
    if (value) (*this)(key, *value, info);
  }
  template <class Other>
  void operator()(std::string_view, const Other&, const base::FieldInfo& = {}) {}
};

}  // namespace

std::string QuantityText(double value, base::Dimension dimension) {
  switch (dimension) {
    case base::Dimension::kLength:
      return base::ShortNumber(1e3 * value) + " mm";
    case base::Dimension::kVelocity:
      return base::ShortNumber(1e2 * value) + " cm/s";
    case base::Dimension::kAngularVelocity:
      return base::ShortNumber(30 / std::numbers::pi * value) + " rpm";
    case base::Dimension::kAngle:
      return base::ShortNumber(180 / std::numbers::pi * value) + " deg";
    case base::Dimension::kTime:
      return base::ShortNumber(value) + " s";
    default:
      return "";
  }
}

std::string DeviceText(const Case& rig_case) {
  Quantities quantities;
  if (rig_case.rig.kind == RigKind::kLiftedTube) {
    LiftedTubeOptions::Visit(rig_case.rig.lifted_tube, quantities);
  } else {
    RigOptions::Visit(rig_case.rig, quantities);
  }
  return Spaced(base::NameOf(rig_case.rig.kind)) + quantities.text;
}

}  // namespace talus::rigs
