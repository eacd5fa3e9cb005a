#include "experiments/campaign/spec/agreeing_numbers.h"

#include <cmath>

#include "base/text/number_text.h"
#include "experiments/campaign/spec/known_number.h"

namespace talus::campaign {
namespace {

using rigs::Observable;

// Beyond the errors: numbers are stated with few digits, and a balance is that good.
constexpr double kRounding = 0.02;

bool AreOne(const KnownNumber& a, const KnownNumber& b) {
  return std::abs(a.value - b.value) <=
         kContradiction * std::hypot(a.error, b.error) + kRounding * std::abs(b.value);
}

class AgreementChecker {
 public:
  AgreementChecker(const ExperimentSpec& experiment, const Surroundings& around,
                   base::Problems& problems)
      : e_(experiment), numbers_(experiment.numbers), around_(around), problems_(problems) {}

  void Densities() {
    const auto tapped = KnownOf<Observable::kTappedDensity>(numbers_);
    const auto poured = KnownOf<Observable::kPouredDensity>(numbers_);
    const auto hausner = KnownOf<Observable::kHausnerRatio>(numbers_);
    const auto solid = KnownOf<Observable::kTappedSolidFraction>(numbers_);
    if (!tapped || !(tapped->value > 0)) return;
    if (hausner && poured && poured->value > 0) {
      Require("hausner_ratio", *hausner, Ratio(*tapped, *poured),
              "tapped_density over poured_density");
    }
    if (solid && around_.grain_density && *around_.grain_density > 0) {
      Require("tapped_solid_fraction", *solid, Ratio(*tapped, {*around_.grain_density}),
              "tapped_density over that of the grains (powder.material.density)");
    }
  }

  // Where an arch stands nothing runs; the rate of that is 0, and a time there is none.
  void Flow() {
    const auto flows = KnownOf<Observable::kFlows>(numbers_);
    const auto rate = KnownOf<Observable::kDischargeRate>(numbers_);
    if (!flows) return;
    const bool runs = rate && rate->value > kContradiction * rate->error;
    const bool has_time = numbers_.Of<Observable::kDischargeTime>().has_value();
    problems_.Require(flows->value > 0 || !runs, Key("flows"),
                      "is 0, so that an arch stands, beside a discharge_rate above 0: one of the "
                      "two is wrong");
    problems_.Require(flows->value > 0 || !has_time, Key("flows"),
                      "is 0, so that an arch stands, beside a discharge_time: leave one of the two "
                      "out");
    problems_.Require(!(flows->value == 1) || !rate || rate->value > 0, Key("discharge_rate"),
                      "is 0 beside flows 1: one of the two is wrong");
  }

  void Masses() {
    const auto fallen = KnownOf<Observable::kMassFallen>(numbers_);
    Sum("mass_on_plate", KnownOf<Observable::kMassOnPlate>(numbers_), "mass_fallen", fallen);
    Sum("mass_left", KnownOf<Observable::kMassLeft>(numbers_), "mass_fallen", fallen);
  }

  // A funnel that stands still stops the heap, which grows into its outlet.
  void HeapUnderFunnel() {
    const auto height = KnownOf<Observable::kHeight>(numbers_);
    const bool is_fixed =
        rigs::KindOf(e_.rig) == rigs::RigKind::kFunnelHeap && !e_.rig->funnel_heap.follows;
    if (!height || !is_fixed) return;
    const double outlet = e_.rig->funnel_heap.height;
    problems_.Require(
        height->value - kContradiction * height->error <= (1 + kRounding) * outlet, Key("height"),
        height->value,
        "in m, is above the funnel's outlet, which stands " + base::ShortNumber(1e3 * outlet) +
            " mm over the plate (rig.height): correct one of the two, or say that the funnel is "
            "led up with the heap (\"follows\": true)");
  }

 private:
  std::string Key(const std::string& key) const { return around_.prefix + key; }

  void Require(const std::string& key, const KnownNumber& stated, const KnownNumber& follows,
               const std::string& from) {
    problems_.Require(AreOne(stated, follows), Key(key), stated.value,
                      "but " + from + " is " + base::ShortNumber(follows.value) +
                          ": one of them is wrong, or of another powder");
  }

  void Sum(const std::string& key, const std::optional<KnownNumber>& one,
           const std::string& other_key, const std::optional<KnownNumber>& other) {
    if (!one || !other || !(around_.filled > 0)) return;
    const double sum = one->value + other->value;
    const double most =
        (1 + kRounding) * around_.filled + kContradiction * std::hypot(one->error, other->error);
    // One that is more than all by itself is said already.
    if (std::max(one->value, other->value) > (1 + kRounding) * around_.filled) return;
    problems_.Require(sum <= most, Key(key),
                      "and " + other_key + " are " + base::ShortNumber(1e3 * sum) +
                          " g together, more than the " + base::ShortNumber(1e3 * around_.filled) +
                          " g filled in (" + around_.filled_by + ")");
  }

  const ExperimentSpec& e_;
  const MeasuredNumbers& numbers_;
  const Surroundings& around_;
  base::Problems& problems_;
};

}  // namespace

void RequireAgreeing(const ExperimentSpec& experiment, const Surroundings& around,
                     base::Problems& problems) {
  AgreementChecker checker(experiment, around, problems);
  checker.Densities();
  checker.Flow();
  checker.Masses();
  checker.HeapUnderFunnel();
}

}  // namespace talus::campaign
