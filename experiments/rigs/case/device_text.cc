#include "experiments/rigs/case/device_text.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <string_view>

#include "base/text/number_text.h"

namespace talus::rigs {
namespace {

struct BenchUnit {
  const char* text = nullptr;  // none: not a quantity of the bench
  double per_unit = 1;         // number in it / SI
};

BenchUnit UnitOf(base::Dimension dimension) {
  switch (dimension) {
    case base::Dimension::kLength:
      return {" mm", 1e3};
    case base::Dimension::kVelocity:
      return {" cm/s", 1e2};
    case base::Dimension::kAngularVelocity:
      return {" rpm", 30 / std::numbers::pi};
    case base::Dimension::kAngle:
      return {"°", 180 / std::numbers::pi};
    default:
      return {};
  }
}

std::string Spaced(std::string_view key) {
  std::string text(key);
  std::ranges::replace(text, '_', ' ');
  return text;
}

// Collects the quantities that a Visit list names.
struct Quantities {
  std::string text{};

  void operator()(std::string_view key, double value, const base::FieldInfo& info = {}) {
    const BenchUnit unit = UnitOf(info.dimension);
    if (unit.text == nullptr || key == "plate_height") return;  // no heap depends on that
    text += (text.empty() ? ": " : ", ") + Spaced(key) + " " +
            base::ShortNumber(unit.per_unit * value) + unit.text;
  }
  void operator()(std::string_view key, const std::optional<double>& value,
                  const base::FieldInfo& info = {}) {
    if (value) (*this)(key, *value, info);
  }
  template <class Other>
  void operator()(std::string_view, const Other&, const base::FieldInfo& = {}) {}
};

}  // namespace

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
