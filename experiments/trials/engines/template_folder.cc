#include "experiments/trials/engines/template_folder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "base/files/file.h"
#include "experiments/rigs/case/run_files.h"
#include "experiments/trials/engines/command_result.h"
#include "experiments/trials/engines/command_scalars.h"

namespace talus::trials {
namespace {

namespace fs = std::filesystem;

// Names in a file of a trial's folder that a template may not have.
bool IsReserved(const fs::path& path) {
  static constexpr std::string_view kOfCommand[] = {rigs::kHeapFile, rigs::kCommandFile,
                                                    rigs::kCommandDone};
  const auto is_in = [&](const auto& names) {
    return std::ranges::find(names, path.string()) != std::end(names);
  };
  return is_in(rigs::kNeverAResult) || is_in(rigs::kFilesOfCampaign) || is_in(kOfCommand);
}

// The parts of the command as templates; `{{` in one of them is as in a file.
std::vector<TextTemplate> CommandParts(const CommandOptions& engine) {
  std::vector<TextTemplate> parts;
  for (const std::string& argument : engine.command) parts.emplace_back(argument, "command");
  return parts;
}

}  // namespace

TemplateFolder::TemplateFolder(const fs::path& folder) : folder_(folder) {
  constexpr std::size_t kMostFiles = 10000;
  constexpr std::uint64_t kMostBytes = 256 << 20;  // all are kept in memory
  std::uint64_t num_bytes = 0;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
    const fs::path path = entry.path().lexically_relative(folder);
    std::error_code dangling;
    if (entry.is_directory(dangling) && !entry.is_symlink()) {
      folders_.push_back(path);
      continue;
    }
    if (!entry.is_regular_file(dangling)) {
      throw base::ConfigError(entry.path().string() +
                              ": is a pipe, a device, or a link to a folder or to nothing; a "
                              "template is a plain file");
    }
    if (IsReserved(path)) {
      throw base::ConfigError(entry.path().string() +
                              ": a template may not have the name of a trial's own file");
    }
    File file{.path = path,
              .bytes = base::ReadFile(entry.path(), kMostBytes - std::min(kMostBytes, num_bytes)),
              .text = std::nullopt};
    num_bytes += file.bytes.size();
    if (files_.size() >= kMostFiles) {
      throw base::ConfigError(folder.string() + ": holds more than " + std::to_string(kMostFiles) +
                              " files; name a folder of templates alone");
    }
    if (file.bytes.find('\0') == std::string::npos && file.bytes.find("{{") != std::string::npos) {
      file.text.emplace(file.bytes, entry.path().string());
    }
    files_.push_back(std::move(file));
  }
  if (error) throw base::ConfigError(folder.string() + ": cannot be read: " + error.message());
  if (files_.empty()) throw base::ConfigError(folder.string() + ": holds no files");
  std::sort(files_.begin(), files_.end(),
            [](const File& a, const File& b) { return a.path < b.path; });
}

void TemplateFolder::Check(const CommandOptions& engine, const TemplateValues& known,
                           std::span<const std::string> needed, base::Problems& problems) const {
  problems.Within("templates", [&] {
    for (const File& file : files_) {
      if (file.text) file.text->Check(known, problems);
    }
  });
  for (const File& file : files_) {
    problems.Require(!IsResultName(engine, file.path), "templates",
                     (folder_ / file.path).string() + ": fits \"" + engine.result +
                         "\", so that it would be taken for every trial's result; take it out");
    problems.Require(
        !IsScalarName(file.path), "templates",
        (folder_ / file.path).string() + ": would be taken for every trial's numbers; take it out");
  }
  problems.Within("command", [&] {
    for (const TextTemplate& part : CommandParts(engine)) part.Check(known, problems);
  });
  for (const std::string& name : needed) {
    problems.Require(Uses(engine, name), "templates",
                     folder_.string() + ": no file has the placeholder {{ " + name +
                         " }}, so that giving " + name + " would change nothing");
  }
}

bool TemplateFolder::Uses(const CommandOptions& engine, const std::string& name) const {
  const auto uses = [&](const TextTemplate& text) { return text.Names().contains(name); };
  const auto parts = CommandParts(engine);
  return std::any_of(files_.begin(), files_.end(),
                     [&](const File& file) { return file.text && uses(*file.text); }) ||
         std::any_of(parts.begin(), parts.end(), uses);
}

std::optional<std::string> TemplateFolder::Difference(const CommandOptions& engine,
                                                      const TemplateValues& there,
                                                      const TemplateValues& here) const {
  constexpr double kRounding = 1e-9;  // of lengths that come of another size and scale factor
  for (const auto& [name, value] : here.scalars) {
    const auto before = there.scalars.find(name);
    if (before == there.scalars.end() || before->second == value || !Uses(engine, name)) continue;
    const double a = std::strtod(before->second.c_str(), nullptr);  // a name is another one
    const double b = std::strtod(value.c_str(), nullptr);
    if (b != 0 && std::abs(a - b) <= kRounding * std::abs(b)) continue;
    return "{{ " + name + " }} was " + before->second + " there and is " + value + " here";
  }
  return std::nullopt;
}

std::string TemplateFolder::Hash() const {
  std::string all;
  for (const File& file : files_) {
    all += file.path.string() + '\0' + base::Hex(base::Checksum(file.bytes)) + '\0';
  }
  return base::Hex(base::Checksum(all));
}

void TemplateFolder::Fill(const TemplateValues& values, const fs::path& target) const {
  for (const fs::path& folder : folders_) fs::create_directories(target / folder);
  for (const File& file : files_) {
    const fs::path path = target / file.path;
    // Made again from the template after a power cut, so there is no need to wait for the disk.
    base::WriteFileAtomically(path, file.text ? file.text->Fill(values) : file.bytes,
                              base::Outlives::kProgram);
    fs::permissions(path, fs::status(folder_ / file.path).permissions());
  }
}

void RequireOutside(const CommandOptions& engine, const fs::path& folder) {
  if (!engine.templates) return;
  std::error_code unreachable;  // which reading and writing say
  const fs::path templates = fs::canonical(*engine.templates, unreachable);
  if (templates.empty()) return;
  const fs::path place = fs::weakly_canonical(fs::absolute(folder), unreachable);
  if (std::ranges::mismatch(templates, place).in1 != templates.end()) return;
  throw base::ConfigError(folder.string() +
                          ": lies among the templates (engine.templates), which it would change; "
                          "name a folder outside with --out");
}

std::vector<std::string> FilledCommand(const CommandOptions& engine, const TemplateValues& values) {
  std::vector<std::string> command;
  for (const TextTemplate& part : CommandParts(engine)) command.push_back(part.Fill(values));
  return command;
}

}  // namespace talus::trials
