// talus consider
#include "experiments/campaign/answer/consider.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "experiments/app/command_line.h"
#include "experiments/app/commands.h"
#include "experiments/app/doubts.h"
#include "experiments/campaign/answer/hold_out.h"

namespace talus::app {
namespace {

struct ConsiderArguments {
  std::string folder;
  std::vector<std::string> set;
  std::string hold_out;
  bool alone = false;
  bool json = false;
};

std::string Considered(const ConsiderArguments& arguments) {
  if (!arguments.hold_out.empty()) {
    const campaign::JointView view = campaign::ReadJointView(arguments.folder);
    const campaign::HeldOut held_out = campaign::HoldOut(view, arguments.hold_out);
    return arguments.json ? campaign::HeldOutJson(view, held_out)
                          : campaign::HeldOutText(view, held_out);
  }
  if (arguments.alone) {
    const campaign::JointView view = campaign::ReadJointView(arguments.folder);
    const std::vector<campaign::PartialAnswer> answers = campaign::AnswersAlone(view);
    return arguments.json ? campaign::AloneJson(view, answers) : campaign::AloneText(view, answers);
  }
  if (arguments.set.empty()) {
    throw base::ConfigError(
        "talus consider: give NAME=VALUE of every calibrated parameter, "
        "--hold-out NAME or --alone");
  }
  const campaign::ConsideredSet considered =
      campaign::ConsiderSet(arguments.folder, ReadSetArgument(arguments.set));
  return arguments.json ? campaign::ConsideredJson(considered)
                        : campaign::ConsideredText(considered);
}

}  // namespace

void AddConsiderCommand(CLI::App& app) {
  auto arguments = std::make_shared<ConsiderArguments>();
  CLI::App* command = app.add_subcommand(
      "consider", "Where a given parameter set stands in what a campaign's trials say");
  command->add_option("DIR", arguments->folder, "the campaign's folder; it may be running")
      ->required();
  CLI::Option* set =
      command->add_option("SET", arguments->set, "NAME=VALUE of every calibrated parameter");
  CLI::Option* hold_out = command
                              ->add_option("--hold-out", arguments->hold_out,
                                           "what the other experiments answer, and what they "
                                           "predict of this one")
                              ->excludes(set);
  command->add_flag("--alone", arguments->alone, "what each experiment answers by itself")
      ->excludes(set)
      ->excludes(hold_out);
  command->add_flag("--json", arguments->json, "as JSON");
  command->callback([arguments] {
    const std::string text = Considered(*arguments);
    WarnOfDoubts(arguments->folder);
    std::cout << text << std::flush;
  });
}

}  // namespace talus::app
