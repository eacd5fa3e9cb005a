#include "experiments/report/tables.h"

#include <charconv>
#include <cmath>

namespace talus::experiments {
namespace {

// One cell after the other; a text is quoted where CSV [rfc4180] needs it.
class Csv {
 public:
  Csv& Cell(std::string_view text) {
    Separate();
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
      text_ += text;
      return *this;
    }
    text_ += '"';
    for (const char c : text) text_ += c == '"' ? std::string("\"\"") : std::string(1, c);
    text_ += '"';
    return *this;
  }
  // The shortest text that reads back to the same number; nothing where it is not defined.
  Csv& Cell(double value) {
    Separate();
    if (!std::isfinite(value)) return *this;
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    return *this;
  }
  Csv& Cells(const std::vector<double>& values) {
    for (const double value : values) Cell(value);
    return *this;
  }
  void EndRow() {
    text_ += '\n';
    first_ = true;
  }
  std::string Take() { return std::move(text_); }

 private:
  void Separate() {
    if (!first_) text_ += ',';
    first_ = false;
  }

  std::string text_;
  bool first_ = true;
};

// "surface_energy_J_per_m2"
std::string ColumnOf(const ParameterInfo& parameter) {
  std::string unit;
  for (std::size_t i = 0; i < parameter.unit.size(); ++i) {
    const std::string_view rest = std::string_view(parameter.unit).substr(i);
    if (rest.starts_with("/")) {
      unit += "_per_";
    } else if (rest.starts_with("²") || rest.starts_with("³")) {
      unit += rest.starts_with("²") ? '2' : '3';
      ++i;  // two bytes
    } else {
      unit += parameter.unit[i];
    }
  }
  return parameter.range.name + (unit.empty() ? "" : "_" + unit);
}

void ParameterHeads(Csv& csv, const Evidence& evidence) {
  for (const ParameterInfo& parameter : evidence.parameters) csv.Cell(ColumnOf(parameter));
}

std::string Trials(const Evidence& evidence) {
  Csv csv;
  csv.Cell("trial").Cell("state").Cell("purpose").Cell("seed").Cell("scale_factor");
  ParameterHeads(csv, evidence);
  for (const MetricInfo& metric : evidence.metrics) csv.Cell(metric.name);
  csv.Cell("duration_s").Cell("cpu_s").Cell("reason").EndRow();
  for (const TrialEvidence& t : evidence.trials) {
    csv.Cell(t.id).Cell(base::NameOf(t.state)).Cell(t.purpose).Cell(std::to_string(t.seed));
    csv.Cell(t.scale_factor).Cells(t.values).Cells(t.metrics);
    csv.Cell(t.seconds).Cell(t.cpu_seconds).Cell(t.reason).EndRow();
  }
  return csv.Take();
}

std::string Objectives(const ReportData& data) {
  Csv csv;
  csv.Cell("objective").Cell("from").Cell("metric").Cell("quantity").Cell("reference");
  csv.Cell("objective_value").Cell("noise_sd");
  ParameterHeads(csv, data.evidence);
  csv.Cell("tied_sets").Cell("sets").Cell("tied_volume_fraction").EndRow();
  for (const ObjectiveFinding& f : data.findings) {
    if (!f.absent.empty()) continue;
    const ComparedSet& best = f.from_trials.best.front();
    csv.Cell(f.info.key).Cell("trials").Cell(f.info.metric).Cell(best.quantity);
    csv.Cell(f.reference).Cell(best.objective).Cell(f.noise_sd).Cells(best.values);
    csv.Cell(static_cast<double>(f.from_trials.num_tied));
    csv.Cell(static_cast<double>(f.from_trials.num_sets));
    csv.Cell(f.from_trials.tied_volume).EndRow();
    if (!f.from_model) continue;
    const ModelFinding& model = *f.from_model;
    csv.Cell(f.info.key).Cell("model").Cell(f.info.metric).Cell(model.there.quantity);
    csv.Cell(f.reference).Cell(model.there.objective).Cell(f.noise_sd).Cells(model.values);
    csv.Cell("").Cell("").Cell(model.tied_volume).EndRow();
  }
  return csv.Take();
}

std::string TenBest(const ReportData& data) {
  Csv csv;
  csv.Cell("objective").Cell("rank").Cell("quantity").Cell("objective_value");
  ParameterHeads(csv, data.evidence);
  csv.Cell("trials").EndRow();
  for (const ObjectiveFinding& f : data.findings) {
    double rank = 0;
    for (const ComparedSet& set : f.from_trials.best) {
      std::string ids;
      for (const int id : set.trials) ids += (ids.empty() ? "" : " ") + std::to_string(id);
      csv.Cell(f.info.key).Cell(++rank).Cell(set.quantity).Cell(set.objective);
      csv.Cells(set.values).Cell(ids).EndRow();
    }
  }
  return csv.Take();
}

std::string Measures(const ReportData& data) {
  Csv csv;
  csv.Cell("profile").Cell("why");
  for (const MetricInfo& metric : data.evidence.metrics) csv.Cell(metric.name);
  csv.EndRow();
  for (const MeasuredProfile& m : data.measures) {
    csv.Cell(m.title).Cell(m.note).Cells(m.metrics).EndRow();
  }
  return csv.Take();
}

std::string Outlines(const ReportData& data) {
  Csv csv;
  csv.Cell("profile").Cell("x_m").Cell("height_m").EndRow();
  for (const OutlineCurve& outline : data.outlines) {
    for (std::size_t i = 0; i < outline.x.size(); ++i) {
      csv.Cell(outline.title).Cell(outline.x[i]).Cell(outline.height[i]).EndRow();
    }
  }
  return csv.Take();
}

}  // namespace

std::vector<NamedText> ReportTables(const ReportData& data) {
  return {{"trials", Trials(data.evidence)},
          {"objectives", Objectives(data)},
          {"ten_best", TenBest(data)},
          {"measures", Measures(data)},
          {"outlines", Outlines(data)}};
}

}  // namespace talus::experiments
