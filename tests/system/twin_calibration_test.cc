// Twin calibrations: heaps simulated with known parameters are the experiment, and the campaign has
// to find the parameters again. A coarse, soft powder, so that a simulation takes half a second.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "experiments/campaign/answer/answer.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/spheres/projection.h"
#include "tests/experiments/scratch_folder.h"

namespace talus::campaign {
namespace twin_calibration_test {

namespace fs = std::filesystem;

constexpr int kHeaps = 5;    // of the twin experiment
constexpr int kBudget = 40;  // simulations of each campaign, noise and search together

const std::map<std::string, double> kTruth{
    {"sliding_friction", 0.25}, {"rolling_friction", 0.12}, {"surface_energy", 6e-3}};

constexpr const char* kRig = R"(
  "device": {"tube_inner_diameter": "10 mm", "plate_diameter": "10 mm", "plate": "disc",
             "lift_velocity": "100 mm/s"},
  "models": {"adhesion": "jkr", "rolling": "epsd"})";

constexpr const char* kFrame =
    R"({"width_px": 140, "height_px": 100, "pixel_size": "0.1 mm", "center_x_px": 70,
        "baseline_px": 95, "plate_diameter": "10 mm"})";

std::string Powder(const std::string& searched) {
  return R"("powder": {"material": {"density": 2500, "youngs_modulus": "0.3 MPa",
    "restitution": 0.6)" +
         searched + R"(}, "sizes": {"kind": "mono", "diameter": "0.9 mm"}, "mass": "0.5 g"})";
}

void RunTalus(const std::string& arguments) {
  const std::string command =
      std::string(TALUS_BINARY_DIR "/talus ") + arguments + " > /dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
}

// The mean profile of heaps with the true parameters, by seeds of their own.
void MakeExperiment(const fs::path& folder, int seed) {
  std::vector<imaging::GrayImage> profiles;
  for (int heap = 0; heap < kHeaps; ++heap) {
    const fs::path out = folder / ("truth" + std::to_string(heap));
    const fs::path case_file = out.string() + ".json";
    std::string searched;
    for (const auto& [name, value] : kTruth) {
      searched += ", \"" + name + "\": " + std::to_string(value);
    }
    base::WriteFileAtomically(case_file,
                              "{" + Powder(searched) + "," + kRig + ", \"frame\": " + kFrame +
                                  ", \"seed\": " + std::to_string(1000 * seed + heap) + "}");
    RunTalus("simulate " + case_file.string() + " --out " + out.string());
    profiles.push_back(imaging::ReadGrayImage(out / "profile.png"));
  }
  imaging::WritePng(folder / "map.png", imaging::MeanImage(profiles));
}

Answer Calibrate(const fs::path& folder, int seed) {
  const fs::path spec = folder / "spec.json";
  base::WriteFileAtomically(spec, R"({"experiment": {"map": "map.png", "map_heaps": )" +
                                      std::to_string(kHeaps) +
                                      R"(, "plate_diameter": "10 mm", "frame": )" + kFrame + "}," +
                                      Powder("") + "," + kRig + R"(,
    "parameters": {"sliding_friction": {"min": 0.1, "max": 0.6},
                   "rolling_friction": {"min": 0.03, "max": 0.3},
                   "surface_energy": {"min": 2e-3, "max": 2e-2, "scale": "log"}},
    "budget": {"simulations": )" + std::to_string(kBudget) +
                                      R"(},
    "confirm": {"candidates": 1, "replicates": 2}, "workers": 1, "seed": )" +
                                      std::to_string(seed) + "}");
  RunTalus("calibrate " + spec.string() + " --out " + (folder / "run").string());
  return ParseAnswer(base::ReadFile(folder / "run" / "result.json"));
}

bool IsRecovered(const Answer& result, int seed) {
  bool all = result.parameters.size() == kTruth.size();
  for (const ResultParameter& p : result.parameters) {
    const double truth = kTruth.at(p.name);
    const bool inside = p.credible_low <= truth && truth <= p.credible_high;
    all = all && inside;
    std::printf("seed %2d  %-17s true %.4g  found %.4g in %.4g … %.4g%s\n", seed, p.name.c_str(),
                truth, p.value, p.credible_low, p.credible_high, inside ? "" : "  MISSED");
  }
  std::printf("seed %2d  region of %.2g of what was searched\n", seed,
              result.posterior->region_volume);
  std::fflush(stdout);
  // Ranges as wide as the searched ones would hold any truth.
  EXPECT_LT(result.posterior->region_volume, 0.7);
  return all;
}

int FromEnvironment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

// TALUS_TWIN_SEEDS=10 runs the whole study; the suite has time for one.
TEST(TwinCalibration, KnownParametersLieInsideTheStatedRanges) {
  const int num_seeds = FromEnvironment("TALUS_TWIN_SEEDS", 1);
  const int first = FromEnvironment("TALUS_TWIN_FIRST", 1);
  const ScratchFolder scratch;
  int recovered = 0;
  for (int seed = first; seed < first + num_seeds; ++seed) {
    const fs::path folder = scratch.path() / std::to_string(seed);
    fs::create_directories(folder);
    MakeExperiment(folder, seed);
    recovered += IsRecovered(Calibrate(folder, seed), seed);
  }
  // All three of a campaign inside counts. One worker, so that a seed always gives the same.
  EXPECT_GE(recovered, (num_seeds * 9 + 9) / 10);
  std::printf("recovered in %d of %d\n", recovered, num_seeds);
}

}  // namespace twin_calibration_test
}  // namespace talus::campaign
