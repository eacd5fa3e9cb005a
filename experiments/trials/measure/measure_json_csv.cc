#include "experiments/trials/measure/measure_json_csv.h"

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/json/json_writer.h"
#include "base/text/csv.h"
#include "base/text/number_text.h"
#include "base/units.h"

namespace talus::trials {
namespace {

using nlohmann::ordered_json;

// With enough digits for any use, and no more than are true of a measurement.
std::string Number(double value, int digits = 8) {
  return std::isfinite(value) ? base::ShortNumber(value, digits) : "";
}

void AddMeasured(const imaging::Measured& measured, ordered_json& json) {
  json["value"] = base::ToJson(measured.value);
  if (std::isfinite(measured.standard_error)) json["standard_error"] = measured.standard_error;
  if (!measured.defined()) json["not_defined"] = measured.not_defined;
}

constexpr const char* kNoReference = "there is no reference";

ordered_json AnglesJson(const imaging::ReposeAngles& angles) {
  ordered_json json;
  for (std::size_t method = 0; method < angles.size(); ++method) {
    const imaging::SideAngles& sides = angles[method];
    const std::string name = "repose_angle_" + std::to_string(method + 1) + "_";
    json[name + "left_deg"] = base::ToJson(sides.left.value / base::kDegree);
    json[name + "right_deg"] = base::ToJson(sides.right.value / base::kDegree);
    json[name + "mean_deg"] = base::ToJson(sides.mean.value / base::kDegree);
  }
  return json;
}

ordered_json ViewJson(const imaging::MeasuredView& view) {
  ordered_json json{{"photo", view.photo.string()},
                    {"plate_width_px", view.plate.width},
                    {"plate_center_x_px", view.plate.center_x},
                    {"baseline_px", view.plate.baseline},
                    {"tilt_deg", view.plate.tilt / base::kDegree},
                    {"nebp_px", view.nebp}};
  json.update(AnglesJson(view.angles));
  return json;
}

ordered_json RunJson(const imaging::MeasuredRun& run) {
  ordered_json json{{"name", run.name},
                    {"nebp_px", imaging::Nebp(run.profile.image)},
                    {"views", ordered_json::array()}};
  for (const imaging::MeasuredView& view : run.views) json["views"].push_back(ViewJson(view));
  return json;
}

std::string WithError(const imaging::Measured& measured) {
  if (!measured.defined()) return "not defined, because " + measured.not_defined;
  std::string text = Number(measured.value, 6);
  if (std::isfinite(measured.standard_error)) {
    text += " ± " + Number(measured.standard_error, 2);
  }
  return text;
}

}  // namespace

ordered_json MetricsJson(const std::vector<imaging::Metric>& metrics) {
  ordered_json json;
  for (const imaging::Metric& metric : metrics) {
    ordered_json entry;
    AddMeasured(metric.value, entry);
    entry["unit"] = metric.unit;
    if (metric.reference.defined()) {
      entry["reference"] = metric.reference.value;
      if (std::isfinite(metric.reference.standard_error)) {
        entry["reference_standard_error"] = metric.reference.standard_error;
      }
    } else if (metric.reference.not_defined != kNoReference) {
      entry["reference_not_defined"] = metric.reference.not_defined;
    }
    json[metric.name] = std::move(entry);
  }
  return json;
}

std::string MetricsCsv(const std::vector<imaging::Metric>& metrics) {
  base::Csv csv;
  csv.Heads({"metric", "unit", "value", "standard_error", "reference", "reference_standard_error",
             "not_defined"})
      .EndRow();
  for (const imaging::Metric& metric : metrics) {
    csv.Cell(metric.name).Cell(metric.unit).Cell(Number(metric.value.value));
    csv.Cell(Number(metric.value.standard_error)).Cell(Number(metric.reference.value));
    csv.Cell(Number(metric.reference.standard_error)).Cell(metric.value.not_defined).EndRow();
  }
  return csv.Take();
}

std::string MetricsText(const std::vector<imaging::Metric>& metrics) {
  std::ostringstream text;
  for (const imaging::Metric& metric : metrics) {
    text << "  " << std::left << std::setw(26) << metric.name << WithError(metric.value);
    if (metric.reference.defined()) text << "   (reference " << WithError(metric.reference) << ")";
    text << '\n';
  }
  return text.str();
}

ordered_json ExperimentJson(const imaging::Experiment& experiment) {
  ordered_json json{{"frame", base::ToJson(experiment.aehp.frame)},
                    {"metrics", MetricsJson(experiment.metrics)}};
  if (experiment.noise_floor) {
    const imaging::NoiseFloor& floor = *experiment.noise_floor;
    json["noise_floor"] = {{"sad_px", floor.mean_sad_px},
                           {"sad_mm2", floor.mean_sad_mm2},
                           {"sad_relative", floor.mean_sad_relative},
                           {"sad_px_by_run", floor.sad_px}};
  }
  json["runs"] = ordered_json::array();
  for (const imaging::MeasuredRun& run : experiment.runs) json["runs"].push_back(RunJson(run));
  json["warnings"] = nlohmann::ordered_json::array();
  for (const imaging::PhotoWarning& warning : experiment.warnings) {
    json["warnings"].push_back({{"kind", base::NameOf(warning.doubt)},
                                {"photo", warning.photo.string()},
                                {"photographs", warning.num_photos},
                                {"value", warning.value},
                                {"text", imaging::WarningText(warning)}});
  }
  return json;
}

std::string ViewsCsv(const imaging::Experiment& experiment) {
  base::Csv csv;
  csv.Heads({"run", "photo", "plate_width_px", "plate_center_x_px", "baseline_px", "tilt_deg",
             "nebp_px"});
  const ordered_json names = AnglesJson({});
  for (const auto& [name, value] : names.items()) csv.Cell(name);
  csv.EndRow();
  for (const imaging::MeasuredRun& run : experiment.runs) {
    for (const imaging::MeasuredView& view : run.views) {
      csv.Cell(run.name);
      const ordered_json fields = ViewJson(view);
      for (const auto& [name, value] : fields.items()) {
        csv.Cell(value.is_string() ? value.get<std::string>()
                 : value.is_null() ? ""
                                   : Number(value.get<double>()));
      }
      csv.EndRow();
    }
  }
  return csv.Take();
}

}  // namespace talus::trials
