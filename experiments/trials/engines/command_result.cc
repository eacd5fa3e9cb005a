#include "experiments/trials/engines/command_result.h"

#include <fnmatch.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>

#include "base/error.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/trials/engines/command_case.h"
#include "experiments/trials/engines/command_scalars.h"
#include "experiments/trials/engines/trial_engine.h"
#include "imaging/formats/spheres/sphere_files.h"
#include "imaging/spheres/projection.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> Matches(const CommandOptions& engine, const fs::path& folder) {
  const fs::path place = engine.ResultPath().parent_path();
  std::vector<fs::path> matches;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(folder / place, absent)) {
    const fs::path name = entry.path().filename();
    // LIGGGHTS writes one beside each file of its dump custom/vtk.
    if (name.string().find("_boundingBox") != std::string::npos) continue;
    if (entry.is_regular_file() && IsResultName(engine, place / name)) {
      matches.push_back(entry.path());
    }
  }
  std::sort(matches.begin(), matches.end(),
            [](const fs::path& a, const fs::path& b) { return NaturalLess(a, b); });
  return matches;
}

// The step of the first frame of a dump of LAMMPS or LIGGGHTS; empty of another file.
std::string FirstStep(const fs::path& file) {
  constexpr std::string_view kMark = "ITEM: TIMESTEP\n";
  constexpr std::size_t kHead = 256;
  std::string head(kHead, '\0');
  std::ifstream in(file);
  in.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(in.gcount()));
  const std::size_t mark = head.find(kMark);
  if (mark == std::string::npos) return "";
  const std::size_t start = mark + kMark.size();
  return head.substr(start, head.find('\n', start) - start);
}

// The last by name must be the last of all: not a part of a moment that each process has written
// its own file of, nor, where names carry decimals, an earlier one.
void RequireLast(const std::vector<fs::path>& matches) {
  if (matches.size() < 2) return;
  const fs::path& last = matches.back();
  const std::string step = FirstStep(last);
  for (const fs::path& other : matches) {
    if (other == last) continue;
    const std::string both =
        "left " + other.filename().string() + " and " + last.filename().string();
    if (!step.empty() && FirstStep(other) == step) {
      throw base::Error(both + ", both of step " + step +
                        ": parts of it by process? Dump without %, or name engine.result more "
                        "closely");
    }
    if (fs::last_write_time(other) > fs::last_write_time(last)) {
      throw base::Error(both +
                        ", the last by name but the older one; name engine.result more "
                        "closely, or number the files by whole steps");
    }
  }
}

double Seconds(const timespec& time) {
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool LiesIn(const fs::path& file, const fs::path& folder) {
  std::error_code absent;
  const fs::path inside =
      fs::canonical(file, absent).lexically_relative(fs::canonical(folder, absent));
  return !absent && !inside.empty() && *inside.begin() != "..";
}

// Whether it is of before the trial: it was copied here with its former time, or lies elsewhere.
// One that was written here is of the trial, even where the clock has gone back meanwhile or the
// node's is behind: its last change is then as early as its last writing.
bool IsOld(const fs::path& file, const fs::path& folder, const fs::path& started) {
  constexpr double kWhileItIsMoved = 60;  // [s]
  struct stat result {};
  struct stat start {};
  const fs::path began = folder / started;
  if (::stat(began.c_str(), &start) != 0 || ::stat(file.c_str(), &result) != 0) return false;
  const bool was_copied = Seconds(result.st_ctim) - Seconds(result.st_mtim) > kWhileItIsMoved;
  return Seconds(result.st_mtim) < Seconds(start.st_mtim) && (was_copied || !LiesIn(file, folder));
}

// The parts of a former result that lie in the trial's folder.
std::vector<fs::path> PartsIn(const fs::path& folder, const fs::path& file) {
  try {
    std::vector<fs::path> parts = imaging::PartsOf(file);
    std::erase_if(parts, [&](const fs::path& part) {
      return !part.extension().string().starts_with(".vt") || !LiesIn(part, folder);
    });
    return parts;
  } catch (const base::Error&) {
    return {};  // of a file that an attempt without an end has left
  }
}

// They are of the result as its own file is.
void RequireFreshParts(const fs::path& file, const fs::path& folder, const fs::path& started) {
  for (const fs::path& part : imaging::PartsOf(file)) {
    if (!IsOld(part, folder, started)) continue;
    throw base::Error("left " + file.filename().string() + ", whose part " +
                      part.filename().string() + " is older than the trial");
  }
}

std::string Digits(const std::string& text, std::size_t start) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789", start), text.size());
  const std::size_t first = std::min(text.find_first_not_of('0', start), end);
  return text.substr(first, end - first);
}

}  // namespace

bool NaturalLess(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (std::isdigit(static_cast<unsigned char>(a[i])) != 0 &&
        std::isdigit(static_cast<unsigned char>(b[j])) != 0) {
      const std::string left = Digits(a, i);
      const std::string right = Digits(b, j);
      if (left.size() != right.size()) return left.size() < right.size();
      if (left != right) return left < right;
      i = a.find_first_not_of("0123456789", i);
      j = b.find_first_not_of("0123456789", j);
      continue;
    }
    if (a[i] != b[j]) return a[i] < b[j];
    ++i;
    ++j;
  }
  return j < b.size() && i >= a.size();
}

fs::path FindResult(const CommandOptions& engine, const fs::path& folder, const fs::path& started) {
  std::vector<fs::path> matches = Matches(engine, folder);
  const bool any = !matches.empty();
  std::erase_if(matches, [&](const fs::path& path) { return IsOld(path, folder, started); });
  if (matches.size() > 1) {
    std::erase_if(matches, [](const fs::path& path) { return path.filename() == rigs::kHeapFile; });
  }
  if (!matches.empty()) {
    RequireLast(matches);
    RequireFreshParts(matches.back(), folder, started);
    return matches.back();
  }
  const std::string log = LastLogLines(folder);
  throw base::Error("left no file \"" + engine.result + "\"" +
                    (any ? " that is not older than the trial" : "") +
                    (log.empty() ? "" : "; its log ends with: " + log));
}

bool IsResultName(const CommandOptions& engine, const fs::path& name) {
  const fs::path pattern = engine.ResultPath();
  return !IsScalarName(name) && name.parent_path() == pattern.parent_path() &&
         ::fnmatch(pattern.filename().c_str(), name.filename().c_str(), FNM_PERIOD) == 0;
}

void RemoveResults(const CommandOptions& engine, const fs::path& folder) {
  for (const fs::path& path : Matches(engine, folder)) {
    for (const fs::path& part : PartsIn(folder, path)) fs::remove(part);
    fs::remove(path);
  }
}

void RemoveFormer(const fs::path& folder) {
  std::vector<fs::path> former;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name != rigs::kCaseFile && name != rigs::kTrialFile && !name.starts_with('.')) {
      former.push_back(entry.path());
    }
  }
  for (const fs::path& path : former) {
    std::error_code error;
    fs::remove_all(path, error);
    if (error) throw base::Error(path.string() + ": cannot be removed: " + error.message());
  }
}

bool HasLeftHeapVtp(const CommandOptions& engine, const fs::path& folder) {
  const std::vector<fs::path> matches = Matches(engine, folder);
  return matches.size() == 1 && matches.front().filename() == rigs::kHeapFile;
}

std::vector<base::Sphere> OnOurPlate(const CommandOptions& engine,
                                     std::vector<base::Sphere> spheres) {
  for (base::Sphere& sphere : spheres) {
    const base::Vec3 p = sphere.position - engine.plate_center;
    // Turned about a horizontal axis, never mirrored: x → z takes y → x and z → y.
    if (engine.up == UpAxis::kX) sphere.position = {p.y, p.z, p.x};
    if (engine.up == UpAxis::kY) sphere.position = {p.z, p.x, p.y};
    if (engine.up == UpAxis::kZ) sphere.position = p;
  }
  return spheres;
}

std::vector<base::Sphere> ReadOnOurPlate(const CommandOptions& engine, const fs::path& file) {
  return OnOurPlate(engine, imaging::ReadSpheres(file, {.length_unit = engine.length_unit}));
}

double ShownPlate(const rigs::Case& rig_case) {
  return rig_case.frame ? rig_case.frame->plate_diameter : rig_case.rig.lifted_tube.plate_diameter;
}

std::vector<base::Sphere> ShownOf(const rigs::Case& rig_case, std::vector<base::Sphere> spheres) {
  if (rig_case.rig.kind == rigs::RigKind::kLiftedTube) {
    spheres = imaging::GrainsOnPlate(spheres, ShownPlate(rig_case));
  }
  for (base::Sphere& sphere : spheres) sphere.position.z -= rigs::HeapBase(rig_case);
  return spheres;
}

std::vector<base::Sphere> HeapOfTrial(const fs::path& folder) {
  const fs::path rig_case = folder / rigs::kCaseFile;
  const auto engine = fs::exists(rig_case) ? EngineOfCase(rig_case) : std::nullopt;
  if (!engine || !HasLeftHeapVtp(*engine, folder))
    return imaging::ReadSpheres(folder / rigs::kHeapFile);
  return ShownOf(LoadAnyCase(rig_case), ReadOnOurPlate(*engine, folder / rigs::kHeapFile));
}

}  // namespace talus::trials
