// talus next
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "base/files/file.h"
#include "experiments/analysis/next/next_text.h"
#include "experiments/analysis/next/rank_next.h"
#include "experiments/analysis/next/usual_tests.h"
#include "experiments/app/commands.h"
#include "experiments/campaign/folder/design_folder.h"
#include "experiments/campaign/make_parts.h"

namespace talus::app {
namespace {

struct NextArguments {
  std::string folder;
  std::string candidates;
  bool simulate = false;
  bool json = false;
};

void Next(const NextArguments& arguments) {
  const campaign::JointView view = campaign::ReadJointView(arguments.folder);
  // A queue's own files stand beside the designs, not among those of the campaign's trials.
  analysis::NextOptions options{
      .tests = arguments.candidates.empty() ? analysis::UsualTests(view)
                                            : analysis::LoadTests(arguments.candidates),
      .simulate = arguments.simulate,
      .parts = {.runner = campaign::MakeRunner(view.spec, campaign::NextFolder(view.folder.root)),
                .engine = campaign::MakeEngine(view.spec)}};
  const analysis::NextTable table = analysis::RankNext(view, options);
  const std::string json = analysis::NextJson(table);
  const std::filesystem::path folder = campaign::NextFolder(view.folder.root);
  std::filesystem::create_directories(folder);
  base::WriteFileAtomically(folder / "next.json", json);
  std::cout << (arguments.json ? json : analysis::NextText(table)) << std::flush;
}

}  // namespace

void AddNextCommand(CLI::App& app) {
  auto arguments = std::make_shared<NextArguments>();
  CLI::App* command = app.add_subcommand(
      "next", "Which test, photographs or simulations would teach most about the parameters");
  command->add_option("DIR", arguments->folder, "the campaign's folder")->required();
  command->add_option("CANDIDATES", arguments->candidates,
                      "JSON file of tests that could be made; default: the usual ones");
  command->add_flag("--simulate", arguments->simulate,
                    "run the few simulations of each test that tell what it would teach");
  command->add_flag("--json", arguments->json, "as JSON");
  command->callback([arguments] { Next(*arguments); });
}

}  // namespace talus::app
