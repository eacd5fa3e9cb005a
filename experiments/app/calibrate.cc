// talus calibrate, talus resume
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "experiments/analysis/next/campaign_goal.h"
#include "experiments/app/commands.h"
#include "experiments/app/go_on.h"
#include "experiments/campaign/start.h"

namespace talus::app {

void AddCalibrateCommand(CLI::App& app) {
  struct Arguments {
    std::string spec;
    std::string out;
    std::string hold_out;
    std::vector<std::string> reuse;
    TellOptions tell;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "calibrate", "Find the parameters whose simulated heap looks like the photographed one");
  command->add_option("SPEC", arguments->spec, "the campaign as a JSON file (docs/campaigns.md)")
      ->required();
  command->add_option("--out", arguments->out,
                      "folder for all it writes; default: the spec's name without .json");
  command->add_option("--hold-out", arguments->hold_out,
                      "name of an experiment: the answer is made without it and predicts it");
  command->add_option("--reuse", arguments->reuse,
                      "folders of former campaigns of the same powder, or of `talus design`: what "
                      "was simulated there is told to the search first");
  AddTellFlags(*command, arguments->tell);
  command->callback([arguments] {
    const std::filesystem::path folder = arguments->out.empty()
                                             ? std::filesystem::path(arguments->spec).stem()
                                             : std::filesystem::path(arguments->out);
    campaign::BeginOptions options{.check = [&](const campaign::CampaignSpec& spec) {
      analysis::CheckGoal(spec, base::ReadJsonFile(arguments->spec));
    }};
    if (!arguments->hold_out.empty()) options.hold_out = arguments->hold_out;
    options.reuse.assign(arguments->reuse.begin(), arguments->reuse.end());
    options.say = [&](const std::string& text) {
      campaign::Console(campaign::CampaignFolder{folder}.log(), arguments->tell.output())
          .Line(text);
    };
    campaign::BeginCampaign(arguments->spec, folder, options);
    GoOn(folder, {}, arguments->tell);
  });
}

void AddResumeCommand(CLI::App& app) {
  struct Arguments {
    std::string folder;
    campaign::ResumeOptions options;
    std::string spec;
    TellOptions tell;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("resume", "Go on with a campaign that was interrupted, or extend it");
  command->add_option("DIR", arguments->folder, "the campaign's folder")->required();
  command
      ->add_option("--add-simulations", arguments->options.add_simulations,
                   "so many more than the budget, or than it has when it is finished")
      ->check(CLI::Range(1, campaign::BudgetOptions::kMostSimulations));
  command
      ->add_option("--search", arguments->options.search,
                   "NAME=LOW..HIGH: searches a further parameter from now on, as a nuisance; the "
                   "trials so far stay")
      ->allow_extra_args(false);
  command->add_option("--spec", arguments->spec,
                      "the changed spec; default: the file it began with, if it is still there");
  AddTellFlags(*command, arguments->tell);
  command->callback([arguments] {
    arguments->options.spec = arguments->spec;
    GoOn(arguments->folder, arguments->options, arguments->tell);
  });
}

}  // namespace talus::app
