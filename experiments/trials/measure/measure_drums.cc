#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/counted.h"
#include "base/text/number_text.h"
#include "base/units.h"
#include "experiments/trials/measure/measure_request.h"
#include "imaging/drums/drum_overlay.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/formats/images/photograph_file.h"
#include "imaging/formats/images/profile_file.h"
#include "imaging/photos/photo_set.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json DrumJson(const imaging::MeasuredDrum& drum, std::size_t num_photos) {
  const imaging::DrumCircle& circle = drum.map.circle;
  ordered_json json{{"num_photos", num_photos},
                    {"center_x_px", circle.center_x},
                    {"center_y_px", circle.center_y},
                    {"radius_px", circle.radius},
                    {"inner_radius_px", drum.map.inner_radius},
                    {"pixel_size_m", drum.pixel_size},
                    {"turning", nullptr},
                    {"angle_deg", base::ToJson(drum.angle.value / base::kDegree)},
                    {"fill", base::ToJson(drum.surface.fill.value)}};
  if (drum.turning) json["turning"] = base::NameOf(*drum.turning);
  if (!drum.angle.defined()) json["not_defined"] = drum.angle.not_defined;
  if (num_photos < 2) return json;
  json["angle_standard_error_deg"] = base::ToJson(drum.angle.standard_error / base::kDegree);
  json["surface_sd_m"] = drum.surface_sd;
  return json;
}

std::string SurfaceCsv(const imaging::MeasuredDrum& drum) {
  std::ostringstream csv;
  csv << "x_m,height_m\n";
  for (const imaging::DrumPoint& p : drum.surface.points) {
    csv << base::ShortNumber(p.x * drum.pixel_size, 8) << ','
        << base::ShortNumber(p.height * drum.pixel_size, 8) << '\n';
  }
  return csv.str();
}

void WriteFiles(const MeasureRequest& request, const imaging::MeasuredDrum& drum) {
  const fs::path& out = request.out;
  base::ClaimOutputFolder(out, "measure", request.drum->photos);
  imaging::WriteProfile(out / "drum.png", imaging::DrumProfile(drum));
  imaging::WritePng(
      out / "overlay.png",
      imaging::DrawDrum(imaging::ReadPhotograph(request.drum->photos.front()).image, drum));
  base::WriteFileAtomically(out / "surface.csv", SurfaceCsv(drum));
  base::WriteFileAtomically(out / "measure.json",
                            base::JsonText(DrumJson(drum, request.drum->photos.size()), 2) + "\n");
}

void PrintSummary(const imaging::MeasuredDrum& drum, std::size_t num_photos, std::ostream& print) {
  const imaging::DrumCircle& circle = drum.map.circle;
  print << "drum from " << base::Counted(static_cast<long long>(num_photos), "photograph")
        << "\n  circle of " << base::ShortNumber(2 * circle.radius) << " px around ("
        << base::ShortNumber(circle.center_x) << ", " << base::ShortNumber(circle.center_y) << "), "
        << base::ShortNumber(drum.pixel_size * 1e6) << " µm a pixel; "
        << base::ShortNumber(2 * drum.map.inner_radius) << " px of it count, the ring left out\n";
  if (drum.angle.defined()) {
    print << "  turning " << base::NameOf(*drum.turning) << ", powder higher on the "
          << (drum.surface.slope_angle.value >= 0 ? "left" : "right") << "\n  dynamic angle "
          << base::ShortNumber(drum.angle.value / base::kDegree) << "°";
    if (num_photos > 1) {
      print << " ± " << base::ShortNumber(drum.angle.standard_error / base::kDegree, 2) << "°";
    }
    print << '\n';
  } else {
    print << "  no dynamic angle: " << drum.angle.not_defined << '\n';
  }
  if (drum.surface.fill.defined()) {
    print << "  fill " << base::ShortNumber(drum.surface.fill.value, 3) << " of the drum\n";
  } else {
    print << "  no fill: " << drum.surface.fill.not_defined << '\n';
  }
  if (num_photos < 2) return;
  print << "  surface sd " << base::ShortNumber(drum.surface_sd * 1e3, 3) << " mm\n";
  constexpr double kNoMotion = 1e-9;  // [m] rounding of a mean
  if (drum.surface_sd < kNoMotion) {
    print
        << "  warning: all photographs show the very same surface; are they copies of one file?\n";
  }
}

// A photograph that counts twice would narrow the angle's error.
void AddPhoto(const fs::path& image, std::vector<fs::path>& photos) {
  const auto is_this = [&](const fs::path& photo) {
    std::error_code there_is_none;
    return fs::equivalent(photo, image, there_is_none);
  };
  if (std::ranges::any_of(photos, is_this)) {
    throw base::ConfigError(image.string() + ": is named twice; name each photograph once");
  }
  photos.push_back(image);
}

}  // namespace

void MeasureDrums(const MeasureRequest& request, std::ostream& print) {
  MeasureRequest complete = request;
  complete.drum->photos.clear();
  for (const fs::path& input : request.inputs) {
    const std::vector<fs::path> images =
        fs::is_directory(input) ? imaging::ImagesIn(input) : std::vector<fs::path>{input};
    for (const fs::path& image : images) AddPhoto(image, complete.drum->photos);
  }
  if (complete.drum->photos.empty()) {
    throw base::ConfigError(request.inputs.front().string() + ": holds no photographs");
  }
  const imaging::MeasuredDrum drum = imaging::MeasureDrum(*complete.drum);
  PrintSummary(drum, complete.drum->photos.size(), print);
  if (request.out.empty()) return;
  WriteFiles(complete, drum);
  print << "written to " << request.out.string() << "/ (look at overlay.png)\n";
}

}  // namespace talus::trials
