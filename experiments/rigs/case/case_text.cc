#include "experiments/rigs/case/case_text.h"

#include <cmath>

#include "base/files/file.h"
#include "base/json/json_changes.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/number_text.h"

namespace talus::rigs {
namespace {

constexpr double kRounding = 1e-9;  // of grains that are equally large

bool IsNear(double a, double b) { return std::abs(a - b) <= kRounding * std::abs(b); }

// Whether two curves have one shape and size, at a few places.
bool AreEqual(const engine::SizeDistribution& a, const engine::SizeDistribution& b) {
  const engine::SizeCurve first(a);
  const engine::SizeCurve second(b);
  constexpr int kPlaces = 20;
  for (int i = 0; i <= kPlaces; ++i) {
    const double q = static_cast<double>(i) / kPlaces;
    if (!IsNear(first.VolumeQuantile(q), second.VolumeQuantile(q))) return false;
  }
  return true;
}

// The scale factor at which the powder here has the grains of the case there; nothing where its
// sizes have another shape, or where its surface energy goes with the scale factor.
std::optional<double> ScaleFactorOf(const Case& there, const Case& here) {
  const bool is_cohesive = here.models.adhesion != engine::Adhesion::kNone;
  if (is_cohesive && here.coarse_graining.surface_energy_exponent != 0) return std::nullopt;
  // A gap that is not stated goes with the sizes.
  if (here.rig.kind == RigKind::kSpreading && !here.rig.spreading.gap) return std::nullopt;
  const double ratio = engine::SizeCurve(there.powder.sizes).VolumeQuantile(0.5) /
                       engine::SizeCurve(here.powder.sizes).VolumeQuantile(0.5);
  if (!AreEqual(there.powder.sizes, engine::Enlarged(here.powder.sizes, ratio)))
    return std::nullopt;
  return ratio * there.coarse_graining.scale_factor;
}

// Grains of another size would have been poured at another rate, which goes with the true ones.
bool IsPouredAtItsGrainsRate(const Case& c) {
  return c.filling.kind == FillingKind::kPour && !c.filling.rate;
}

}  // namespace

std::string CaseText(const Case& rig_case) {
  return base::JsonText(base::ToJson(rig_case), 2) + "\n";
}

std::optional<std::string> RunDifference(const Case& there, const Case& here) {
  const auto run = [](Case c) {
    c.outputs = {};
    c.frame.reset();
    c.num_views = 1;
    c.threads = 1;
    c.checkpoint_interval = 0;
    return base::ToJson(c);
  };
  Case seen = there;
  std::optional<double> scale_factor;
  if (base::ToJson(there.powder.sizes) != base::ToJson(here.powder.sizes)) {
    scale_factor = ScaleFactorOf(there, here);
  }
  if (scale_factor) {  // then only that can tell the grains apart
    seen.powder.sizes = here.powder.sizes;
    seen.coarse_graining.scale_factor = here.coarse_graining.scale_factor;
  }
  const auto changes = base::JsonChanges(run(seen), run(here));
  if (!changes.empty()) {
    const base::JsonChange& first = changes.front();
    return first.path + " is " + first.before + " there and " + first.after + " here";
  }
  if (!scale_factor) return std::nullopt;
  if (IsPouredAtItsGrainsRate(here)) {
    return "its grains are of another size and came at their own rate, which no filling.rate "
           "states";
  }
  if (IsNear(*scale_factor, here.coarse_graining.scale_factor)) return std::nullopt;
  return "its grains are those of scale factor " + base::ShortNumber(*scale_factor, 6) + " here";
}

std::string RunText(const Case& rig_case) {
  Case relevant = rig_case;
  relevant.threads = 1;
  relevant.checkpoint_interval = 0;
  return CaseText(relevant);
}

std::uint64_t CaseHash(const Case& rig_case) { return base::Checksum(RunText(rig_case)); }

}  // namespace talus::rigs
