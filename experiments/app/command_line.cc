#include "experiments/app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/nearest.h"
#include "base/version.h"
#include "experiments/app/commands.h"

namespace talus::app {
namespace {

const CLI::App* FindVerb(const CLI::App& app, std::string_view name) {
  for (const CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_name() == name) return verb;
  }
  return nullptr;
}

// Arguments before options: an option that takes several words would take the arguments, too.
class ArgumentsFirst : public CLI::Formatter {
 public:
  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string usage = CLI::Formatter::make_usage(app, name);
    const std::string options = " [" + get_label("OPTIONS") + "]";
    const auto at = usage.find(options);
    if (at == std::string::npos || !app->get_subcommands({}).empty()) return usage;
    usage.erase(at, options.size());
    usage.insert(usage.find_last_not_of('\n') + 1, options);
    return usage;
  }
};

}  // namespace

void DescribeCommandLine(CLI::App& app) {
  app.formatter(std::make_shared<ArgumentsFirst>());
  app.set_version_flag("--version", "talus " + base::Version());
  app.require_subcommand(1);
  AddInitCommand(app);
  AddMeasureCommand(app);
  AddValidateCommand(app);
  AddDesignCommand(app);
  AddCalibrateCommand(app);
  AddResumeCommand(app);
  AddAddExperimentCommand(app);
  AddStatusCommand(app);
  AddConsiderCommand(app);
  AddNextCommand(app);
  AddPredictCommand(app);
  AddSensitivityCommand(app);
  AddCompareCommand(app);
  AddReportCommand(app);
  AddCardCommand(app);
  AddExportCommand(app);
  AddSimulateCommand(app);
  AddOptimizeCommand(app);
  AddHelpCommand(app);
  AddManCommand(app);
  AddCompletionCommand(app);
}

std::string Suggestion(const CLI::App& app, std::span<const char* const> arguments) {
  if (arguments.empty() || arguments[0][0] == '-') return {};
  const std::string name = arguments[0];
  const CLI::App* const verb = FindVerb(app, name);
  std::vector<std::string> known;
  if (verb == nullptr) {
    for (const CLI::App* other : app.get_subcommands({})) known.push_back(other->get_name());
    return "no verb \"" + name + "\"" + base::DidYouMean(name, known) +
           "\n`talus help` lists the verbs";
  }
  for (const CLI::Option* option : verb->get_options({})) {
    for (const std::string& flag : option->get_lnames()) known.push_back("--" + flag);
  }
  for (const std::string_view argument : arguments.subspan(1)) {
    if (argument == "--") break;
    const std::string flag(argument.substr(0, argument.find('=')));
    if (!flag.starts_with("--") || std::ranges::find(known, flag) != known.end()) continue;
    return name + " has no flag \"" + flag + "\"" + base::DidYouMean(flag, known) +
           "\n`talus help " + name + "` lists its flags";
  }
  return {};
}

double FlagQuantity(const std::string& flag, const std::string& text, base::Dimension dimension) {
  try {
    return base::ParseQuantity(text, dimension);
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(flag + ": " + error.what());
  }
}

double BudgetTime(const std::string& text) {
  const double seconds = FlagQuantity("--budget", text, base::Dimension::kTime);
  if (seconds > 0) return seconds;
  throw base::ConfigError("--budget: must be positive, such as \"2 min\", not \"" + text + "\"");
}

std::pair<std::string, std::string> ReadAssignment(const std::string& text,
                                                   const std::string& example) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) {
    throw base::ConfigError("\"" + text + "\": must be NAME=VALUE, as " + example);
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::map<std::string, std::string> ReadSetArgument(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> set;
  for (const std::string& text : texts) {
    const auto [name, value] = ReadAssignment(text, "sliding_friction=0.45");
    if (!set.emplace(name, value).second) throw base::ConfigError(name + ": is given twice");
  }
  return set;
}

void AddHelpCommand(CLI::App& app) {
  auto name = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("help", "What the program, or one verb, does and takes");
  command->add_option("VERB", *name, "the verb; without one, all are listed");
  command->callback([&app, name] {
    if (name->empty()) {  // app.help() would be that of the verb at work, this one
      std::cout << app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
      return;
    }
    const CLI::App* const verb = FindVerb(app, *name);
    const char* const word = name->c_str();
    if (verb == nullptr) throw base::ConfigError(Suggestion(app, {&word, 1}));
    std::cout << verb->help(app.get_name());
  });
}

void AddManCommand(CLI::App& app) {
  auto name = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("man", "Print a man page: talus man calibrate | man -l -");
  command->add_option("VERB", *name, "the verb; without one, the page of the program");
  command->callback([&app, name] {
    if (name->empty()) {
      std::cout << ManPage(app);
      return;
    }
    const CLI::App* const verb = FindVerb(app, *name);
    const char* const word = name->c_str();
    if (verb == nullptr) throw base::ConfigError(Suggestion(app, {&word, 1}));
    std::cout << ManPage(app, *verb);
  });
}

void AddCompletionCommand(CLI::App& app) {
  constexpr std::pair<const char*, Shell> kShells[] = {
      {"bash", Shell::kBash}, {"zsh", Shell::kZsh}, {"fish", Shell::kFish}};
  auto name = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("completion", "Print what completes verbs and flags in a shell");
  std::vector<std::string> names;
  for (const auto& [word, shell] : kShells) names.emplace_back(word);
  command->add_option("SHELL", *name, "bash, zsh or fish")->required()->check(CLI::IsMember(names));
  command->callback([&app, name, kShells] {
    for (const auto& [word, shell] : kShells) {
      if (*name == word) std::cout << CompletionScript(app, shell);
    }
  });
}

}  // namespace talus::app
