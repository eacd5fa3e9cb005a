#include <algorithm>
#include <cmath>

#include "base/text/number_text.h"
#include "experiments/analysis/compare/aligned.h"
#include "experiments/analysis/compare/compare_tables.h"

namespace talus::analysis {
namespace {

using Row = TextRow;

// In the unit that people read it in.
std::string Shown(const ObjectiveFinding& f, double value, int digits = 4) {
  return base::ShortNumber(f.info.per_unit * value, digits);
}

std::string Experiment(const ObjectiveFinding& f) {
  if (!f.info.is_distance) return "-";
  const std::string error =
      std::isfinite(f.reference_error) ? " ± " + Shown(f, f.reference_error, 2) : "";
  return Shown(f, f.reference) + error + " " + f.info.unit;
}

Row Head(const Evidence& evidence, const std::string& first, const Row& more) {
  Row row{first, "measured", "experiment"};
  for (const ParameterInfo& p : evidence.parameters) {
    row.push_back(p.symbol + (p.unit.empty() ? "" : " [" + p.unit + "]"));
  }
  row.insert(row.end(), more.begin(), more.end());
  return row;
}

Row SetRow(const ObjectiveFinding& f, const std::string& measured,
           const std::vector<double>& values) {
  Row row{f.info.title, measured + (f.info.unit.empty() ? "" : " " + f.info.unit), Experiment(f)};
  for (const double value : values) row.push_back(base::ShortNumber(value, 3));
  return row;
}

std::string Percent(double fraction) { return base::ShortNumber(100 * fraction, 2) + " %"; }

std::string FromTrials(const ComparedCampaign& compared) {
  std::vector<Row> rows{Head(compared.evidence, "from the trials", {"tied sets", "tied volume"})};
  for (const ObjectiveFinding& f : compared.findings) {
    if (!f.absent.empty()) continue;
    const ComparedSet& best = f.from_trials.best.front();
    Row row = SetRow(f, Shown(f, best.quantity), best.values);
    row.push_back(std::to_string(f.from_trials.num_tied) + " of " +
                  std::to_string(f.from_trials.num_sets));
    row.push_back(Percent(f.from_trials.tied_volume));
    rows.push_back(row);
  }
  return rows.size() > 1 ? Aligned(rows) + "\n" : "";
}

std::string FromModel(const ComparedCampaign& compared) {
  std::vector<Row> rows{Head(compared.evidence, "from a model", {"tied volume"})};
  for (const ObjectiveFinding& f : compared.findings) {
    if (!f.from_model) continue;
    const ModelFinding& model = *f.from_model;
    const std::string measured =
        Shown(f, model.there.quantity) + " ± " + Shown(f, model.there.sd, 2);
    Row row = SetRow(f, measured, model.values);
    row.push_back(Percent(model.tied_volume));
    rows.push_back(row);
  }
  return rows.size() > 1 ? Aligned(rows) + "\n" : "";
}

std::string TenBest(const ComparedCampaign& compared, const ObjectiveFinding& f) {
  std::vector<Row> rows{Head(compared.evidence, "ten best by " + f.info.title, {"trials"})};
  for (std::size_t i = 0; i < f.from_trials.best.size(); ++i) {
    const ComparedSet& set = f.from_trials.best[i];
    Row row = SetRow(f, Shown(f, set.quantity), set.values);
    row[0] = std::to_string(i + 1);
    std::string ids;
    for (std::size_t k = 0; k < std::min<std::size_t>(set.trials.size(), 6); ++k) {
      ids += (k == 0 ? "" : ", ") + std::to_string(set.trials[k]);
    }
    row.push_back(ids + (set.trials.size() > 6 ? ", …" : ""));
    rows.push_back(row);
  }
  return Aligned(rows) + "\n";
}

}  // namespace

std::string ComparisonText(const ComparedCampaign& compared) {
  std::string text = compared.evidence.name + "\n\n";
  text += FromTrials(compared) + FromModel(compared);
  for (const ObjectiveFinding& f : compared.findings) {
    if (f.absent.empty()) text += TenBest(compared, f);
  }
  for (const ObjectiveFinding& f : compared.findings) {
    if (!f.absent.empty()) text += "  " + f.info.title + ": " + f.absent + "\n";
  }
  text += "  Sets tie when they differ by at most the scatter of one simulation:";
  for (const ObjectiveFinding& f : compared.findings) {
    if (!f.absent.empty()) continue;
    text += " " + f.info.title + " " + Shown(f, f.noise_sd, 2) + " " + f.info.unit + ";";
  }
  text.back() = '.';
  return text + "\n";
}

}  // namespace talus::analysis
