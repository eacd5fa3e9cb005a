// talus add-experiment
#include "experiments/campaign/add_experiment.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "base/units.h"
#include "experiments/app/command_line.h"
#include "experiments/app/commands.h"
#include "experiments/app/go_on.h"

namespace talus::app {

void AddAddExperimentCommand(CLI::App& app) {
  struct Arguments {
    std::string folder;
    std::string file;
    std::string core_time;
    TellOptions tell;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "add-experiment", "Give a campaign a further test of the same powder, and go on with both");
  command->add_option("DIR", arguments->folder, "the campaign's folder")->required();
  command
      ->add_option("EXPERIMENT", arguments->file,
                   "JSON file with one entry of `experiments` (docs/experiments.md)")
      ->required();
  command->add_option("--core-time", arguments->core_time,
                      "for the search with it, as \"10 min\"; default: as much as it has used, or "
                      "16 simulations of the test at the "
                      "smallest scale factor where it has not ended");
  AddTellFlags(*command, arguments->tell);
  command->callback([arguments] {
    campaign::AddOptions options;
    if (!arguments->core_time.empty()) {
      options.core_time = FlagQuantity("--core-time", arguments->core_time, base::Dimension::kTime);
    }
    {
      campaign::Console console(campaign::CampaignFolder{arguments->folder}.log(),
                                arguments->tell.output());
      campaign::AddExperiment(arguments->folder, arguments->file, options, console);
    }
    GoOn(arguments->folder, {}, arguments->tell);
  });
}

}  // namespace talus::app
