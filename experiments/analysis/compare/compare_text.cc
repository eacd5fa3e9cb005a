#include <algorithm>
#include <cmath>

#include "base/text/num_characters.h"
#include "base/text/number_text.h"
#include "experiments/analysis/compare/compare_tables.h"
#include "experiments/analysis/compare/knowledge.h"

namespace talus::analysis {
namespace {

using Row = std::vector<std::string>;

// Columns as wide as they must be; the first one to the left, the others to the right.
std::string Aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], base::NumCharacters(row[i]));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string pad(widths[i] - base::NumCharacters(row[i]), ' ');
      line += " " + (i == 0 ? row[i] + pad : " " + pad + row[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

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

// "yes, and in 4 of 4 refits without a part of the trials"; "no, but in 3 of 4 refits …"; "yes, but
// only in 3 of 4 …"; "no, and in none of 4 …"
std::string HoldsText(const ObjectiveKnowledge& k) {
  if (!k.absent.empty()) return k.absent;
  std::string text = k.Holds() ? "yes" : "no";
  if (k.num_refits > 0) {
    const bool is_all = k.num_holding == k.num_refits;
    const std::string some = k.num_holding == 0 ? "none" : std::to_string(k.num_holding);
    const char* const link = k.Holds() ? (is_all ? ", and in " : ", but only in ")
                                       : (k.num_holding > 0 ? ", but in " : ", and in ");
    text += link + some + " of " + std::to_string(k.num_refits) +
            " refits without a part of the trials";
  }
  return text;
}

std::string WhatEachKnows(const Evidence& evidence) {
  if (evidence.knowledge.empty()) return "";
  std::vector<Row> rows{{"what each knows", "joint 90 % region", "holds the recommended set"}};
  for (const ObjectiveKnowledge& k : evidence.knowledge) {
    rows.push_back({k.title, RegionText(k), HoldsText(k)});
  }
  const std::string sentence = KnowledgeSentence(evidence.knowledge);
  return Aligned(rows) + (sentence.empty() ? "" : "  " + sentence + "\n") + "\n";
}

std::string FromTrials(const ComparedCampaign& compared) {
  std::vector<Row> rows{Head(compared.evidence, "best of the trials", {"tied sets"})};
  for (const ObjectiveFinding& f : compared.findings) {
    if (!f.absent.empty()) continue;
    const ComparedSet& best = f.from_trials.best.front();
    Row row = SetRow(f, Shown(f, best.quantity), best.values);
    row.push_back(std::isnan(f.noise_sd) ? "-"
                                         : std::to_string(f.from_trials.num_tied) + " of " +
                                               std::to_string(f.from_trials.num_sets));
    rows.push_back(row);
  }
  return rows.size() > 1 ? Aligned(rows) + "\n" : "";
}

std::string FromModel(const ComparedCampaign& compared) {
  std::vector<Row> rows{Head(compared.evidence, "best by a model", {})};
  std::string withheld;
  for (const ObjectiveFinding& f : compared.findings) {
    if (!f.from_model) continue;
    const ModelFinding& model = *f.from_model;
    const std::string measured =
        Shown(f, model.there.quantity) + " ± " + Shown(f, model.there.sd, 2);
    rows.push_back(SetRow(f, measured, model.values));
    if (model.withheld.empty()) continue;
    std::fill_n(rows.back().end() - static_cast<std::ptrdiff_t>(model.values.size()),
                model.values.size(), "-");
    withheld += "  " + f.info.title + " has no set by a model: " + model.withheld + "\n";
  }
  return rows.size() > 1 ? Aligned(rows) + withheld + "\n" : "";
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

// What coarser grains prefer may be another set than what the answer's do.
std::string ScaleFactorText(const ComparedCampaign& compared) {
  const Evidence& evidence = compared.evidence;
  const bool any = std::ranges::any_of(
      compared.findings, [](const ObjectiveFinding& finding) { return finding.absent.empty(); });
  if (!any || evidence.scale_factor == evidence.target) return "";
  return "  The trials are those at the scale factor " + base::ShortNumber(evidence.scale_factor) +
         ", with its bias; the campaign's answer is for " + base::ShortNumber(evidence.target) +
         ".\n";
}

// Seeds may change nothing, in another engine's command or for grains on a lattice.
std::string TiesText(const std::vector<ObjectiveFinding>& findings) {
  std::string text;
  bool any_scatter = false, any_unknown = false;
  for (const ObjectiveFinding& f : findings) {
    if (!f.absent.empty()) continue;
    any_unknown |= std::isnan(f.noise_sd);
    if (std::isnan(f.noise_sd)) continue;
    any_scatter |= f.noise_sd != 0;
    text += (text.empty() ? "" : "; ") + f.info.title + " " + Shown(f, f.noise_sd, 2) +
            (f.info.unit.empty() ? "" : " ") + f.info.unit;
  }
  if (text.empty()) {
    return any_unknown ? "  Which sets tie is not known: no set was simulated twice.\n" : "";
  }
  if (!any_scatter) return "  Simulations of one set came out alike: only equal sets tie.\n";
  return "  Sets tie when they differ by at most the scatter of one simulation: " + text + ".\n";
}

}  // namespace

std::string ComparisonText(const ComparedCampaign& compared) {
  const Evidence& evidence = compared.evidence;
  std::string text = evidence.name;
  if (evidence.experiments.size() > 1) text += ": " + evidence.experiments[evidence.experiment];
  text += "\n\n";
  text += WhatEachKnows(compared.evidence) + FromTrials(compared) + FromModel(compared);
  for (const ObjectiveFinding& f : compared.findings) {
    if (f.absent.empty()) text += TenBest(compared, f);
  }
  for (const ObjectiveFinding& f : compared.findings) {
    if (!f.absent.empty()) text += "  " + f.info.title + ": " + f.absent + "\n";
  }
  return text + TiesText(compared.findings) + ScaleFactorText(compared);
}

}  // namespace talus::analysis
