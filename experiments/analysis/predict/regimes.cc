#include "experiments/analysis/predict/regimes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/median.h"
#include "base/text/plain_number.h"
#include "engine/bodies/particle.h"
#include "engine/laws/material_pair.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/rigs/case/run_files.h"

namespace talus::analysis {
namespace {

constexpr double kBeyond = 3;  // a factor that friction laws are seen to change over

std::vector<double> Medians(const std::vector<rigs::Regime>& runs,
                            rigs::RegimeRange rigs::Regime::*range) {
  std::vector<double> medians;
  for (std::size_t q = 0; q < rigs::RegimeRange{}.size(); ++q) {
    std::vector<double> values;
    for (const rigs::Regime& run : runs) values.push_back((run.*range)[q]);
    medians.push_back(base::Median(std::move(values)));
  }
  return medians;
}

// For two equal grains: γ* = 2γ and R* = d/4 (docs/physics.md, A1 and A4).
double PullOff(const rigs::Case& rig_case, double diameter) {
  const engine::Material grains =
      engine::With(rig_case.powder.material, rigs::StatedWith(rig_case.pairs, rigs::kPowder));
  const double plain = std::numbers::pi * grains.surface_energy * diameter;
  switch (rig_case.models.adhesion) {
    case engine::Adhesion::kDmt:
      return plain;
    case engine::Adhesion::kJkr:
      return 0.75 * plain;
    case engine::Adhesion::kNone:
      break;
  }
  return 0;
}

double ContactDuration(const engine::Material& m, double diameter, double speed) {
  const double mass = engine::SphereMass(m, diameter / 2) / 2;
  const double modulus = m.youngs_modulus / (2 * (1 - m.poisson_ratio * m.poisson_ratio));
  return 2.87 * std::pow(mass * mass / (diameter / 4 * modulus * modulus * speed), 0.2);
}

// One quantity of the process beside the same of the tests.
struct Compared {
  std::vector<double> (*range)(const FlowRegime&);  // 5, 50, 95 %
  const char* what;
  const char* unit = "";
  double least = 0;  // below it the process does not care
};

// A collision that lasts a tenth of the time in which its neighbourhood shears by a grain.
constexpr double kSoft = 0.1;

constexpr Compared kCompared[] = {
    {[](const FlowRegime& r) { return r.inertial_number; }, "an inertial number"},
    {[](const FlowRegime& r) { return r.pressure; }, "a pressure", " Pa"},
    {[](const FlowRegime& r) { return std::vector(3, r.bond_number); }, "a Bond number"},
    {[](const FlowRegime& r) { return r.contact_duration; }, "a contact duration × shear rate", "",
     kSoft}};

std::string WarningOf(const Compared& compared, const FlowRegime& process,
                      const std::vector<FlowRegime>& regimes) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0;
  for (const FlowRegime& test : regimes) {
    if (test.is_process) continue;
    const std::vector<double> range = compared.range(test);
    low = std::min(low, range.front());
    high = std::max(high, range.back());
  }
  const double there = compared.range(process)[1];
  if (!(there >= compared.least)) return "";
  const bool above = high > 0 && there > kBeyond * high;
  if (!above && !(there * kBeyond < low && std::isfinite(low))) return "";
  return process.name + " shears at " + compared.what + " of " + base::PlainNumber(there, 2) +
         compared.unit + ", your tests " +
         (above ? "at most at " + base::PlainNumber(high, 2)
                : "at least at " + base::PlainNumber(low, 2)) +
         compared.unit + ": what the sets give there was not tested";
}

}  // namespace

std::optional<rigs::Regime> RegimeIn(const std::filesystem::path& trial) {
  const std::filesystem::path file = trial / rigs::kResultFile;
  if (!std::filesystem::exists(file)) return std::nullopt;
  const auto json =
      nlohmann::json::parse(base::IfWhole(base::ReadFile(file)).value_or(""), nullptr, false);
  if (!json.is_object() || !json.contains("regime")) return std::nullopt;
  const nlohmann::json& regime = json["regime"];
  return rigs::Regime{.inertial_number = regime.at("inertial_number").get<rigs::RegimeRange>(),
                      .pressure = regime.at("pressure_Pa").get<rigs::RegimeRange>(),
                      .shear_rate = regime.at("shear_rate_per_s").get<rigs::RegimeRange>()};
}

FlowRegime DescribeRegime(const std::string& name, const std::vector<rigs::Regime>& runs,
                          const rigs::Case& rig_case) {
  const double scale = rig_case.coarse_graining.scale_factor;
  const double diameter = rigs::EstimatePowder(rig_case).mean_diameter / scale;
  const engine::Material& material = rig_case.powder.material;
  FlowRegime described{
      .name = name,
      .inertial_number = Medians(runs, &rigs::Regime::inertial_number),
      .pressure = Medians(runs, &rigs::Regime::pressure),
      .shear_rate = Medians(runs, &rigs::Regime::shear_rate),
      .bond_number = PullOff(rig_case, diameter) /
                     (engine::SphereMass(material, diameter / 2) * rig_case.gravity)};
  for (double& i : described.inertial_number) i /= scale;
  for (const double rate : described.shear_rate) {
    described.contact_duration.push_back(rate *
                                         ContactDuration(material, diameter, rate * diameter));
  }
  return described;
}

double NearestScaleFactor(const std::vector<double>& of_campaign, double of_process) {
  return *std::ranges::min_element(of_campaign, {},
                                   [=](double f) { return std::abs(std::log(f / of_process)); });
}

std::vector<std::string> RegimeWarnings(const std::vector<FlowRegime>& regimes) {
  std::vector<std::string> warnings;
  const auto process = std::ranges::find_if(regimes, &FlowRegime::is_process);
  if (process == regimes.end()) return warnings;
  for (const Compared& compared : kCompared) {
    const std::string warning = WarningOf(compared, *process, regimes);
    if (!warning.empty()) warnings.push_back(warning);
  }
  return warnings;
}

}  // namespace talus::analysis
