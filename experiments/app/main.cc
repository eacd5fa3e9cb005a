// The program `talus`.
#include <CLI/CLI.hpp>
#include <iostream>

#include "base/error.h"
#include "base/version.h"
#include "experiments/app/commands.h"

namespace {
int Run(int argc, char** argv) {
  CLI::App app("talus: calibrates discrete element models of powders from photographs of heaps");
  app.set_version_flag("--version", "talus " + talus::base::Version());
  app.require_subcommand(1);
  talus::experiments::AddCompareCommand(app);
  talus::experiments::AddReportCommand(app);
  talus::experiments::AddMeasureCommand(app);
  talus::experiments::AddValidateCommand(app);
  talus::experiments::AddCalibrateCommand(app);
  talus::experiments::AddResumeCommand(app);
  talus::experiments::AddStatusCommand(app);
  talus::experiments::AddConsiderCommand(app);
  talus::experiments::AddExportCommand(app);
  talus::experiments::AddSimulateCommand(app);
  talus::experiments::AddOptimizeCommand(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? talus::base::kExitDone : talus::base::kExitBadInput;
  }
  return talus::base::kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return Run(argc, argv);
  } catch (const talus::base::ConfigError& error) {
    std::cerr << error.what() << '\n';
    return talus::base::kExitBadInput;
  } catch (const talus::base::Interrupted& error) {
    std::cerr << "talus: " << error.what() << '\n';
    return talus::base::kExitInterrupted;
  } catch (const std::exception& error) {
    std::cerr << "talus: " << error.what() << '\n';
    return talus::base::kExitFailed;
  }
}
