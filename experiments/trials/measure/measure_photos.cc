#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/json/json_text.h"
#include "base/parallel_for.h"
#include "experiments/trials/measure/measure_json_csv.h"
#include "experiments/trials/measure/measure_request.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/formats/images/profile_file.h"
#include "imaging/photos/overlay.h"
#include "imaging/photos/photo_reading.h"
#include "imaging/photos/photo_set.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;

// Photographs named one by one: run and view from their names. A name that fits no other would make
// all of them views of one heap.
void GroupPhotos(const std::vector<fs::path>& files, imaging::ExperimentOptions& options) {
  const imaging::PhotoSet set = imaging::SortPhotos(files, options.pattern);
  options.pattern = set.pattern;
  std::vector<fs::path> strays = files;
  for (const imaging::PhotoFiles& run : set.runs) {
    imaging::PhotoRun photos{.name = run.run, .photos = {}};
    for (const imaging::PhotoFile& view : run.views) {
      photos.photos.push_back(view.path);
      std::erase(strays, view.path);
    }
    options.runs.push_back(std::move(photos));
  }
  if (strays.empty()) return;
  throw base::ConfigError(
      strays.front().string() + ": does not fit the pattern \"" + set.pattern +
      "\"; leave it out, or, if all are views of one heap, say --pattern \"*\"");
}

std::vector<fs::path> InputsOf(const MeasureRequest& request) {
  std::vector<fs::path> inputs = request.inputs;
  for (const imaging::PhotoRun& run : request.experiment.runs) {
    inputs.insert(inputs.end(), run.photos.begin(), run.photos.end());
  }
  return inputs;
}

fs::path OverlayPath(const fs::path& out, const std::string& name) {
  return out / "overlays" / (name + ".png");
}

// Photographs that are no longer measured, or were at fault, leave no picture behind.
void RemoveFormerOverlays(const fs::path& out) {
  base::RemoveFormerFiles(out / "overlays", "run_");
  base::RemoveFormerFiles(out / "overlays", "fault_");
}

std::string OverlayName(const imaging::MeasuredRun& run, const imaging::MeasuredView& view) {
  return "run_" + run.name + "_" + view.photo.stem().string();
}

// Several at a time: coding them takes longer than all the measuring. Of photographs that share a
// name the last one's is kept.
void WriteOverlays(const MeasureRequest& request, const imaging::Experiment& experiment) {
  std::map<fs::path, const imaging::MeasuredView*> views;
  for (const imaging::MeasuredRun& run : experiment.runs) {
    for (const imaging::MeasuredView& view : run.views) {
      views[OverlayPath(request.out, OverlayName(run, view))] = &view;
    }
  }
  const std::vector<std::pair<fs::path, const imaging::MeasuredView*>> files(views.begin(),
                                                                             views.end());
  const auto write = [&](std::int64_t i) {
    const auto& [path, view] = files[static_cast<std::size_t>(i)];
    imaging::WritePng(path, imaging::OverlayOf(*view, experiment.aehp.frame, request.experiment,
                                               experiment.photo_pixel));
  };
  base::ParallelFor({.num_items = std::ssize(files), .item_work = imaging::kPhotoWork}, write);
}

void WriteFiles(const MeasureRequest& request, const imaging::Experiment& experiment) {
  const fs::path& out = request.out;
  base::ClaimOutputFolder(out, "measure", InputsOf(request));
  RemoveFormerOverlays(out);
  fs::remove(out / "standard_deviation.png");     // may not be written anew
  base::RemoveFormerFiles(out / "runs", "run_");  // comparisons read all that there are
  for (const char* folder : {"runs", "overlays"}) {
    if (!experiment.runs.empty()) fs::create_directories(out / folder);
  }
  imaging::WriteProfile(out / "aehp.png", experiment.aehp);
  if (!experiment.standard_deviation.pixels.empty()) {
    imaging::WritePng(out / "standard_deviation.png", experiment.standard_deviation);
  }
  for (const imaging::MeasuredRun& run : experiment.runs) {
    imaging::WriteProfile(out / "runs" / ("run_" + run.name + ".png"), run.profile);
  }
  WriteOverlays(request, experiment);
  base::WriteFileAtomically(out / "views.csv", ViewsCsv(experiment));
  base::WriteFileAtomically(out / "metrics.csv", MetricsCsv(experiment.metrics));
  base::WriteFileAtomically(out / "measure.json",
                            base::JsonText(ExperimentJson(experiment), 2) + "\n");
}

void PrintSummary(const imaging::Experiment& experiment, const imaging::ExperimentOptions& options,
                  std::ostream& print) {
  const imaging::Frame& frame = experiment.aehp.frame;
  print << "AEHP " << (experiment.reading.empty() ? "from a map" : "of " + experiment.reading)
        << '\n';
  print << (options.scale.empty() ? "  plate "
                                  : "  table, by " + options.scale + ", of which count ")
        << frame.plate_diameter / frame.pixel_size << " px wide, " << frame.pixel_size * 1e6
        << " um a pixel, centre at column " << frame.center_x << ", baseline at row "
        << frame.baseline << " of " << frame.width << " x " << frame.height << " px\n"
        << MetricsText(experiment.metrics);
  if (experiment.noise_floor) {
    const imaging::NoiseFloor& floor = *experiment.noise_floor;
    print << "  noise floor (leave-one-run-out SAD) " << floor.mean_sad_px
          << " px = " << floor.mean_sad_mm2 << " mm2 = " << 100 * floor.mean_sad_relative
          << " % of NEBP\n";
  }
}

// What is doubtful, each with the picture that shows it.
void PrintWarnings(const imaging::Experiment& experiment, const fs::path& out,
                   std::ostream& print) {
  for (const imaging::PhotoWarning& warning : experiment.warnings) {
    print << "warning: " << imaging::WarningText(warning);
    for (const imaging::MeasuredRun& run : experiment.runs) {
      for (const imaging::MeasuredView& view : run.views) {
        if (out.empty() || view.photo != warning.photo) continue;
        print << " (see " << OverlayPath(out, OverlayName(run, view)).string() << ")";
      }
    }
    print << '\n';
  }
}

// Where the pictures are, a line each, of many one line.
std::string SeeText(const std::vector<std::pair<fs::path, fs::path>>& drawn, const fs::path& out) {
  constexpr std::size_t kMostLines = 8;
  if (drawn.size() > kMostLines) {
    return "\nwhat was found in " + std::to_string(drawn.size()) + " photographs: see " +
           OverlayPath(out, "fault_*").string();
  }
  std::string said;
  for (const auto& [photo, picture] : drawn) {
    said += "\n" + photo.string() + ": see " + picture.string();
  }
  return said;
}

bool IsAmong(const fs::path& picture, const std::vector<std::pair<fs::path, fs::path>>& drawn) {
  return std::ranges::any_of(drawn, [&](const auto& one) { return one.second == picture; });
}

// Draws what was found in the photographs that cannot be used, under names that keep photographs of
// several folders apart, and says where. One that is unreadable, black or blank has no picture.
std::string DrawUnusable(const MeasureRequest& request,
                         const std::vector<imaging::UnusablePhoto>& photos) {
  std::vector<std::pair<fs::path, fs::path>> drawn;
  for (const imaging::UnusablePhoto& unusable : photos) {
    if (!unusable.is_drawable) continue;  // the fault says why
    const std::string name = "fault_" + unusable.photo.parent_path().filename().string() + "_" +
                             unusable.photo.stem().string();
    fs::path path = OverlayPath(request.out, name);
    for (int i = 2; IsAmong(path, drawn); ++i) {
      path = OverlayPath(request.out, name + "_" + std::to_string(i));
    }
    if (drawn.empty()) {
      base::ClaimOutputFolder(request.out, "measure", InputsOf(request));
      base::RemoveFormerFiles(path.parent_path(), "fault_");
      fs::create_directories(path.parent_path());
    }
    imaging::WritePng(path, imaging::FaultOf(unusable, request.experiment));
    drawn.emplace_back(unusable.photo, path);
  }
  return SeeText(drawn, request.out);
}

imaging::Experiment MeasureOrDraw(const MeasureRequest& request) {
  try {
    return imaging::MeasureExperiment(request.experiment);
  } catch (const imaging::UnusablePhotosError& error) {
    if (!request.out.empty()) {
      throw base::ConfigError(error.what() + DrawUnusable(request, error.photos()));
    }
    if (std::ranges::none_of(error.photos(), &imaging::UnusablePhoto::is_drawable)) throw;
    throw base::ConfigError(std::string(error.what()) +
                            "\nwith --out DIR what was found in each is drawn");
  }
}

}  // namespace

void SetSource(const std::vector<fs::path>& inputs, bool is_map,
               imaging::ExperimentOptions& options) {
  if (is_map) {
    if (inputs.size() != 1) throw base::ConfigError("--map takes one file");
    options.map = inputs.front();
    return;
  }
  if (inputs.size() == 1 && fs::is_directory(inputs.front())) {
    options.photos = inputs.front();
    return;
  }
  for (const fs::path& input : inputs) {
    if (!fs::is_directory(input)) continue;
    throw base::ConfigError(input.string() +
                            ": is a folder among other inputs; give one folder, or photographs "
                            "one by one, or --choose-mass for one folder a mass");
  }
  GroupPhotos(inputs, options);
}

void MeasurePhotos(const MeasureRequest& request, std::ostream& print) {
  MeasureRequest complete = request;
  SetSource(request.inputs, request.is_map, complete.experiment);
  const imaging::Experiment experiment = MeasureOrDraw(complete);
  PrintSummary(experiment, complete.experiment, print);
  PrintWarnings(experiment, request.out, print);
  if (request.out.empty()) return;
  WriteFiles(complete, experiment);
  const std::string drawn = DrawUnusable(complete, experiment.left_out);
  if (!drawn.empty()) print << "left out:" << drawn << '\n';
  print << "written to " << request.out.string()
        << (experiment.runs.empty() ? "/\n" : "/ (look at overlays/*.png)\n");
}

}  // namespace talus::trials
