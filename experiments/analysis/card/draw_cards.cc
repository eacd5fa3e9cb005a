// Cards along a posterior.
#include <filesystem>

#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/text/csv.h"
#include "base/text/number_text.h"
#include "experiments/analysis/card/card.h"
#include "experiments/journal/records.h"

namespace talus::analysis {
namespace {

// As the codes call their input, so that an editor shows it in colours.
const char* EndingOf(CardFormat format) {
  switch (format) {
    case CardFormat::kTable:
      return "txt";
    case CardFormat::kJson:
      return "json";
    case CardFormat::kLethe:
      return "prm";
    case CardFormat::kLiggghts:
    case CardFormat::kLammps:
      return "in";
    case CardFormat::kYade:
      return "py";
    case CardFormat::kMercuryDpm:
      return "cpp";
  }
  return "txt";
}

}  // namespace

void WriteDrawCards(const std::vector<DrawCard>& cards, const std::vector<CardFormat>& formats,
                    const std::filesystem::path& folder) {
  base::ClaimOutputFolder(folder, "card");
  base::RemoveFormerFiles(folder, "draw_");
  base::Csv csv;
  csv.Cell("draw").Cell("weight");
  for (const CardRange& r : cards.front().card.ranges) {
    journal::ParameterRecord column;
    column.name = r.name;
    column.unit = r.unit;
    csv.Cell(journal::ColumnName(column));
  }
  csv.EndRow();
  for (std::size_t i = 0; i < cards.size(); ++i) {
    const std::string stem = "draw_" + base::FileNumber(static_cast<std::int64_t>(i) + 1);
    csv.Cell(i + 1).Cell(cards[i].weight);
    for (const CardRange& r : cards[i].card.ranges) csv.Cell(r.value);
    csv.EndRow();
    for (const CardFormat format : formats) {
      base::WriteFileAtomically(
          folder / (stem + "_" + std::string(base::NameOf(format)) + "." + EndingOf(format)),
          CardText(cards[i].card, format));
    }
  }
  base::WriteFileAtomically(folder / "draws.csv", csv.Take());
}

}  // namespace talus::analysis
