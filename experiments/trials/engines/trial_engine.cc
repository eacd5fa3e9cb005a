#include "experiments/trials/engines/trial_engine.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "base/error.h"
#include "base/files/file.h"
#include "base/text/printable.h"
#include "experiments/rigs/case/run_files.h"

namespace talus::trials {
namespace {

std::string TextOf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// A result older than the command that wrote it is not taken for its own.
void KeepTimes(const std::filesystem::path& from, const std::filesystem::path& to,
               std::error_code& error) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(from, error)) {
    if (!entry.is_regular_file()) continue;
    const auto copy = to / std::filesystem::relative(entry.path(), from, error);
    std::filesystem::last_write_time(copy, entry.last_write_time(error), error);
    if (error) return;
  }
}

// What Open MPI says between dashes after the words of a process that failed: only that it did.
void DropLaunchersWords(std::string& text) {
  const std::string rule(60, '-');
  for (auto at = text.find(rule); at != std::string::npos;) {
    const auto words = text.find_first_not_of("-\n", at);
    if (words == std::string::npos) return;
    const std::string_view said = std::string_view(text).substr(words);
    const bool is_theirs = said.starts_with("Primary job") || said.starts_with("mpirun ") ||
                           said.starts_with("MPI_ABORT was invoked");
    if (is_theirs && at > 0) {
      text.erase(at);
      return;
    }
    at = text.find(rule, words);
  }
}

}  // namespace

void PrepareFolder(const std::filesystem::path& folder, const std::string& key_file,
                   const std::string& text) {
  if (HoldsKey(folder, key_file, text)) return;
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  if (!error) std::filesystem::create_directories(folder, error);
  if (error) throw base::Error(folder.string() + ": cannot be made: " + error.message());
  // Torn by a power cut it is not `text`, and the folder is made anew.
  base::WriteFileAtomically(folder / key_file, text, base::Outlives::kProgram);
}

bool HoldsKey(const std::filesystem::path& folder, const std::string& key_file,
              const std::string& text) {
  return TextOf(folder / key_file) == text;
}

void CopyFolder(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::remove_all(to, error);
  if (!error) std::filesystem::create_directories(to.parent_path(), error);
  if (!error) std::filesystem::copy(from, to, std::filesystem::copy_options::recursive, error);
  if (!error) KeepTimes(from, to, error);
  if (error) throw base::Error(to.string() + ": cannot be made: " + error.message());
}

std::string LastLogLines(const std::filesystem::path& folder) {
  constexpr std::size_t kMostBytes = 600;
  constexpr int kMostLines = 3;
  std::string text = base::ReadTail(folder / rigs::kLogFile, 8 * kMostBytes);
  DropLaunchersWords(text);
  text.erase(text.find_last_not_of(" \n\r\t") + 1);
  std::size_t start = text.size();
  for (int line = 0; line < kMostLines && start != std::string::npos; ++line) {
    start = start == 0 ? std::string::npos : text.rfind('\n', start - 1);
  }
  if (start != std::string::npos) text.erase(0, start + 1);
  if (text.size() > kMostBytes) text.erase(0, text.size() - kMostBytes);
  return base::Printable(text);
}

bool LogSaysUnwritten(const std::filesystem::path& folder) {
  const std::string said = LastLogLines(folder);
  const auto says = [&](std::string_view words) { return said.find(words) != std::string::npos; };
  return says(base::kUnwritten) || says(std::strerror(ENOSPC)) || says(std::strerror(EDQUOT));
}

}  // namespace talus::trials
