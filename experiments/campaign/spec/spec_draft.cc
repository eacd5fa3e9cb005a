#include "experiments/campaign/spec/spec_draft.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/problems.h"
#include "base/text/joined.h"
#include "base/text/key_text.h"
#include "base/text/number_text.h"
#include "base/units.h"
#include "experiments/campaign/spec/draft_plan.h"

namespace talus::campaign {
namespace {

constexpr const char* kHeapName = "heap";  // the photographed one's

double Read(const std::string& name, const std::string& text, base::Dimension dimension,
            base::Problems& problems) {
  try {
    const double value = base::ParseQuantity(text, dimension);
    problems.Require(value > 0, name, value, "must be positive");
    return value;
  } catch (const base::ConfigError& error) {
    problems.Add(name, error.what());
    return 1;
  }
}

std::string Quoted(const std::string& text) { return base::JsonText(nlohmann::json(text)); }

// 0.9 as it is, "90 %" as the text that it is.
std::string NumberOrText(const std::string& text) {
  return nlohmann::json::parse(text, nullptr, false).is_number() ? text : Quoted(text);
}

std::string MissingViews(const SpecAnswers& answers) {
  if (answers.missing.empty()) return "";
  return "    // " + answers.missing +
         ": true goes on without them and\n    // without photographs that cannot be used, and "
         "says which; false refuses both\n    \"allow_missing_views\": true,\n";
}

std::string Photographs(const SpecAnswers& answers) {
  if (answers.runs.empty()) {
    return "    \"photos\": " + Quoted(answers.folder.string()) +
           ",\n    // {run} is the heap, {view} the direction it was photographed from; * is "
           "anything\n    \"pattern\": " +
           Quoted(answers.pattern) + ",\n" + MissingViews(answers);
  }
  std::string text =
      "    // a run a heap; add one for each further heap of the same powder\n"
      "    \"runs\": [";
  for (std::size_t i = 0; i < answers.runs.size(); ++i) {
    text += (i == 0 ? "{\"name\": " : ",\n             {\"name\": ") +
            Quoted(answers.runs[i].name) + ", \"photos\": [";
    const char* separator = "";
    for (const auto& photo : answers.runs[i].photos) {
      text += separator + Quoted(photo.string());
      separator = ", ";
    }
    text += "]}";
  }
  return text + "],\n" + MissingViews(answers);
}

// The largest surface energy that is searched [J/m²]: the published fine metal powders lie below
// it, and coarse moist grains below a Bond number of 10,
//
//   Bo = 4πγR* / (m g),  R* = d/4,  m = πρd³/6:  γ = Bo ρ g d² / 6
//
// with one digit, upwards.
double MostSurfaceEnergy(double diameter, double density) {
  constexpr double kFinePowders = 8e-4;
  constexpr double kBond = 10;
  constexpr double kGravity = 9.81;  // [m/s²]
  const double moist = kBond * density * kGravity * diameter * diameter / 6;
  if (moist <= kFinePowders) return kFinePowders;
  const double digit = std::pow(10.0, std::floor(std::log10(moist)));
  return std::ceil(moist / digit) * digit;
}

// Tabor's number of two like grains: (R* w² / (Y*² z₀³))^(1/3), w = 2γ. Below 0.1 adhesion acts as
// DMT has it, above 5 as JKR does. The stiffness is the real one, not what is simulated to save
// steps.
double TaborNumber(double diameter, double surface_energy) {
  constexpr double kStiffness = 70e9;  // of metals and minerals, Y [Pa]
  constexpr double kPoissonRatio = 0.3;
  constexpr double kSpacing = 4e-10;  // of atoms, z₀ [m]
  const double y_star = kStiffness / (2 * (1 - kPoissonRatio * kPoissonRatio));
  const double work = 2 * surface_energy;
  return std::cbrt(diameter / 4 * work * work / (y_star * y_star * std::pow(kSpacing, 3)));
}

// What the adhesion of cohesive grains is begun with.
struct Cohesion {
  double most_surface_energy;  // [J/m²]
  double tabor;                // Tabor's number there [-]
};

Cohesion CohesionOf(double diameter, const std::string& density) {
  const double most =
      MostSurfaceEnergy(diameter, base::ParseQuantity(density, base::Dimension::kDensity));
  return {.most_surface_energy = most, .tabor = TaborNumber(diameter, most)};
}

std::string Models(bool cohesive, const Cohesion& cohesion) {
  if (!cohesive) {
    return "  // docs/physics.md. Dry grains; \"dmt\" or \"jkr\" for cohesive ones, with a range "
           "of "
           "surface_energy below\n"
           "  \"models\": {\"adhesion\": \"none\", \"rolling\": \"epsd\"},\n";
  }
  const bool dmt = cohesion.tabor < 1;
  return "  // Cohesive grains, poured: filled densely they may stand where poured ones slump. "
         "Adhesion is " +
         std::string(dmt ? "dmt" : "jkr") + ":\n  // Tabor's number of such grains of 70 GPa is " +
         base::ShortNumber(cohesion.tabor, 2) +
         " at the largest surface_energy below; dmt holds below\n  // 0.1, jkr above 5. Soft or "
         "moist "
         "grains: \"jkr\". Dry ones: \"none\", without surface_energy\n"
         "  \"filling\": {\"kind\": \"pour\"},\n"
         "  \"models\": {\"adhesion\": \"" +
         (dmt ? "dmt" : "jkr") + "\", \"rolling\": \"epsd\"},\n";
}

// A value that is not known is searched: an answer may hang on it.
std::string Nuisances(const SpecAnswers& answers) {
  std::string text;
  const auto add = [&](const std::string& answer, const std::string& entry) {
    if (answer.empty()) text += ",\n    " + entry;
  };
  add(answers.restitution, R"("restitution": {"min": 0.3, "max": 0.95, "nuisance": true})");
  add(answers.rolling_damping,
      R"("rolling_damping": {"min": 0.05, "max": 1, "scale": "log", "nuisance": true})");
  if (text.empty()) return text;
  return ",\n    // What nobody has measured: searched, not asked for. The answer says whether "
         "it matters." +
         text.substr(1);
}

std::string Searched(const SpecAnswers& answers, const Cohesion& cohesion) {
  std::string text =
      "  // What is searched, and where. A parameter that you have measured: {\"fixed\": 0.4}.\n"
      "  \"parameters\": {\n"
      "    \"sliding_friction\": {\"min\": 0.05, \"max\": 0.9},\n"
      "    \"rolling_friction\": {\"min\": 0.005, \"max\": 0.6}";
  if (answers.cohesive) {
    text += ",\n    \"surface_energy\": {\"min\": \"1e-6 J/m^2\", \"max\": \"" +
            base::ShortNumber(cohesion.most_surface_energy) +
            " J/m^2\", "
            "\"scale\": \"log\"}";
  }
  return text + Nuisances(answers) + "\n  },\n";
}

// The median diameter of the grains [m]. Throws ConfigError with every quantity that cannot be.
double CheckedGrain(const SpecAnswers& answers) {
  using base::Dimension;
  base::Problems problems;
  const auto read_device = [&](const std::string& flag, const std::string& text, Dimension d) {
    if (answers.HasPhotographs() || !text.empty()) Read(flag, text, d, problems);
  };
  read_device("--plate-diameter", answers.plate_diameter, Dimension::kLength);
  read_device("--tube-diameter", answers.tube_diameter, Dimension::kLength);
  read_device("--lift-velocity", answers.lift_velocity, Dimension::kVelocity);
  Read("--mass", answers.mass, Dimension::kMass, problems);
  Read("--density", answers.density, Dimension::kDensity, problems);
  const double grain =
      Read("--grain-diameter", answers.grain_diameter, Dimension::kLength, problems);
  if (!answers.restitution.empty()) {
    const double e = Read("--restitution", answers.restitution, Dimension::kNone, problems);
    problems.Require(e <= 1, "--restitution", e, "must be in (0, 1]");
  }
  if (!answers.rolling_damping.empty()) {
    Read("--rolling-damping", answers.rolling_damping, Dimension::kNone, problems);
  }
  problems.ThrowIfAny();
  return grain;
}

std::string ScaleOf(const SpecAnswers& answers) {
  const std::string plate = "    \"plate_diameter\": " + Quoted(answers.plate_diameter);
  if (answers.scale.empty()) return plate + " // the scale of the photographs\n";
  return plate + ", // the part of the table that counts, as wide as the simulated plate\n" +
         "    \"scale\": " + Quoted(answers.scale) +
         " // two points in pixels, and their distance\n";
}

// Their own, or those of their rigs: "drum", "drum 2", as results tell them apart by name.
std::vector<std::string> NamesOfTests(const SpecAnswers& answers) {
  std::set<std::string> taken;
  if (answers.HasPhotographs()) taken.insert(kHeapName);
  for (const DraftTest& test : answers.tests) taken.insert(test.Answer("name"));
  std::vector<std::string> names;
  for (const DraftTest& test : answers.tests) {
    names.push_back(test.Answer("name"));
    if (!names.back().empty()) continue;
    const std::string usual = base::Spaced(base::NameOf(test.kind));
    names.back() = usual;
    for (int i = 2; !taken.insert(names.back()).second; ++i) {
      names.back() = usual + " " + std::to_string(i);
    }
  }
  return names;
}

// The heap alone, or with the other tests of the powder, which one parameter set is to meet; or
// these alone.
std::string Experiments(const SpecAnswers& answers) {
  const bool has_heap = answers.HasPhotographs();
  const std::string heap = has_heap ? Photographs(answers) + ScaleOf(answers) : "";
  if (answers.tests.empty()) return "  \"experiment\": {\n" + heap + "  },\n";
  std::string text = "  \"experiments\": [\n";
  const char* separator = "";
  if (has_heap) {
    text += "    {\"name\": " + Quoted(std::string(kHeapName)) + ",\n" + heap + "    }";
    separator = ",\n";
  }
  const std::vector<std::string> names = NamesOfTests(answers);
  for (std::size_t i = 0; i < answers.tests.size(); ++i) {
    const DraftTest& test = answers.tests[i];
    text += separator + DraftTestText(test, {.name = names[i],
                                             .questions = QuestionsOf(test.kind, answers),
                                             .pours = answers.cohesive});
    separator = ",\n";
  }
  return text + "\n  ],\n";
}

// A drum's fill is in place of a mass, which is not given beside it where no test takes it.
std::string MassText(const SpecAnswers& answers) {
  const auto has = [](const char* key) {
    return [key](const DraftTest& test) { return !test.Answer(key).empty(); };
  };
  const bool is_taken =
      answers.HasPhotographs() || std::ranges::any_of(answers.tests, [&](const DraftTest& test) {
        return !has("mass")(test) && !has("fill")(test);
      });
  if (!is_taken && std::ranges::any_of(answers.tests, has("fill"))) return "";
  return ",\n    \"mass\": " + Quoted(answers.mass) +
         (answers.HasPhotographs() ? " // filled into the tube"
                                   : " // filled into each test that has no mass of its own");
}

std::string Powder(const SpecAnswers& answers) {
  return "  \"powder\": {\n    \"material\": {\n      \"density\": " + Quoted(answers.density) +
         ", // of the grains, not of the bulk\n"
         "      \"youngs_modulus\": \"10 MPa\", // softer than real for longer time steps; what a "
         "heap "
         "notices: docs/validation.md, Softness\n"
         "      \"poisson_ratio\": 0.3" +
         (answers.restitution.empty()
              ? ""
              : ",\n      \"restitution\": " + NumberOrText(answers.restitution)) +
         (answers.rolling_damping.empty()
              ? ""
              : ",\n      \"rolling_damping\": " + NumberOrText(answers.rolling_damping)) +
         "\n    },\n"
         "    // a measured distribution makes a better powder: size tables in docs/scene.md\n"
         "    \"sizes\": {\"kind\": \"mono\", \"diameter\": " +
         Quoted(answers.grain_diameter) + "}" + MassText(answers) + "\n  },\n";
}

std::string Device(const SpecAnswers& answers) {
  if (!answers.HasPhotographs()) return "";
  return "  \"device\": {\n    \"tube_inner_diameter\": " + Quoted(answers.tube_diameter) +
         ",\n    \"plate_diameter\": " + Quoted(answers.plate_diameter) +
         ",\n    \"plate\": \"disc\",\n    \"lift_velocity\": " + Quoted(answers.lift_velocity) +
         "\n  },\n";
}

std::string CoarseGraining(const SpecAnswers& answers, const DraftPlan& plan) {
  return std::string("  // Grains so many times larger than real") +
         (answers.HasPhotographs() ? ". The last decides and should leave 30 across the plate"
                                   : ": the cost falls with the fourth power") +
         (plan.is_held ? ".\n  // Larger ones would not pass an opening of a test, or not fit into "
                         "its vessel.\n"
                       : ".\n") +
         "  \"coarse_graining\": {\"scale_factors\": [" +
         base::Joined(plan.scale_factors, ", ",
                      [](double factor) { return base::ShortNumber(factor); }) +
         "]},\n";
}

std::string Budget(const DraftPlan& plan) {
  return "  // at most; add \"core_time\": \"4 h\" for an evening\n"
         "  \"budget\": {\"simulations\": " +
         std::to_string(plan.simulations) + "},\n";
}

std::string TextWith(const DraftPlan& plan, const SpecAnswers& answers, const Cohesion& cohesion) {
  const std::string experiments = Experiments(answers);  // first: it says where an answer is wrong
  return "// " + answers.name +
         ": a first spec, written by `talus init`. `talus validate` says what it will cost,\n"
         "// `talus calibrate` runs it. Comments may stay; docs/campaigns.md has every key.\n"
         "{\n  \"name\": " +
         Quoted(answers.name) + ",\n" + experiments + Powder(answers) + Device(answers) +
         Models(answers.cohesive, cohesion) + CoarseGraining(answers, plan) +
         Searched(answers, cohesion) +
         (answers.HasPhotographs() ? "  \"objective\": \"sad\",\n" : "") + Budget(plan) +
         "  \"confirm\": {\"candidates\": 1, \"replicates\": 3},\n  \"seed\": 1\n}\n";
}

}  // namespace

std::string DraftSpec(const SpecAnswers& answers) {
  const double grain = CheckedGrain(answers);
  const Cohesion cohesion = CohesionOf(grain, answers.density);
  if (!answers.HasPhotographs() && answers.tests.empty()) {
    throw base::ConfigError(
        "there is nothing to calibrate on: give photographs of a heap, or what a test has "
        "measured with --test");
  }
  return TextWith(PlanOf(TextWith({}, answers, cohesion)), answers, cohesion);
}

}  // namespace talus::campaign
