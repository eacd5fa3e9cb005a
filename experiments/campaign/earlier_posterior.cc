#include "experiments/campaign/earlier_posterior.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "base/error.h"
#include "base/json/json_writer.h"
#include "base/problems.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "base/text/shell_text.h"
#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/journal/journal.h"
#include "optimizer/space/candidate_table.h"
#include "optimizer/space/draws_density.h"

namespace talus::campaign {
namespace {

constexpr std::size_t kMostDraws = 1000;  // that a prior is made of: each is a kernel
constexpr double kLeastInside = 0.5;      // of the draws, in the ranges of this campaign

// A campaign's posterior, as it lies in its folder.
struct Earlier {
  CampaignSpec spec;
  std::vector<std::string> names;
  std::vector<std::vector<double>> draws;  // one a row, in their order, SI

  bool Has(const std::string& name) const { return std::ranges::count(names, name) > 0; }
};

Earlier ReadEarlier(const std::filesystem::path& root) {
  const CampaignFolder folder{root};
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(root));
  if (journal.Progress().result_json.empty() || !std::filesystem::exists(folder.posterior())) {
    throw base::ConfigError(root.string() + ": has no posterior yet: let that campaign finish");
  }
  const journal::CampaignRecord record = journal.Campaign();
  Earlier earlier{.spec = ParseSpecText(record.spec_json), .names = {}, .draws = {}};
  std::vector<std::string> columns;
  for (const journal::ParameterRecord& p : record.parameters) {
    earlier.names.push_back(p.name);
    columns.push_back(journal::ColumnName(p));
  }
  const auto rows = optimizer::ReadCandidateTable(folder.posterior(), columns);
  const std::size_t step = std::max<std::size_t>(1, (rows.size() + kMostDraws - 1) / kMostDraws);
  for (std::size_t i = 0; i < rows.size(); i += step) earlier.draws.push_back(rows[i]);
  return earlier;
}

bool IsSearched(const CampaignSpec& spec, const std::string& name) {
  return std::ranges::any_of(SpaceOf(spec).parameters, [&](const optimizer::Parameter& p) {
    return p.name == name && !p.fixed;
  });
}

void RequireSamePowder(const CampaignSpec& spec, const Earlier& earlier) {
  const CampaignSpec& other = earlier.spec;
  const auto refuse = [](const std::string& what) {
    throw base::ConfigError("is of another powder: " + what +
                            "; a posterior holds for the powder that it was found with");
  };
  const auto curve_of = [](engine::SizeDistribution sizes) {
    sizes.file.reset();  // its content stands beside it
    return base::ToJson(sizes);
  };
  if (curve_of(spec.powder.sizes) != curve_of(other.powder.sizes)) refuse("its sizes differ");
  const double density = spec.powder.material.density;
  if (density != other.powder.material.density && !IsSearched(spec, "density")) {
    refuse("its density is " + base::ShortNumber(other.powder.material.density) + " kg/m³, not " +
           base::ShortNumber(density));
  }
  if (base::ToJson(spec.models) != base::ToJson(other.models)) refuse("its contact laws differ");
}

std::vector<std::vector<double>> Columns(const Earlier& earlier,
                                         const std::vector<std::string>& names) {
  std::vector<std::vector<double>> draws;
  for (const std::vector<double>& row : earlier.draws) {
    draws.emplace_back();
    for (const std::string& name : names) {
      const auto at = std::ranges::find(earlier.names, name) - earlier.names.begin();
      draws.back().push_back(row[static_cast<std::size_t>(at)]);
    }
  }
  return draws;
}

void RequireInside(const CampaignSpec& spec, const optimizer::EarlierDraws& draws) {
  const auto inside = static_cast<double>(SpaceOf(spec).Inside(draws).rows());
  const auto all = static_cast<double>(draws.values.size());
  if (inside >= kLeastInside * all && inside >= optimizer::DrawsDensity::kFewest) return;
  throw base::ConfigError("lies outside the ranges here for the most part: " +
                          base::InPercent(inside / std::max(1.0, all)) +
                          " % of it is inside; widen them");
}

// What the earlier campaign asked for must be searched here: beside another fixed value its other
// parameters would have other posteriors.
void TakeAll(const CampaignSpec& spec, EarlierPosterior& prior) {
  const Earlier earlier = ReadEarlier(prior.from);
  RequireSamePowder(spec, earlier);
  const optimizer::ParameterSpace theirs = SpaceOf(earlier.spec);
  prior.names.clear();
  for (const int i : theirs.Free()) {
    const optimizer::Parameter& p = theirs.parameters[static_cast<std::size_t>(i)];
    if (IsSearched(spec, p.name)) {
      prior.names.push_back(p.name);
    } else if (!p.is_nuisance) {
      throw base::ConfigError("has found " + p.name +
                              ", which is not searched here; search it, or give single "
                              "parameters their priors");
    }
  }
  prior.draws = Columns(earlier, prior.names);
  RequireInside(spec, {.names = prior.names, .values = prior.draws});
}

template <class Prior>
void TakeOne(const CampaignSpec& spec, const std::string& name, Prior& prior) {
  const Earlier earlier = ReadEarlier(*prior.from);
  RequireSamePowder(spec, earlier);
  if (!earlier.Has(name)) throw base::ConfigError("has not searched " + name);
  const auto draws = Columns(earlier, {name});
  prior.draws.clear();
  for (const std::vector<double>& row : draws) prior.draws.push_back(row.front());
  RequireInside(spec, {.names = {name}, .values = draws});
}

// Calls `take`, and puts what it throws under the prior's own place.
template <class Take>
void At(const std::string& place, base::Problems& problems, const Take& take) {
  try {
    take();
  } catch (const base::Error& error) {
    problems.Add(place, error.what());
  }
}

struct Taker {
  const CampaignSpec& spec;
  const CampaignSpec* begun;
  base::Problems& problems;

  template <class Range>
  void operator()(std::string_view key, std::optional<Range>& range, base::FieldInfo = {}) {
    if (!range || !range->prior || !range->prior->from) return;
    const std::string name(key);
    Range known;
    if (begun != nullptr) Find(name, known);
    if (known.prior && known.prior->from == range->prior->from) {
      range->prior->draws = known.prior->draws;
      return;
    }
    At("parameters." + name + ".prior.from", problems, [&] { TakeOne(spec, name, *range->prior); });
  }
  void operator()(std::string_view, std::optional<EarlierPosterior>& prior, base::FieldInfo = {}) {
    if (!prior) return;
    if (begun != nullptr && begun->parameters->prior &&
        begun->parameters->prior->from == prior->from) {
      prior = begun->parameters->prior;
      return;
    }
    At("parameters.prior.from", problems, [&] { TakeAll(spec, *prior); });
  }

 private:
  template <class Range>
  void Find(const std::string& name, Range& known) const {
    ParameterRanges::Visit(
        *begun->parameters, [&](std::string_view key, const auto& range, base::FieldInfo = {}) {
          if constexpr (std::is_same_v<std::decay_t<decltype(range)>, std::optional<Range>>) {
            if (key == name && range) known = *range;
          }
        });
  }
};

bool AreSameMeasurements(const journal::ExperimentRecord& a, const journal::ExperimentRecord& b) {
  if (!a.aehp_png.empty()) return a.aehp_png == b.aehp_png;
  const auto same = [](const journal::ScalarRecord& x, const journal::ScalarRecord& y) {
    return x.name == y.name && x.value == y.value && x.standard_error == y.standard_error;
  };
  return b.aehp_png.empty() && std::ranges::equal(a.scalars, b.scalars, same);
}

}  // namespace

std::set<std::filesystem::path> PriorFolders(const CampaignSpec& spec) {
  std::set<std::filesystem::path> folders;
  ParameterRanges::Visit(*spec.parameters,
                         [&](std::string_view, const auto& entry, base::FieldInfo = {}) {
                           if (!entry) return;
                           if constexpr (requires { entry->prior->from; }) {
                             if (entry->prior && entry->prior->from) {
                               folders.insert(*entry->prior->from);
                             }
                           } else if constexpr (requires { entry->from; }) {
                             folders.insert(entry->from);
                           }
                         });
  return folders;
}

std::vector<std::string> EarlierWarnings(const CampaignSpec& spec,
                                         const journal::CampaignRecord& record) {
  std::vector<std::string> warnings;
  for (const std::filesystem::path& folder : PriorFolders(spec)) {
    journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder));
    const journal::CampaignRecord earlier = journal.Campaign();
    for (const journal::ExperimentRecord& own : record.experiments) {
      if (std::ranges::none_of(earlier.experiments, [&](const journal::ExperimentRecord& theirs) {
            return AreSameMeasurements(own, theirs);
          })) {
        continue;
      }
      warnings.push_back("the prior from " + folder.string() + " knows what \"" + own.name +
                         "\" has measured, which counts twice now: leave the prior out, and take "
                         "that campaign's simulations over (calibrate --reuse " +
                         base::ShellWord(folder.string()) + ")");
    }
    if (HasAlarm(ParseAnswer(journal.Progress().result_json),
                 {AlarmKind::kImplausible, AlarmKind::kDisagree, AlarmKind::kMisses})) {
      warnings.push_back("the prior from " + folder.string() +
                         " is of a campaign in which no set fits what was measured");
    }
  }
  return warnings;
}

CampaignSpec ReadSpecWithPosteriors(const base::JsonFile& file, const CampaignSpec* begun) {
  CampaignSpec spec = ReadCampaignSpec(file);
  base::Problems problems(file.path.string(), file.places);
  TakePosteriors(spec, begun, problems);
  problems.ThrowIfAny();
  return spec;
}

void TakePosteriors(CampaignSpec& spec, const CampaignSpec* begun, base::Problems& problems) {
  const CampaignSpec read = spec;
  ParameterRanges::Visit(*spec.parameters, Taker{read, begun, problems});
}

}  // namespace talus::campaign
