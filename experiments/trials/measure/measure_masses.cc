#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <regex>
#include <sstream>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/json/json_text.h"
#include "base/text/csv.h"
#include "base/text/number_text.h"
#include "base/units.h"
#include "experiments/trials/measure/measure_request.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/mass_study.h"
#include "imaging/photos/photo_set.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;

// A folder of photographs at one mass on one day.
struct MassFolder {
  fs::path path;
  double mass = 0;  // [kg]
  std::string day;
};

struct NamedMass {
  double mass = 0;   // [kg]
  std::string rest;  // of the name, which may tell the day
};

// "1.5g", "1.50 g day 2", "heap_620mg": a number and a unit of mass in a folder's name.
std::optional<NamedMass> MassInName(const std::string& name) {
  static const std::regex kMass("(^|[^0-9.,])([0-9]+(?:\\.[0-9]+)?) ?(kg|g|mg|ug)($|[^A-Za-z])");
  std::smatch match;
  if (!std::regex_search(name, match, kMass)) return std::nullopt;
  static const std::regex kExponent("[0-9][eE][-+]?$");
  const std::string before = match.prefix().str() + match[1].str();
  if (std::regex_search(before, kExponent)) {
    throw base::ConfigError(name + ": names a mass with a power of ten; write 1.5g or 620mg");
  }
  std::string rest = before + match[4].str() + match.suffix().str();
  while (!rest.empty() && std::string_view(" _-,.").find(rest.front()) != std::string_view::npos) {
    rest.erase(0, 1);
  }
  return NamedMass{
      .mass = base::ParseQuantity(match[2].str() + " " + match[3].str(), base::Dimension::kMass),
      .rest = rest};
}

std::vector<fs::path> FoldersIn(const fs::path& path) {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(path)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!entry.is_directory() || is_hidden) continue;
    if (!base::IsOutputFolder(entry.path(), "measure")) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

// Whether a folder in that of a mass is a heap's: it has the photographs of one, and its name
// speaks of no mass, day, weekday or date.
bool IsHeapFolder(const fs::path& path) {
  static const std::regex kDay(
      "day|[0-9]{8}|[0-9]+[-_. ](?:[0-9]+|[a-z]{3,9})[-_. ][0-9]+|^(?:mon|tue|wed|thu|fri|sat|sun)",
      std::regex::icase);
  const std::string name = base::FolderName(path);
  if (MassInName(name) || std::regex_search(name, kDay) || !FoldersIn(path).empty()) return false;
  return !imaging::ImagesIn(path).empty() && imaging::FindPhotos(path, "").runs.size() == 1;
}

// Whether the photographs of one mass and day begin here, in a folder a heap or without any.
bool HoldsPhotos(const fs::path& path, const std::vector<fs::path>& inner,
                 const std::string& pattern) {
  if (inner.empty()) return true;
  if (!pattern.empty() && pattern.find('/') == std::string::npos) return false;
  return imaging::ImagesIn(path).empty() && std::ranges::all_of(inner, IsHeapFolder);
}

// DIR/MASS, DIR/MASS_DAY, DIR/MASS/DAY and DIR/DAY/MASS are all understood, each with a folder a
// heap in it or without.
void FindFolders(const fs::path& path, const std::string& pattern, MassFolder known,
                 std::vector<MassFolder>& found) {
  const std::string name = base::FolderName(path);
  const std::optional<NamedMass> named = MassInName(name);
  if (named) known.mass = named->mass;
  const std::string day = named ? named->rest : known.path.empty() ? "" : name;
  if (!day.empty()) known.day = day;
  known.path = path;
  const std::vector<fs::path> inner = FoldersIn(path);
  if (!(known.mass > 0) || !HoldsPhotos(path, inner, pattern)) {
    for (const fs::path& folder : inner) FindFolders(folder, pattern, known, found);
    if (!inner.empty()) return;
  }
  if (!(known.mass > 0)) {
    throw base::ConfigError(path.string() +
                            ": its name tells no mass; name the folders by mass and day, such as "
                            "1.5g_day1");
  }
  if (known.day.empty()) known.day = "1";
  found.push_back(known);
}

// Its heaps would count twice.
void RequireOnce(const std::vector<MassFolder>& folders) {
  std::map<fs::path, fs::path> named;
  for (const MassFolder& folder : folders) {
    const auto [other, is_new] = named.emplace(fs::canonical(folder.path), folder.path);
    if (is_new) continue;
    throw base::ConfigError(
        folder.path.string() + ": is named twice" +
        (other->second == folder.path ? "" : ", also as " + other->second.string()) +
        "; name each folder once");
  }
}

std::vector<MassFolder> FindFolders(const std::vector<fs::path>& inputs,
                                    const std::string& pattern) {
  std::vector<MassFolder> folders;
  for (const fs::path& input : inputs) {
    if (!fs::is_directory(input)) {
      throw base::ConfigError(input.string() +
                              ": is no folder; --choose-mass takes one folder of photographs for "
                              "each mass and day, such as 1.5g_day1");
    }
    FindFolders(input, pattern, {}, folders);
  }
  RequireOnce(folders);
  return folders;
}

std::vector<imaging::MassRun> MeasureFolder(const MassFolder& folder,
                                            const imaging::ExperimentOptions& options,
                                            std::ostream& print) {
  imaging::ExperimentOptions of_folder = options;
  of_folder.photos = folder.path;
  const imaging::Experiment experiment = imaging::MeasureExperiment(of_folder);
  for (const imaging::PhotoWarning& warning : experiment.warnings) {
    print << "warning: " << folder.path.string() << ": " << imaging::WarningText(warning) << '\n';
  }
  std::vector<imaging::MassRun> runs;
  for (const imaging::MeasuredRun& run : experiment.runs) {
    const double pixel = run.profile.frame.pixel_size * 1e3;  // [mm]
    runs.push_back({.mass = folder.mass,
                    .day = folder.day,
                    .run = run.name,
                    .nebp_mm2 = imaging::Nebp(run.profile.image) * pixel * pixel,
                    .base_share = imaging::BaseShare(run.profile)});
  }
  return runs;
}

std::string StudyText(const imaging::MassStudy& study) {
  std::ostringstream text;
  text << "  mass [g]   runs   NEBP [mm2]          by day\n";
  for (const imaging::MassRow& row : study.rows) {
    text << "  " << std::left << std::setw(11) << row.mass * 1e3 << std::setw(7) << row.num_runs
         << std::setprecision(5) << std::setw(8) << row.mean_mm2 << " ± " << std::setprecision(2)
         << std::setw(9) << row.sd_mm2;
    for (const imaging::DayMean& day : row.days) {
      text << std::setprecision(5) << day.day << ": " << day.mean_mm2 << " (" << day.num_runs
           << ")  ";
    }
    text << (row.remark.empty() ? "formed and repeatable" : row.remark) << '\n'
         << std::setprecision(6);
  }
  if (study.chosen) {
    text << "chosen: " << *study.chosen * 1e3 << " g\n";
  } else {
    text << "no mass keeps the rule\n";
  }
  text << "rule: " << imaging::RuleText({}) << '\n';
  return text.str();
}

std::string RunsCsv(const std::vector<imaging::MassRun>& runs) {
  base::Csv csv;
  csv.Heads({"mass_kg", "day", "run", "nebp_mm2", "base_over_plate"}).EndRow();
  for (const imaging::MassRun& run : runs) {
    csv.Cell(base::ShortNumber(run.mass, 8)).Cell(run.day).Cell(run.run);
    csv.Cell(base::ShortNumber(run.nebp_mm2, 8))
        .Cell(base::ShortNumber(run.base_share, 8))
        .EndRow();
  }
  return csv.Take();
}

nlohmann::ordered_json StudyJson(const imaging::MassStudy& study) {
  nlohmann::ordered_json json{{"rule", imaging::RuleText({})}, {"chosen_kg", nullptr}};
  if (study.chosen) json["chosen_kg"] = *study.chosen;
  json["masses"] = nlohmann::ordered_json::array();
  for (const imaging::MassRow& row : study.rows) {
    nlohmann::ordered_json days = nlohmann::ordered_json::array();
    for (const imaging::DayMean& day : row.days) {
      days.push_back({{"day", day.day}, {"num_runs", day.num_runs}, {"nebp_mm2", day.mean_mm2}});
    }
    json["masses"].push_back({{"mass_kg", row.mass},
                              {"num_runs", row.num_runs},
                              {"nebp_mm2", row.mean_mm2},
                              {"nebp_sd_mm2", row.sd_mm2},
                              {"least_base_over_plate", row.least_base},
                              {"days", days},
                              {"formed", row.formed},
                              {"repeatable", row.repeatable},
                              {"remark", row.remark}});
  }
  return json;
}

}  // namespace

void MeasureMasses(const MeasureRequest& request, std::ostream& print) {
  std::vector<imaging::MassRun> runs;
  for (const MassFolder& folder : FindFolders(request.inputs, request.experiment.pattern)) {
    std::ranges::copy(MeasureFolder(folder, request.experiment, print), std::back_inserter(runs));
  }
  std::ranges::stable_sort(runs, {}, &imaging::MassRun::mass);  // "1.5g" stands before "1g"
  const imaging::MassStudy study = imaging::StudyMass(runs);
  print << StudyText(study);
  if (request.out.empty()) return;
  base::ClaimOutputFolder(request.out, "measure", request.inputs);
  imaging::WritePng(request.out / "mass_study.png", imaging::DrawMassStudy(runs, study));
  base::WriteFileAtomically(request.out / "mass_study.csv", RunsCsv(runs));
  base::WriteFileAtomically(request.out / "mass_study.json",
                            base::JsonText(StudyJson(study), 2) + "\n");
  print << "written to " << request.out.string() << "/\n";
}

}  // namespace talus::trials
