#include "experiments/analysis/report/views/next_table_view.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/file.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// One made before a parameter was searched says nothing of it.
bool TellsOfAll(const Json& by_name, const Evidence& evidence) {
  return std::ranges::all_of(evidence.parameters, [&](const ParameterInfo& parameter) {
    return by_name.contains(parameter.range.name);
  });
}

// In the order of the parameters.
std::vector<double> WidthsOf(const Json& by_name, const Evidence& evidence) {
  std::vector<double> widths;
  for (const ParameterInfo& parameter : evidence.parameters) {
    widths.push_back(by_name.at(parameter.range.name).get<double>());
  }
  return widths;
}

CandidateView CandidateOf(const Json& json, const Evidence& evidence) {
  CandidateView candidate{.kind = json.at("kind").get<std::string>(),
                          .name = json.at("name").get<std::string>(),
                          .what = json.at("what").get<std::string>(),
                          .width = {},
                          .num_simulations = json.at("num_simulations").get<int>(),
                          .core_time = json.at("core_time_s").get<double>(),
                          .apart = {},
                          .apart_by = {},
                          .picture = {}};
  if (!json.at("bits").is_null()) {
    candidate.bits = json["bits"].get<double>();
    candidate.remaining = json.at("remaining").get<double>();
    candidate.width = WidthsOf(json.at("width_90"), evidence);
    if (json.contains("goal_half_width_90")) {
      candidate.goal = json["goal_half_width_90"].get<double>();
    }
  }
  candidate.needs_simulations =
      json.value("needs_simulations", std::isnan(candidate.bits) && candidate.num_simulations > 0);
  if (!json.contains("told_apart")) return candidate;
  candidate.apart = json["told_apart"].get<std::vector<std::vector<double>>>();
  for (const Json& number : json.value("told_apart_by", Json::array())) {
    candidate.apart_by.push_back({.metric = number.at("name").get<std::string>(),
                                  .values = number.at("values").get<std::vector<double>>()});
  }
  return candidate;
}

// Beside the table, wherever the campaign was when that was written.
Picture PictureOf(const Json& candidate, const fs::path& folder, LeftOut& left_out) {
  if (!candidate.contains("told_apart") || !candidate.contains("picture")) return {};
  const fs::path path = folder / fs::path(candidate["picture"].get<std::string>()).filename();
  return ReadPicture(path, "next_" + path.stem().string(), candidate.at("name").get<std::string>(),
                     left_out);
}

NextTableView ViewOf(const Json& json, const Evidence& evidence) {
  NextTableView view{.width = WidthsOf(json.at("width_90"), evidence),
                     .asked = json.at("asked").get<std::string>(),
                     .candidates = {}};
  const auto after = json.at("after_trial").get<std::int64_t>();
  view.is_outdated = HaveTrialsEndedSince(evidence, after);
  if (json.contains("goal")) {
    view.goal = {.process = json["goal"].at("process").get<std::string>(),
                 .metric = json["goal"].at("observable").get<std::string>(),
                 .half_width = json["goal"].at("half_width_90").get<double>()};
  }
  for (const Json& candidate : json.at("candidates")) {
    view.candidates.push_back(CandidateOf(candidate, evidence));
  }
  return view;
}

}  // namespace

std::optional<NextTableView> ReadNextTable(const Evidence& evidence, LeftOut& left_out) {
  const fs::path folder = evidence.folder / "next";
  const fs::path path = folder / "next.json";
  if (evidence.folder.empty() || !fs::exists(path)) return std::nullopt;
  try {
    const Json json = Json::parse(base::ReadFile(path));
    if (!TellsOfAll(json.at("width_90"), evidence)) return std::nullopt;
    NextTableView view = ViewOf(json, evidence);
    for (std::size_t i = 0; i < view.candidates.size(); ++i) {
      view.candidates[i].picture = PictureOf(json["candidates"][i], folder, left_out);
    }
    return view;
  } catch (const Json::exception&) {
    throw base::ConfigError(path.string() +
                            ": is not what `talus next` writes here; run it again, or remove the "
                            "file");
  }
}

}  // namespace talus::analysis
