#include "experiments/trials/engines/command_measure.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "base/files/file.h"
#include "engine/run/state_file.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/trials/engines/command_result.h"
#include "experiments/trials/engines/command_scalars.h"
#include "experiments/trials/engines/grain_check.h"
#include "experiments/trials/engines/tube_numbers.h"
#include "experiments/trials/measure/plate_check.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/formats/spheres/sphere_files.h"
#include "imaging/spheres/projection.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;
using base::Outlives;

Measured MeasureSpheres(const CommandOptions& options, const rigs::Case& rig_case,
                        const fs::path& file, const fs::path& folder) {
  const auto spheres = ReadOnOurPlate(options, file);
  const bool on_plate = rig_case.rig.kind == rigs::RigKind::kLiftedTube;
  const double plate = ShownPlate(rig_case);
  if (const auto wrong = on_plate ? WiderThanPlate(spheres, plate) : std::nullopt) {
    throw base::Error("left " + file.filename().string() + " with " + *wrong +
                      "; is engine.length_unit right?");
  }
  const std::optional<GrainDoubt> doubt = DoubtOfGrains(rig_case, spheres);
  if (doubt && doubt->is_unit_slip) {
    throw base::Error("left " + file.filename().string() + " with " + doubt->text);
  }
  const std::vector<base::Sphere> heap = ShownOf(rig_case, spheres);
  if (heap.empty()) {
    throw base::Error("left nothing on the plate, of " + std::to_string(spheres.size()) +
                      " spheres in " + file.filename().string() +
                      "; are length_unit, up and plate_center right?");
  }
  Measured measured{
      .files = {}, .profile = {}, .num_spheres = spheres.size(), .num_grains = heap.size()};
  const auto inside = on_plate ? InsidePlate(heap, plate) : std::nullopt;
  if (doubt) {
    measured.doubt = file.filename().string() + " has " + doubt->text;
  } else if (inside) {
    measured.doubt = file.filename().string() + " has " + *inside +
                     "; is engine.plate_center right, and are walls made of particles left out?";
  }
  if (rig_case.frame) {
    if (const int num = rigs::ProfileFrameOf(rig_case).num_pictures(); num > 1) {
      throw base::Error("left spheres, which show one moment of the run; leave an image of its " +
                        std::to_string(num) + " pictures (rig.camera.times), side by side");
    }
    measured.profile =
        imaging::ProjectHeap(heap, *rig_case.frame, rigs::NumViewsOf(rig_case)).image;
    base::WriteFileAtomically(folder / rigs::kProfileFile, imaging::EncodePng(measured.profile),
                              Outlives::kProgram);
  }
  if (file.filename() != rigs::kHeapFile) {
    base::WriteFileAtomically(folder / rigs::kHeapFile, engine::VtpOf(ParticlesOf(heap), 0),
                              Outlives::kProgram);
  }
  if (on_plate) measured.scalars = TubeNumbersOf(rig_case, plate, heap);
  return measured;
}

// What is doubtful about a silhouette; empty if nothing is. Powder is black on white, and above
// that of every rig but a drum, which is full round, is air.
std::string DoubtOfImage(const rigs::Case& rig_case, const imaging::GrayImage& image,
                         const fs::path& file) {
  constexpr int kDark = 128;
  const auto is_dark = [](std::uint8_t value) { return value < kDark; };
  const auto width = static_cast<std::ptrdiff_t>(image.width);
  const bool any = std::ranges::any_of(image.pixels, is_dark);
  const auto in_sky = std::count_if(image.pixels.begin(), image.pixels.begin() + width, is_dark);
  const bool inverted = rig_case.rig.kind != rigs::RigKind::kDrum && 2 * in_sky > width;
  if (any && !inverted) return "";
  return file.filename().string() + (any ? " has a dark sky" : " shows no powder") +
         "; it must show the powder black on white, the right way up";
}

Measured MeasureImage(const rigs::Case& rig_case, const fs::path& file, const fs::path& folder) {
  Measured measured{.files = {}, .profile = imaging::ReadGrayImage(file)};
  if (!rig_case.frame) {
    throw base::Error(
        "left an image, but the experiment has numbers only; leave scalars.json or "
        "scalars.csv");
  }
  const imaging::Frame frame = rigs::ProfileFrameOf(rig_case);
  if (measured.profile.width != frame.width || measured.profile.height != frame.height) {
    throw base::Error("left the image " + file.filename().string() + " of " +
                      std::to_string(measured.profile.width) + " x " +
                      std::to_string(measured.profile.height) + " px; the experiment's is " +
                      std::to_string(frame.width) + " x " + std::to_string(frame.height));
  }
  measured.doubt = DoubtOfImage(rig_case, measured.profile, file);
  base::WriteFileAtomically(folder / rigs::kProfileFile, imaging::EncodePng(measured.profile),
                            Outlives::kProgram);
  return measured;
}

// The file that was measured here before, if any: a copied folder has other times of its files.
std::optional<fs::path> FormerlyMeasured(const CommandOptions& options, const fs::path& folder) {
  if (!fs::exists(folder / rigs::kResultFile)) return std::nullopt;
  const auto result =
      nlohmann::ordered_json::parse(base::ReadFile(folder / rigs::kResultFile), nullptr, false);
  if (!result.is_object() || !result.contains("measured")) return std::nullopt;
  // Its parts, which may have a name of a result too, follow after it.
  for (const auto& [name, checksum] : result["measured"].items()) {
    if (IsResultName(options, name) && fs::exists(folder / name)) return folder / name;
  }
  return std::nullopt;
}

}  // namespace

fs::path ResultOf(const CommandOptions& options, const fs::path& folder) {
  const auto former = FormerlyMeasured(options, folder);
  return former ? *former : FindResult(options, folder, rigs::kCommandFile);
}

namespace {

// Without a frame numbers are enough, and most likely what was meant.
fs::path FindMeasurable(const CommandOptions& options, const rigs::Case& rig_case,
                        const fs::path& folder) {
  if (rig_case.frame) return ResultOf(options, folder);
  try {
    return ResultOf(options, folder);
  } catch (const base::Error& error) {
    throw base::Error(
        std::string("left neither scalars.json nor scalars.csv with its numbers, and ") +
        error.what());
  }
}

// Numbers beside a result in a subfolder would be taken for read.
void RequireNoneBeside(const CommandOptions& options, const fs::path& folder) {
  const fs::path place = options.ResultPath().parent_path();
  if (place.empty()) return;
  const fs::path file = ScalarFile(folder / place);
  if (file.empty()) return;
  throw base::Error("left " + (place / file.filename()).string() +
                    ", which is not read there; write it into the trial's own folder");
}

}  // namespace

// What the command left: spheres or an image where there is a frame, numbers, or both. The numbers
// of a lifted tube's heap follow from its spheres; one that the command gives itself counts.
Measured MeasureResult(const CommandOptions& options, const rigs::Case& rig_case,
                       const fs::path& folder) {
  const std::vector<journal::MetricRecord> given = ReadScalars(folder);
  Measured measured;
  if (rig_case.frame || given.empty()) {
    const fs::path file = FindMeasurable(options, rig_case, folder);
    measured = file.extension() == ".png" ? MeasureImage(rig_case, file, folder)
                                          : MeasureSpheres(options, rig_case, file, folder);
    measured.files.push_back(file);
    std::ranges::copy(imaging::PartsOf(file), std::back_inserter(measured.files));
  }
  if (!given.empty()) measured.files.push_back(ScalarFile(folder));
  RequireNoneBeside(options, folder);
  for (const journal::MetricRecord& scalar : given) {
    std::erase_if(measured.scalars,
                  [&](const journal::MetricRecord& s) { return s.name == scalar.name; });
    measured.scalars.push_back(scalar);
  }
  return measured;
}

}  // namespace talus::trials
