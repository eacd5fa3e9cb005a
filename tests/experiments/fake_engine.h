// Trials that are drawn in place of simulated: an engine whose program has nothing left to do.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "base/text/joined.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/load_case.h"
#include "experiments/trials/engines/trial_engine.h"
#include "tests/experiments/drawn_heap.h"

namespace talus::campaign {

struct FakeEngineOptions {
  bool die_once = false;              // every third trial is ended by SIGKILL when it is run first
  bool fail_at_low = false;           // no heap below μ_t = 0.3
  bool fail_fast_at_low = false;      // the same, where the tube is lifted fast
  bool fail_fast = false;             // no heap at all, where the tube is lifted fast
  bool fail_once = false;             // every trial's first seed fails
  int fail_first = 0;                 // so many trials fail
  bool seed_in_reason = false;        // every trial fails, and quotes its seed in two lines
  bool film_grows = false;            // the pictures of a film are not all the same
  double sleep = 0;                   // of each trial [s]
  int slow_third = 0;                 // 1 to 3: of each three trials this one takes longer
  bool no_command = false;            // the program is not there
  bool disk_full = false;             // every trial's program finds the disk full, and says so
  bool vanish = false;                // every trial's folder is taken away while it runs
  int hang_at = 0;                    // the trial with this id never ends; none if 0
  bool no_numbers = false;            // the masses and densities are not there
  bool undefined = false;             // … or have no value
  double restitution_as_rolling = 0;  // a lower restitution acts as so many times more μ_r
  double restitution_times_rolling = 0;  // a loss of 1 acts as so many times μ_r more
  double mass_scatter = 1e-6;            // of the mass fallen, from seed to seed [kg]
  double density_scatter = 4;            // of the tapped density, from seed to seed [kg/m³]
  double density_by_scale = 0;           // that it gains for each 1 of the scale factor [kg/m³]

  bool operator==(const FakeEngineOptions&) const = default;
};

class FakeEngine : public trials::TrialEngine {
 public:
  explicit FakeEngine(const FakeEngineOptions& options) : options_(options) {}

  // The command of a trial to which nothing happens.
  static std::vector<std::string> Shown() { return {"mv", "drawn.png", "profile.png"}; }

  void Prepare(const rigs::Case& rig_case, const std::filesystem::path& folder) override {
    trials::PrepareFolder(folder, "case.json", rigs::CaseText(rig_case));
    const engine::Material& m = rig_case.powder.material;
    const auto seed = rig_case.seed;
    const double rolling =
        m.rolling_friction + (options_.restitution_as_rolling +
                              options_.restitution_times_rolling * m.rolling_friction) *
                                 (0.9 - m.restitution);
    const int num_pictures = rig_case.frame ? rigs::ProfileFrameOf(rig_case).num_pictures() : 1;
    imaging::WritePng(folder / "drawn.png", DrawFilm(m.sliding_friction, rolling, seed,
                                                     num_pictures, options_.film_grows));
    std::string script;
    if (options_.sleep > 0) script += "sleep " + std::to_string(options_.sleep) + "\n";
    if (options_.slow_third > 0 && std::stoi(folder.filename()) % 3 + 1 == options_.slow_third) {
      script += "sleep 0.1\n";
    }
    if (options_.hang_at > 0 && std::stoi(folder.filename()) == options_.hang_at) {
      script = "sleep 3600\n";
    }
    if (options_.die_once && seed % 3 == 0) {
      script += "if [ ! -e died ]; then touch died; kill -9 $$; fi\n";
    }
    constexpr double kFast = 0.1;  // [m/s]
    const bool is_fast = rig_case.rig.lifted_tube.lift_velocity > kFast;
    const bool fails_at_low = options_.fail_at_low || (options_.fail_fast_at_low && is_fast);
    const bool fails =
        (fails_at_low && m.sliding_friction < 0.3) || (options_.fail_fast && is_fast);
    if (fails) script += "echo no heap >&2; exit 3\n";
    if (std::stoi(folder.filename()) <= options_.fail_first) script += "exit 5\n";
    if (options_.seed_in_reason)
      script += "echo seed " + std::to_string(seed) + "; echo lost atoms; exit 4\n";
    const auto marker = folder.parent_path() / (folder.filename().string() + "_failed");
    if (options_.fail_once && !std::filesystem::exists(marker)) {
      script += "touch " + marker.string() + "; exit 4\n";
    }
    if (options_.disk_full) script += "echo heap.png: No space left on device >&2\nexit 1\n";
    if (options_.vanish) script += "rm -r \"$PWD\"\n";
    std::filesystem::remove(folder / kScript);  // of a session that was killed
    if (script.empty()) return;
    std::ofstream(folder / kScript) << script << "exec " << base::Joined(Shown(), " ") << "\n";
  }
  bool IsPrepared(const rigs::Case& rig_case, const std::filesystem::path& folder) override {
    return trials::HoldsKey(folder, "case.json", rigs::CaseText(rig_case));
  }
  std::vector<std::string> Command(const std::filesystem::path& folder) override {
    if (options_.no_command) return {"talus-no-such-program"};
    if (std::filesystem::exists(folder / kScript)) return {"sh", kScript};
    return Shown();
  }
  bool IsComplete(const std::filesystem::path& folder) override {
    return std::filesystem::exists(folder / "profile.png");
  }
  trials::TrialOutput Collect(const rigs::Case& rig_case,
                              const std::filesystem::path& folder) override {
    trials::TrialOutput output = CollectAll(rig_case, folder);
    if (options_.no_numbers) output.scalars.clear();
    for (journal::MetricRecord& number : output.scalars) {
      if (options_.undefined)
        number = {.name = number.name, .unit = number.unit, .undefined = "it is stuck"};
    }
    return output;
  }
  trials::TrialOutput CollectAll(const rigs::Case& rig_case, const std::filesystem::path& folder) {
    const rigs::CaseSize size = rigs::EstimateCase(rig_case);
    const engine::Material& m = rig_case.powder.material;
    if (rig_case.rig.kind == rigs::RigKind::kTappedDensity) {
      return {.profile = {},
              .num_steps = 100000,
              .num_particles = size.num_grains,
              .scalars = {{.name = "tapped_density_kg_per_m3",
                           .value = TappedDensity(m.rolling_friction, options_.density_scatter,
                                                  rig_case.seed) +
                                    options_.density_by_scale *
                                        (rig_case.coarse_graining.scale_factor - 1),
                           .unit = "kg/m3",
                           .undefined = ""}},
              .note = ""};
    }
    return {
        .profile = imaging::ReadGrayImage(folder / "profile.png"),
        .num_steps = std::llround(size.simulated_time / size.time_step),
        .num_particles = size.num_grains,
        .scalars = {{.name = "mass_fallen_kg",
                     .value = FallenMass(m.sliding_friction, options_.mass_scatter, rig_case.seed),
                     .unit = "kg",
                     .undefined = ""}},
        .note = ""};
  }

  std::optional<std::string> WhyNotTaken(const rigs::Case& rig_case,
                                         const std::filesystem::path& from) override {
    return rigs::RunDifference(rigs::LoadCase(from / "case.json"), rig_case);
  }
  bool TakeOver(const rigs::Case& rig_case, const std::filesystem::path& from,
                const std::filesystem::path& to) override {
    if (WhyNotTaken(rig_case, from)) return false;
    trials::CopyFolder(from, to);
    std::ofstream(to / "case.json") << rigs::CaseText(rig_case);
    return true;
  }

 private:
  static constexpr const char* kScript = "run.sh";

  FakeEngineOptions options_;
};

}  // namespace talus::campaign
