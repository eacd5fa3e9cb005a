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

// Each experiment's in a folder of its own, the shown one's in `folder`.
void WriteFigures(const ReportData& data, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
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
    WriteFigures(other, folder / other.evidence.experiments.at(other.evidence.experiment));
  }
}

}  // namespace

std::filesystem::path WriteReport(const ReportData& data, const std::filesystem::path& folder,
                                  const PageOptions& page) {
  base::ClaimOutputFolder(folder, "report");
  WriteFigures(data, folder / "figures");
  std::filesystem::create_directories(folder / "tables");
  for (const NamedText& table : ReportTables(data)) {
    base::WriteFileAtomically(folder / "tables" / (table.name + ".csv"), table.text);
  }
  if (const std::string summary = SummaryPage(data); !summary.empty()) {
    base::WriteFileAtomically(folder / "summary.html", summary);
  }
  base::WriteFileAtomically(folder / "report.html", ReportPage(data, page));
  return folder / "report.html";
}

}  // namespace talus::analysis
