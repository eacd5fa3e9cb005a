#include "experiments/analysis/report/write_report.h"

#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "experiments/analysis/report/data/tables.h"
#include "experiments/analysis/report/page/page.h"

namespace talus::analysis {

std::filesystem::path WriteReport(const ReportData& data, const std::filesystem::path& folder,
                                  const PageOptions& page) {
  base::ClaimOutputFolder(folder, "report");
  std::filesystem::create_directories(folder / "figures");
  std::filesystem::create_directories(folder / "tables");
  for (const Picture& picture : data.pictures) {
    base::WriteFileAtomically(folder / "figures" / (picture.name + ".png"), picture.png);
  }
  for (const RepresentativeView& view : data.representative) {
    if (view.heap.png.empty()) continue;
    base::WriteFileAtomically(folder / "figures" / (view.heap.name + ".png"), view.heap.png);
  }
  for (const CandidateView& candidate :
       data.next_table ? data.next_table->candidates : std::vector<CandidateView>{}) {
    if (candidate.picture.png.empty()) continue;
    base::WriteFileAtomically(folder / "figures" / (candidate.picture.name + ".png"),
                              candidate.picture.png);
  }
  for (const PredictionView& view : data.predictions) {
    for (const Picture* picture : {&view.mean, &view.different}) {
      if (picture->png.empty()) continue;
      base::WriteFileAtomically(folder / "figures" / (picture->name + ".png"), picture->png);
    }
  }
  for (const NamedText& table : ReportTables(data)) {
    base::WriteFileAtomically(folder / "tables" / (table.name + ".csv"), table.text);
  }
  base::WriteFileAtomically(folder / "report.html", ReportPage(data, page));
  return folder / "report.html";
}

}  // namespace talus::analysis
