#include "experiments/trials/simulate/simulate.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "experiments/app/commands.h"

namespace talus::app {

void AddSimulateCommand(CLI::App& app) {
  struct Options {
    std::string input;
    trials::SimulateOptions simulate;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("simulate", "Simulate one bulk test (a case) or one explicit scene");
  command->add_option("INPUT", options->input, "case.json or scene.json")->required();
  command->add_option("--out", options->simulate.run.folder,
                      "folder for the results; default: the input's name without its ending");
  command->add_flag("--fresh", options->simulate.run.fresh,
                    "begin anew instead of going on from a checkpoint or keeping a result");
  command->add_flag("--quiet", options->simulate.run.quiet, "nothing on standard output");
  command->add_option("--film", options->simulate.film,
                      "film of a bulk test, from its filling on: a .gif, or a folder for one PNG a "
                      "frame; begins anew");
  command->footer(
      "Writes heap.vtp, profile.png and result.json (a case) or states and result.json (a scene).\n"
      "Ctrl-C saves a checkpoint; the same command goes on from it with the same result.");
  command->callback([options] {
    const std::filesystem::path input = options->input;
    if (options->simulate.run.folder.empty()) options->simulate.run.folder = input.stem();
    trials::Simulate(input, options->simulate);
  });
}

}  // namespace talus::app
