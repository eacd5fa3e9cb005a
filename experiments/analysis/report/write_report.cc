#include "experiments/analysis/report/write_report.h"

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

// Each experiment's in a folder of its own, the shown one's in `folder`.
void WriteFigures(const ReportData& data, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const char* former :
       {"next_", "predict_", "remains_", "anhp_trial_", "signed_map_trial_", "heap_"}) {
    base::RemoveFormerFiles(folder, former);
  }
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
  for (const NamedText& table : ReportTables(data)) {
    base::WriteFileAtomically(folder / (table.name + ".csv"), table.text);
  }
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
