#include "experiments/trials/optimize/optimize.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "base/error.h"
#include "base/files/output_folder.h"
#include "base/json/json_reader.h"
#include "base/json/json_schema.h"
#include "experiments/app/commands.h"
#include "experiments/trials/optimize/evaluator.h"

namespace talus::app {

void AddOptimizeCommand(CLI::App& app) {
  struct Options {
    std::string problem;
    std::vector<std::string> command;
    trials::OptimizeOutput output;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("optimize", "Find the parameters that minimise what a command returns");
  command->add_option("PROBLEM", options->problem, "problem.json: parameters, target, strategy")
      ->required();
  command->add_option("COMMAND", options->command, "after --: the command and its arguments")
      ->required();
  command->add_option("--out", options->output.folder,
                      "folder for log, images and result; run again, the search goes on there");
  command->add_flag("--quiet", options->output.quiet, "no progress on standard error");
  command->footer(
      "COMMAND reads the parameters as one JSON object, {\"mu_t\": 0.3, …, \"seed\": 17}, and "
      "writes\n"
      "{\"value\": …}, {\"profile\": \"file.png\"} or {\"field\": [[…], …]}. Another exit status "
      "than "
      "0,\n"
      "and an answer that makes no sense, is a failed evaluation.");
  command->callback([options] {
    const auto problem =
        base::LoadOptions<trials::OptimizeProblem>(base::ReadJsonFile(options->problem));
    const std::filesystem::path inputs[] = {
        options->problem,
        problem.target ? std::filesystem::path(problem.target->profile) : std::filesystem::path()};
    if (!options->output.folder.empty()) {
      trials::Evaluator(problem,
                        options->command);  // refuses what it cannot use before anything is written
      base::ClaimOutputFolder(options->output.folder, "optimize", inputs);
    }
    const trials::OptimizeEnd end = trials::Optimize(problem, options->command, options->output);
    if (options->output.folder.empty()) std::cout << end.result << std::flush;
    if (end.interrupted) throw base::Interrupted("interrupted; the same command goes on");
  });
}

}  // namespace talus::app
