#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/trials/measure/measure_json_csv.h"
#include "experiments/trials/measure/measure_request.h"
#include "experiments/trials/measure/plate_check.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/formats/images/profile_file.h"
#include "imaging/formats/spheres/sphere_files.h"
#include "imaging/heap/difference_map.h"
#include "imaging/spheres/projection.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;

// The AEHP with the runs that `talus measure --out` put beside it: they give its standard errors.
imaging::HeapImages ReadReference(const fs::path& path) {
  imaging::HeapImages reference{.profile = imaging::ReadProfile(path), .parts = {}};
  const fs::path runs = (fs::is_directory(path) ? path : path.parent_path()) / "runs";
  if (!fs::is_directory(runs)) return reference;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(runs)) {
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const imaging::Profile run = imaging::ReadProfile(file);
    imaging::RequireSameFrame(run.frame, reference.profile.frame);
    reference.parts.push_back(run.image);
  }
  return reference;
}

struct Projected {
  imaging::HeapImages heap;
  std::size_t num_spheres = 0;
  std::size_t num_in_heap = 0;
};

Projected Project(const fs::path& file, const imaging::Frame& frame,
                  const MeasureRequest& request) {
  const std::vector<base::Sphere> all =
      imaging::ReadSpheres(file, {.length_unit = request.length_unit, .timestep = {}});
  if (const auto wrong = WiderThanPlate(all, frame.plate_diameter)) {
    throw base::ConfigError(file.string() + ": has " + *wrong +
                            "; give its unit, such as --length-unit mm, or write x_mm for x_m");
  }
  const std::vector<base::Sphere> heap = imaging::GrainsOnPlate(all, frame.plate_diameter);
  if (heap.empty()) {
    throw base::ConfigError(file.string() + ": none of its " + std::to_string(all.size()) +
                            " spheres stands on the plate; the plate's centre must be the origin, "
                            "its top z = 0, up +z, and lengths in metres or as --length-unit says");
  }
  if (const auto wrong = InsidePlate(heap, frame.plate_diameter)) {
    throw base::ConfigError(file.string() + ": has " + *wrong +
                            "; the plate's top must be z = 0, and walls made of particles left "
                            "out");
  }
  Projected projected{.heap = {}, .num_spheres = all.size(), .num_in_heap = heap.size()};
  projected.heap.parts = imaging::ProjectViews(heap, frame, request.num_views);
  projected.heap.profile = imaging::ProjectHeap(heap, frame, request.num_views);
  return projected;
}

void WriteFiles(const fs::path& out, const Projected& projected,
                const imaging::HeapImages& reference, const std::vector<imaging::Metric>& metrics) {
  const imaging::Profile& anhp = projected.heap.profile;
  imaging::WriteProfile(out / "anhp.png", anhp);
  imaging::WritePng(out / "difference.png", imaging::DrawDifferenceMap(anhp, reference.profile));
  base::WriteFileAtomically(out / "metrics.csv", MetricsCsv(metrics));
  const nlohmann::ordered_json json{{"frame", base::ToJson(anhp.frame)},
                                    {"num_spheres", projected.num_spheres},
                                    {"num_in_heap", projected.num_in_heap},
                                    {"metrics", MetricsJson(metrics)}};
  base::WriteFileAtomically(out / "measure.json", base::JsonText(json, 2) + "\n");
}

}  // namespace

void MeasureSpheres(const MeasureRequest& request, std::ostream& print) {
  if (request.num_views < 1 || request.num_views > imaging::kMostViews) {
    throw base::ConfigError("--views: is " + std::to_string(request.num_views) +
                            ", must be from 1 to " + std::to_string(imaging::kMostViews));
  }
  std::set<fs::path> stems;
  for (const fs::path& file : request.inputs) {
    if (request.out.empty() || stems.insert(file.stem()).second) continue;
    throw base::ConfigError(file.string() +
                            ": another file has this name, which is that of its folder in --out; "
                            "measure them one by one");
  }
  const imaging::HeapImages reference = ReadReference(request.like);
  for (const fs::path& file : request.inputs) {
    const Projected projected = Project(file, reference.profile.frame, request);
    const std::vector<imaging::Metric> metrics =
        imaging::CompareProfiles(projected.heap, reference, request.experiment.metrics);
    print << file.string() << ": " << projected.num_in_heap << " of " << projected.num_spheres
          << " spheres are the heap on the plate, " << request.num_views << " views\n"
          << MetricsText(metrics);
    if (request.out.empty()) continue;
    const fs::path out = request.inputs.size() == 1 ? request.out : request.out / file.stem();
    const fs::path inputs[] = {file, request.like};
    base::ClaimOutputFolder(out, "measure", inputs);
    WriteFiles(out, projected, reference, metrics);
    print << "written to " << out.string() << "/\n";
  }
}

}  // namespace talus::trials
