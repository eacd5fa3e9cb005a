// talus predict
#include "experiments/analysis/predict/predict.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/name.h"
#include "experiments/analysis/predict/prediction_text.h"
#include "experiments/app/command_line.h"
#include "experiments/app/commands.h"
#include "experiments/app/doubts.h"
#include "experiments/campaign/make_parts.h"

namespace talus::app {
namespace {

struct PredictArguments {
  std::string folder;
  std::vector<std::string> cases;
  std::vector<std::string> set;
  analysis::PredictOptions options;
  std::string budget;
  bool json = false;
};

// A prediction stands in a folder of its case's name.
void CheckNames(const std::vector<std::string>& cases) {
  std::map<std::string, std::string> files;
  for (const std::string& file : cases) {
    const auto [other, is_new] =
        files.emplace(base::FileWord(std::filesystem::path(file).stem().string()), file);
    if (is_new) continue;
    throw base::ConfigError(file + ": would be predicted in the same folder as " + other->second +
                            "; give each case its own file name");
  }
}

analysis::PredictOptions OptionsFor(const std::string& file, const PredictArguments& arguments) {
  analysis::PredictOptions options = arguments.options;
  options.file = file;
  options.set = ReadSetArgument(arguments.set);
  if (!arguments.budget.empty()) {
    options.core_time = FlagQuantity("--budget", arguments.budget, base::Dimension::kTime);
  }
  return options;
}

void RunPredict(const PredictArguments& arguments) {
  CheckNames(arguments.cases);
  const campaign::JointView view = campaign::ReadJointView(arguments.folder);
  WarnOfDoubts(arguments.folder);
  // What is wrong with the last case shows before the first is simulated.
  for (const std::string& file : arguments.cases) {
    analysis::CheckPrediction(view, OptionsFor(file, arguments));
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::string& file : arguments.cases) {
    const analysis::PredictOptions options = OptionsFor(file, arguments);
    // A queue's own files stand with the prediction's: another may be made at the same time.
    const analysis::Prediction prediction = analysis::Predict(
        view, options,
        campaign::MakeParts(view.spec, analysis::PredictionFolder(view.folder.root, options)));
    if (prediction.runs.empty() && prediction.num_failed > 0) {
      if (arguments.json) std::cout << base::JsonText(list, 2) << std::endl;
      throw base::Error(file + ": every run failed, the last: " + prediction.failure);
    }
    if (arguments.json) {
      list.push_back(base::ToJson(prediction));
    } else {
      std::cout << analysis::PredictionText(prediction, view.record.parameters) << std::flush;
    }
  }
  if (arguments.json) std::cout << base::JsonText(list, 2) << std::endl;
}

}  // namespace

void AddPredictCommand(CLI::App& app) {
  const auto arguments = std::make_shared<PredictArguments>();
  analysis::PredictOptions& options = arguments->options;
  CLI::App* command = app.add_subcommand(
      "predict", "What the calibrated sets give in another test or process, and how sure that is");
  command->add_option("DIR", arguments->folder, "the campaign's folder; it may be running")
      ->required();
  command
      ->add_option("CASE", arguments->cases,
                   "cases of bulk tests, or scenes, as talus simulate takes them")
      ->required();
  CLI::Option* draws = command->add_option(
      "--draws", options.num_draws, "sets drawn from the posterior, from 2 to 200; default: 12");
  command->add_option("--seeds", options.num_seeds,
                      "runs of each set, from 1 to 100; default: 3, of one set alone 8");
  command
      ->add_option("--scale", options.scale_factors,
                   "scale factors of the grains, each 1 or more: at the finest all seeds of "
                   "every draw, at others one; default: the case's, else those of the "
                   "campaign's that --budget affords")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option(
      "--budget", arguments->budget,
      "core time for the runs of one case, such as \"10 min\"; one run a draw and seed at the "
      "scale factor that the case states, else at the coarsest of the campaign's, is made whatever "
      "it takes; default: 150 s");
  CLI::Option* set = command->add_option(
      "--set", arguments->set, "NAME=VALUE of every calibrated parameter: by this set alone");
  set->excludes(draws);
  command->add_flag("--recommended", options.recommended, "by the recommended set alone")
      ->excludes(set)
      ->excludes(draws);
  command
      ->add_option("--measured", options.measured,
                   "what was measured: a JSON file as an experiment of a spec, or a profile that "
                   "talus measure wrote")
      ->type_name("FILE");
  command->add_flag("--json", arguments->json, "as JSON");
  command->callback([arguments] { RunPredict(*arguments); });
}

}  // namespace talus::app
