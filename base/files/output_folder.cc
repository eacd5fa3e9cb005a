#include "base/files/output_folder.h"

#include <algorithm>
#include <string>
#include <system_error>

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

}  // namespace

bool IsOutputFolder(const fs::path& folder, std::string_view command) {
  return ReadTail(folder / kMark, 64) == std::string(command) + "\n";
}

void ClaimOutputFolder(const fs::path& folder, std::string_view command,
                       std::span<const fs::path> inputs) {
  std::error_code error;
  for (const fs::path& input : inputs) {
    if (!IsSame(FolderOf(input), folder)) continue;
    throw ConfigError(folder.string() + ": holds the input " + input.string() +
                      ", which the results could overwrite; name another folder with --out");
  }
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw ConfigError(folder.string() + ": is a file; name a folder with --out");
  }
  if (!HoldsOnly(folder, {}) && !IsOutputFolder(folder, command)) {
    throw ConfigError(folder.string() + ": holds files that `talus " + std::string(command) +
                      "` has not written and could overwrite; name a new folder with --out");
  }
  fs::create_directories(folder, error);
  if (error) throw Error(folder.string() + ": cannot be made: " + error.message());
  WriteFileAtomically(folder / kMark, std::string(command) + "\n", Outlives::kProgram);
}

void RequireNoInput(const fs::path& output, std::span<const fs::path> inputs) {
  for (const fs::path& input : inputs) {
    if (!IsSame(output, input)) continue;
    throw ConfigError(output.string() +
                      ": is an input, which the result would overwrite; name "
                      "another file");
  }
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
