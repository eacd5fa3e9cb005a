// The input files of another engine, with placeholders where a trial's values go.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/problems.h"
#include "experiments/trials/engines/command_options.h"
#include "experiments/trials/engines/template_text.h"

namespace talus::trials {

// The folder's files, read once.
class TemplateFolder {
 public:
  // Throws ConfigError that names the folder, or the file and line of a broken tag.
  explicit TemplateFolder(const std::filesystem::path& folder);

  // Every unknown name, and every name of `needed` that no file and no part of `command` uses.
  void Check(const CommandOptions& engine, const TemplateValues& known,
             std::span<const std::string> needed, base::Problems& problems) const;

  // Whether a value or table is used anywhere.
  bool Uses(const CommandOptions& engine, const std::string& name) const;

  // The first value that is used and differs by more than rounding, in words.
  std::optional<std::string> Difference(const CommandOptions& engine, const TemplateValues& there,
                                        const TemplateValues& here) const;

  // The hash of names and contents; 16 hexadecimal digits.
  std::string Hash() const;

  // Makes the folders, empty ones too, and writes the filled files with the permissions of their
  // templates.
  void Fill(const TemplateValues& values, const std::filesystem::path& target) const;

 private:
  struct File {
    std::filesystem::path path;  // relative to the folder
    std::string bytes;
    std::optional<TextTemplate> text;  // without one it is copied as it is
  };
  std::filesystem::path folder_;
  std::vector<File> files_;                     // by name
  std::vector<std::filesystem::path> folders_;  // relative to the folder, in any order
};

// Throws ConfigError where a run's folder would lie among the templates, which it would change.
void RequireOutside(const CommandOptions& engine, const std::filesystem::path& folder);

// The command with its placeholders filled.
std::vector<std::string> FilledCommand(const CommandOptions& engine, const TemplateValues& values);

}  // namespace talus::trials
