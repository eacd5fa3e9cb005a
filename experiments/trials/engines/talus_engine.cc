#include "experiments/trials/engines/talus_engine.h"

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/rigs/case/case_text.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/rigs/load_case.h"
#include "experiments/rigs/observables/observable.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/formats/spheres/sphere_files.h"
#include "imaging/spheres/projection.h"

namespace talus::trials {
namespace {

std::vector<journal::MetricRecord> ScalarsOf(const nlohmann::json& result) {
  std::vector<journal::MetricRecord> scalars;
  if (!result.contains("observables")) return scalars;
  for (const auto& [name, value] : result["observables"].items()) {
    scalars.push_back({.name = name,
                       .value = value.get<double>(),
                       .unit = rigs::UnitOfObservable(name),
                       .undefined = ""});
  }
  if (!result.contains("undefined")) return scalars;
  for (const auto& [name, why] : result["undefined"].items()) {
    journal::MetricRecord scalar{
        .name = name, .unit = rigs::UnitOfObservable(name), .undefined = {}};
    scalar.undefined = why;
    scalars.push_back(std::move(scalar));
  }
  return scalars;
}

double CpuTimeOf(const nlohmann::json& result) {
  const auto timing = result.find("timing");
  return timing == result.end() ? 0 : timing->value("cpu_time_s", 0.0);
}

// The finished run's grains in the frame.
void DrawHeap(const rigs::Case& rig_case, const std::filesystem::path& folder,
              nlohmann::ordered_json& result) {
  std::filesystem::remove(folder / rigs::kProfileFile);
  result.erase("profile");
  if (!rig_case.frame) return;
  const int num_views = rigs::NumViewsOf(rig_case);
  const auto grains = imaging::ReadSpheres(folder / rigs::kHeapFile, {});
  base::WriteFileAtomically(
      folder / rigs::kProfileFile,
      imaging::EncodePng(imaging::ProjectHeap(grains, *rig_case.frame, num_views).image));
  result["profile"] = base::ToJson(*rig_case.frame);
  result["profile"]["file"] = rigs::kProfileFile;
  result["profile"]["num_views"] = num_views;
}

// num_fallen counts true grains, of which a simulated one is f³.
void TakeScaleFactor(double factor, nlohmann::ordered_json& result) {
  const auto conditions = result.find("conditions");
  if (conditions == result.end()) return;
  const double there = conditions->value("scale_factor", factor);
  (*conditions)["scale_factor"] = factor;
  const nlohmann::ordered_json::json_pointer fallen("/observables/" +
                                                    rigs::MetricName(rigs::Observable::kNumFallen));
  if (there == factor || !result.contains(fallen) || !result[fallen].is_number()) return;
  result[fallen] = result[fallen].get<double>() * std::pow(factor / there, 3);
}

// The picture and the result as a run of this case would have them; those of a camera stay.
void DrawAnew(const rigs::Case& rig_case, const std::filesystem::path& folder) {
  const auto text = base::IfWhole(base::ReadFile(folder / rigs::kResultFile));
  auto result = nlohmann::ordered_json::parse(text.value_or(""), nullptr, false);
  if (!result.is_object()) throw base::Error("left a result.json that is not JSON");
  if (!rig_case.rig.camera) DrawHeap(rig_case, folder, result);
  TakeScaleFactor(rig_case.coarse_graining.scale_factor, result);
  result["input_hash"] = base::Hex(rigs::CaseHash(rig_case));
  base::WriteFileAtomically(folder / rigs::kCaseFile, rigs::CaseText(rig_case));
  base::WriteFileAtomically(folder / rigs::kResultFile,
                            base::WithChecksum(base::JsonText(result, 2) + "\n"));
}

}  // namespace

TalusEngine::TalusEngine(std::filesystem::path program) : program_(std::move(program)) {}

std::filesystem::path TalusEngine::ThisProgram() {
  // A launcher that starts it with libraries of its own says how it is called.
  if (const char* named = std::getenv("TALUS_PROGRAM")) return std::filesystem::absolute(named);
  return std::filesystem::read_symlink("/proc/self/exe");
}

void TalusEngine::Prepare(const rigs::Case& rig_case, const std::filesystem::path& folder) {
  const std::string text = rigs::CaseText(rig_case);
  if (!IsPrepared(rig_case, folder)) {
    PrepareFolder(folder, rigs::kCaseFile, text);
  } else if (!HoldsKey(folder, rigs::kCaseFile, text)) {  // a checkpoint goes on with other threads
    base::WriteFileAtomically(folder / rigs::kCaseFile, text, base::Outlives::kProgram);
  }
}

bool TalusEngine::IsPrepared(const rigs::Case& rig_case, const std::filesystem::path& folder) {
  if (HoldsKey(folder, rigs::kCaseFile, rigs::CaseText(rig_case))) return true;
  const std::filesystem::path former = folder / rigs::kCaseFile;
  try {
    return std::filesystem::exists(former) &&
           rigs::RunText(rigs::LoadCase(former)) == rigs::RunText(rig_case);
  } catch (const base::Error&) {
    return false;  // torn by a power cut
  }
}

std::vector<std::string> TalusEngine::Command(const std::filesystem::path&) {
  return {program_.string(), "simulate", rigs::kCaseFile, "--out", "."};
}

bool TalusEngine::IsComplete(const std::filesystem::path& folder) {
  const std::filesystem::path result = folder / rigs::kResultFile;
  return std::filesystem::exists(result) && base::IfWhole(base::ReadFile(result));
}

TrialOutput TalusEngine::Collect(const rigs::Case& rig_case, const std::filesystem::path& folder) {
  const auto text = base::IfWhole(base::ReadFile(folder / rigs::kResultFile));
  if (!text) throw base::Error("left a result.json that does not match its checksum");
  const auto result = nlohmann::json::parse(*text, nullptr, false);
  if (!result.is_object()) throw base::Error("left a result.json that is not JSON");
  const std::string reason = base::TextAt(result, "reason");
  if (base::TextAt(result, "status") != "ok") {
    throw base::Error("failed: " + (reason.empty() ? "no reason in result.json" : reason));
  }
  TrialOutput output{.profile = {},
                     .num_steps = base::IntegerAt(result, "num_steps"),
                     .num_particles = base::IntegerAt(result, "num_grains"),
                     .scalars = ScalarsOf(result),
                     .cpu_time = CpuTimeOf(result),
                     .note = reason};
  if (!rig_case.frame) return output;
  output.profile = imaging::ReadGrayImage(folder / rigs::kProfileFile);
  const imaging::Frame frame = rigs::ProfileFrameOf(rig_case);
  if (output.profile.width != frame.width || output.profile.height != frame.height) {
    throw base::Error("left a profile.png of another size than the experiment's");
  }
  return output;
}

std::optional<std::string> TalusEngine::WhyNotTaken(const rigs::Case& rig_case,
                                                    const std::filesystem::path& from) {
  const rigs::Case made = rigs::LoadCase(from / rigs::kCaseFile);
  if (auto difference = rigs::RunDifference(made, rig_case)) return difference;
  if (!rig_case.frame) return std::nullopt;
  // What a camera has seen in another frame is gone.
  if (rig_case.rig.camera && rig_case.frame != made.frame) {
    return "its pictures were taken in another frame, and cannot be drawn anew";
  }
  if (!rig_case.rig.camera && !std::filesystem::exists(from / rigs::kHeapFile)) {
    return "its heap.vtp is not there, from which it would be drawn anew";
  }
  return std::nullopt;
}

bool TalusEngine::TakeOver(const rigs::Case& rig_case, const std::filesystem::path& from,
                           const std::filesystem::path& to) {
  if (WhyNotTaken(rig_case, from)) return false;
  CopyFolder(from, to);
  DrawAnew(rig_case, to);
  return true;
}

}  // namespace talus::trials
