#include "experiments/analysis/report/write_report.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "experiments/analysis/report/data/tables.h"
#include "experiments/analysis/report/page/summary.h"

namespace talus::analysis {
namespace {

void WritePicture(const std::filesystem::path& folder, const Picture& picture) {
  if (picture.png.empty()) return;
  base::WriteFileAtomically(folder / (picture.name + ".png"), picture.png);
}

// Names are those of folders already (base::RequireName), but for these two.
std::string OwnFolder(const Evidence& evidence) {
  const std::string& name = evidence.experiments.at(evidence.experiment);
  if (name != "." && name != "..") return name;
  return "experiment_" + std::to_string(evidence.experiment + 1);
}

using Names = std::vector<std::string>;

void RemoveFormer(const std::filesystem::path& folder, const Names& begin_so) {
  for (const std::string& former : begin_so) base::RemoveFormerFiles(folder, former);
}

// The folders of experiments that have another name since, or stand first now.
void RemoveFormerExperiments(const ReportData& data, const std::filesystem::path& folder,
                             const Names& begin_so) {
  std::vector<std::filesystem::path> former;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto is_it = [&](const ReportData& other) {
      return OwnFolder(other.evidence) == entry.path().filename();
    };
    if (entry.is_directory() && std::ranges::none_of(data.others, is_it)) {
      former.push_back(entry.path());
    }
  }
  for (const std::filesystem::path& experiment : former) {
    RemoveFormer(experiment, begin_so);
    std::error_code has_others;  // files of the user's
    std::filesystem::remove(experiment, has_others);
  }
}

// Each experiment's in a folder of its own, the shown one's in `folder`.
void WriteFigures(const ReportData& data, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const Names pictures{"aehp",  "anhp_trial_", "signed_map_trial_", "heap_",
                       "next_", "predict_",    "remains_"};
  RemoveFormer(folder, pictures);
  RemoveFormerExperiments(data, folder, pictures);
  for (const Picture& picture : data.pictures) WritePicture(folder, picture);
  for (const RepresentativeView& view : data.representative) WritePicture(folder, view.heap);
  if (data.next_table) {
    for (const CandidateView& candidate : data.next_table->candidates) {
      WritePicture(folder, candidate.picture);
    }
  }
  for (const PredictionView& view : data.predictions) {
    for (const Picture* picture : {&view.mean, &view.different}) WritePicture(folder, *picture);
  }
  for (const ReportData& other : data.others) {
    WriteFigures(other, folder / OwnFolder(other.evidence));
  }
}

// … and so are the tables.
void WriteTables(const ReportData& data, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  Names files;
  for (const NamedText& table : ReportTables(data)) {
    base::WriteFileAtomically(folder / files.emplace_back(table.name + ".csv"), table.text);
  }
  RemoveFormerExperiments(data, folder, files);
  for (const ReportData& other : data.others) {
    WriteTables(other, folder / OwnFolder(other.evidence));
  }
}

}  // namespace

std::filesystem::path WriteReport(const ReportData& data, const std::filesystem::path& folder,
                                  const PageOptions& page) {
  base::ClaimOutputFolder(folder, "report");
  WriteFigures(data, folder / "figures");
  WriteTables(data, folder / "tables");
  if (const std::string summary = SummaryPage(data); !summary.empty()) {
    base::WriteFileAtomically(folder / "summary.html", summary);
  } else {
    std::filesystem::remove(folder / "summary.html");  // of a search that goes on since
  }
  base::WriteFileAtomically(folder / "report.html", ReportPage(data, page));
  return folder / "report.html";
}

}  // namespace talus::analysis
