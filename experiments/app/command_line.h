// The command line of the program as one thing: parsed by main, and described by `talus help`, the
// man pages and the shells' completions.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/units.h"

namespace CLI {
class App;
}

namespace talus::app {

// Adds every verb, and what all share: --version, one verb a call.
void DescribeCommandLine(CLI::App& app);

// "did you mean …" for a verb or flag that nearly names one, else where help is; empty when neither
// is misspelt. `arguments` are those after the program's name.
std::string Suggestion(const CLI::App& app, std::span<const char* const> arguments);

// What is typed after a flag, in SI; throws base::ConfigError that begins with the flag.
double FlagQuantity(const std::string& flag, const std::string& text, base::Dimension dimension);

// The core time that is typed after --budget [s]; throws base::ConfigError unless it is positive.
double BudgetTime(const std::string& text);

// NAME=VALUE in its two parts. Throws base::ConfigError, which shows `example`, for another form.
std::pair<std::string, std::string> ReadAssignment(const std::string& text,
                                                   const std::string& example);

// NAME=VALUE… as a parameter set. Throws base::ConfigError for another form, and for a name that is
// given twice.
std::map<std::string, std::string> ReadSetArgument(const std::vector<std::string>& texts);

// Roff of section 1: of the program, or of one verb.
std::string ManPage(const CLI::App& app);
std::string ManPage(const CLI::App& app, const CLI::App& verb);

enum class Shell { kBash, kZsh, kFish };
std::string CompletionScript(const CLI::App& app, Shell shell);

}  // namespace talus::app
