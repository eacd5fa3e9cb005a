// A campaign without simulations: heaps are drawn, in a millisecond, from the parameters and the
// seed. For the tests of everything that goes on round a simulation.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/json/json_file.h"
#include "base/random.h"
#include "experiments/campaign/make_parts.h"
#include "experiments/campaign/start.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/load_case.h"
#include "experiments/runners/local_runner.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/film_strip.h"

namespace talus::campaign {

inline constexpr double kTrueSliding = 0.45;
inline constexpr double kTrueRolling = 0.2;

inline imaging::Frame FakeFrame() {
  return {.width = 120,
          .height = 80,
          .pixel_size = 1e-4,
          .center_x = 60,
          .baseline = 76,
          .plate_diameter = 0.01};
}

// A cone whose slope follows μ_r, cut off at a height that follows μ_t; both scatter by the seed.
// `grown`: the share of its height that it has so far.
inline imaging::GrayImage DrawHeap(double sliding, double rolling, std::uint64_t seed,
                                   double grown = 1) {
  const imaging::Frame frame = FakeFrame();
  base::Random random(seed, base::Stream("fake heap"));
  const double slope = 0.2 + rolling + 0.01 * random.Normal();
  const double cap = 2 + 20 * sliding + 0.3 * random.Normal();
  imaging::GrayImage image{.width = frame.width, .height = frame.height, .pixels = {}};
  image.pixels.assign(static_cast<std::size_t>(frame.width * frame.height), 255);
  for (int x = 10; x < 110; ++x) {
    const double height = grown * std::min(cap, slope * (50 - std::abs(x + 0.5 - 60)));
    for (int y = 0; y < 76; ++y) {
      const double powder = std::clamp(height - (75 - y), 0.0, 1.0);
      image.at(x, y) = static_cast<std::uint8_t>(std::lround(255 * (1 - powder)));
    }
  }
  return image;
}

// A film of one heap: as it grows, or the same picture again and again.
inline imaging::GrayImage DrawFilm(double sliding, double rolling, std::uint64_t seed,
                                   int num_pictures, bool grows) {
  std::vector<imaging::GrayImage> pictures;
  for (int i = 1; i <= num_pictures; ++i) {
    pictures.push_back(
        DrawHeap(sliding, rolling, seed, grows ? static_cast<double>(i) / num_pictures : 1));
  }
  return imaging::SideBySide(pictures);
}

// [kg] that falls over the rim: less the more the grains rub.
inline double FallenMass(double sliding, double scatter, std::uint64_t seed) {
  base::Random random(seed, base::Stream("fake balance"));
  return 1e-6 * (50 - 60 * sliding) + scatter * random.Normal();
}

// [kg/m³] after taps: less the more the grains resist rolling.
inline double TappedDensity(double rolling, double scatter, std::uint64_t seed) {
  base::Random random(seed, base::Stream("fake taps"));
  return 1550 - 350 * rolling + scatter * random.Normal();
}

struct FakeEngineOptions {
  bool die_once = false;              // every third trial is ended by SIGKILL when it is run first
  bool fail_at_low = false;           // no heap below μ_t = 0.3
  bool fail_fast_at_low = false;      // the same, where the tube is lifted fast
  bool fail_once = false;             // every trial's first seed fails
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
    if (std::stoi(folder.filename()) % 3 + 1 == options_.slow_third) script += "sleep 0.1\n";
    if (options_.hang_at > 0 && std::stoi(folder.filename()) == options_.hang_at) {
      script = "sleep 3600\n";
    }
    if (options_.die_once && seed % 3 == 0) {
      script += "if [ ! -e died ]; then touch died; kill -9 $$; fi\n";
    }
    constexpr double kFast = 0.1;  // [m/s]
    const bool fails = options_.fail_at_low || (options_.fail_fast_at_low &&
                                                rig_case.rig.lifted_tube.lift_velocity > kFast);
    if (fails && m.sliding_friction < 0.3) script += "echo no heap >&2; exit 3\n";
    if (options_.seed_in_reason)
      script += "echo seed " + std::to_string(seed) + "; echo lost atoms; exit 4\n";
    const auto marker = folder.parent_path() / (folder.filename().string() + "_failed");
    if (options_.fail_once && !std::filesystem::exists(marker)) {
      script += "touch " + marker.string() + "; exit 4\n";
    }
    if (options_.disk_full) script += "echo heap.png: No space left on device >&2\nexit 1\n";
    if (options_.vanish) script += "rm -r \"$PWD\"\n";
    if (!script.empty()) std::ofstream(folder / "run.sh") << script << "exec mv drawn.png profile.png\n";
  }
  bool IsPrepared(const rigs::Case& rig_case, const std::filesystem::path& folder) override {
    return trials::HoldsKey(folder, "case.json", rigs::CaseText(rig_case));
  }
  std::vector<std::string> Command(const std::filesystem::path& folder) override {
    if (options_.no_command) return {"talus-no-such-program"};
    if (std::filesystem::exists(folder / "run.sh")) return {"sh", "run.sh"};
    return {"mv", "drawn.png", "profile.png"};
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
  FakeEngineOptions options_;
};

// spec.json and the experiment's map in `folder`; `more` are further members of the spec.
inline std::filesystem::path WriteFakeSpec(const std::filesystem::path& folder,
                                           const std::string& more) {
  std::filesystem::create_directories(folder);
  imaging::WritePng(folder / "map.png", DrawHeap(kTrueSliding, kTrueRolling, 12345));
  std::ofstream(folder / "spec.json") << R"({
  "name": "fake",
  "experiment": {"map": "map.png", "plate_diameter": "10 mm",
    "frame": {"width_px": 120, "height_px": 80, "pixel_size": "0.1 mm", "center_x_px": 60,
              "baseline_px": 76, "plate_diameter": "10 mm"}},
  "powder": {"material": {"density": 2500},
             "sizes": {"kind": "mono", "diameter": "0.4 mm"}, "mass": "0.5 g"},
  "parameters": {"sliding_friction": {"min": 0.1, "max": 0.8},
                 "rolling_friction": {"min": 0.05, "max": 0.5}})"
                                      << more << "\n}\n";
  return folder / "spec.json";
}

// One session of a campaign with drawn heaps.
inline CampaignEnd RunFake(const std::filesystem::path& folder, const FakeEngineOptions& engine,
                           const ResumeOptions& resume = {}) {
  const base::InterruptGuard interrupt;
  Console console(folder / "campaign.log", Console::Output::kQuiet);
  OpenedCampaign opened = OpenCampaign(folder, resume, console);
  CampaignParts parts{.runner = MakeRunner(opened.spec, opened.folder.root),
                      .engine = std::make_unique<FakeEngine>(engine)};
  Campaign campaign(opened.folder, std::move(opened.lock), std::move(opened.journal), opened.spec,
                    std::move(parts), console);
  return campaign.Run(interrupt);
}

// What two campaigns that did the same have in common: everything of a trial but times and places.
inline std::string TrialTable(const std::filesystem::path& folder) {
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder));
  std::string table;
  for (const journal::TrialRecord& t : journal.Trials()) {
    table += std::to_string(t.id) + " " + std::string(base::NameOf(t.kind)) + " " + t.origin + " " +
             std::string(base::NameOf(t.status)) + " " + std::to_string(t.seed) + " " +
             std::to_string(t.finish_order);
    char number[32];
    for (const double value : t.unit) {
      std::snprintf(number, sizeof number, " %.17g", value);
      table += number;
    }
    std::snprintf(number, sizeof number, " %.17g\n", t.Metric("sad_mm2").value_or(-1));
    table += number;
  }
  return table;
}

}  // namespace talus::campaign
