#include "base/files/output_folder.h"

#include <unistd.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"

namespace talus::base {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = ".talus";

bool IsSame(const fs::path& a, const fs::path& b) {
  std::error_code absent;
  return fs::equivalent(a, b, absent) && !absent;
}

fs::path FolderOf(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) return file;
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void RequireNoFile(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error) || !fs::exists(fs::symlink_status(folder, error))) return;
  throw ConfigError(folder.string() +
                    (fs::is_symlink(folder, error) && !fs::exists(folder, error)
                         ? ": is a link that leads nowhere; name a folder with --out"
                         : ": is a file; name a folder with --out"));
}

}  // namespace

void MakeOutputFolder(const fs::path& folder) {
  RequireNoFile(folder);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error == std::errc::not_a_directory) {
    throw ConfigError(folder.string() +
                      ": lies in a file, not in a folder; name another with --out");
  }
  if (error) throw Error(folder.string() + ": cannot be made: " + error.message());
}

bool MayWriteInto(const fs::path& folder) {
  fs::path there = fs::absolute(folder);
  while (!fs::exists(there) && there.has_parent_path() && there != there.root_path()) {
    there = there.parent_path();
  }
  return ::access(there.c_str(), W_OK) == 0;
}

bool IsOutputFolder(const fs::path& folder, std::string_view command) {
  return ReadTail(folder / kMark, 64) == std::string(command) + "\n";
}

void ClaimOutputFolder(const fs::path& folder, std::string_view command,
                       std::span<const fs::path> inputs) {
  for (const fs::path& input : inputs) {
    if (!IsSame(FolderOf(input), folder)) continue;
    throw ConfigError(folder.string() + ": holds the input " + input.string() +
                      ", which the results could overwrite; name another folder with --out");
  }
  RequireNoFile(folder);
  if (!HoldsOnly(folder, {}) && !IsOutputFolder(folder, command)) {
    throw ConfigError(folder.string() + ": holds files that `talus " + std::string(command) +
                      "` has not written and could overwrite; name a new folder with --out");
  }
  MakeOutputFolder(folder);
  WriteFileAtomically(folder / kMark, std::string(command) + "\n", Outlives::kProgram);
}

void RemoveFormerFiles(const fs::path& folder, std::string_view prefix) {
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> former;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const bool is_one = entry.path().filename().string().starts_with(prefix);
    if (is_one && entry.is_regular_file()) former.push_back(entry.path());
  }
  for (const fs::path& file : former) fs::remove(file);
}

bool HoldsOnly(const fs::path& folder, std::span<const std::string_view> names) {
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(folder, absent)) {
    const std::string name = entry.path().filename();
    if (std::find(names.begin(), names.end(), name) == names.end()) return false;
  }
  return true;
}

}  // namespace talus::base
