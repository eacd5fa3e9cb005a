// talus next
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "base/error.h"
#include "experiments/analysis/next/advise.h"
#include "experiments/analysis/next/next_text.h"
#include "experiments/app/command_line.h"
#include "experiments/app/commands.h"
#include "experiments/app/doubts.h"
#include "experiments/campaign/folder/folder_in_text.h"

namespace talus::app {
namespace {

struct NextArguments {
  std::string folder;
  analysis::AdviceRequest request;
  std::string budget;
  std::string goal;
  std::string observable;
  bool json = false;
};

void Next(NextArguments& arguments) {
  if (!arguments.budget.empty()) {
    arguments.request.core_time = BudgetTime(arguments.budget);
  }
  if (!arguments.goal.empty()) {
    arguments.request.goal = {.file = arguments.goal, .observable = arguments.observable};
  }
  arguments.request.say = [](const std::string& text) { std::cerr << text << std::endl; };
  WarnOfDoubts(arguments.folder);
  const analysis::NextTable table = analysis::Advise(arguments.folder, arguments.request);
  std::cout << (arguments.json ? analysis::NextJson(table)
                               : campaign::WithFolder(analysis::NextText(table), arguments.folder))
            << std::flush;
}

}  // namespace

void AddNextCommand(CLI::App& app) {
  auto arguments = std::make_shared<NextArguments>();
  CLI::App* command = app.add_subcommand(
      "next", "Which test, photographs or simulations would teach most about the parameters");
  command->add_option("DIR", arguments->folder, "the campaign's folder")->required();
  command->add_option("CANDIDATES", arguments->request.candidates,
                      "JSON file of tests that could be made; default: the usual ones");
  CLI::Option* simulate =
      command->add_flag("--simulate", arguments->request.simulate,
                        "run the few simulations of each test that tell what it would teach");
  command
      ->add_option("--budget", arguments->budget,
                   "core time for these simulations, such as \"2 min\", the cheapest test first; "
                   "default: as much as the campaign has taken")
      ->needs(simulate);
  CLI::Option* goal = command->add_option(
      "--for", arguments->goal,
      "case or scene that is to be predicted: ranked by how much they narrow its number, which is "
      "simulated with a few draws first, as talus predict does");
  goal->type_name("CASE");
  command
      ->add_option("--observable", arguments->observable,
                   "the number that counts; default: the only one that the test is made for")
      ->needs(goal);
  command->add_flag("--json", arguments->json, "as JSON");
  command->callback([arguments] { Next(*arguments); });
}

}  // namespace talus::app
