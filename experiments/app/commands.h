// The verbs of the program: each adds its subcommand, with help and options, to the command line. A
// verb's callback throws base::ConfigError or base::Error; main turns them into exit statuses.
#pragma once

namespace CLI {
class App;
}

namespace talus::app {

void AddCardCommand(CLI::App& app);
void AddCompareCommand(CLI::App& app);
void AddReportCommand(CLI::App& app);
void AddInitCommand(CLI::App& app);
void AddMeasureCommand(CLI::App& app);
void AddCalibrateCommand(CLI::App& app);
void AddAddExperimentCommand(CLI::App& app);
void AddConsiderCommand(CLI::App& app);
void AddNextCommand(CLI::App& app);
void AddPredictCommand(CLI::App& app);
void AddSensitivityCommand(CLI::App& app);
void AddDesignCommand(CLI::App& app);
void AddExportCommand(CLI::App& app);
void AddOptimizeCommand(CLI::App& app);
void AddResumeCommand(CLI::App& app);
void AddStatusCommand(CLI::App& app);
void AddValidateCommand(CLI::App& app);
void AddSimulateCommand(CLI::App& app);
void AddHelpCommand(CLI::App& app);
void AddManCommand(CLI::App& app);
void AddCompletionCommand(CLI::App& app);

}  // namespace talus::app
