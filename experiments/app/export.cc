// talus export
#include "experiments/analysis/export/export.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "experiments/app/commands.h"

namespace talus::app {

void AddExportCommand(CLI::App& app) {
  struct Arguments {
    std::string folder;
    std::string out;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("export", "Write a campaign's trials as trials.csv and trials.json");
  command->add_option("DIR", arguments->folder, "the campaign's folder")->required();
  command->add_option("--out", arguments->out, "folder for the two files; default: DIR/export");
  command->callback([arguments] {
    const std::filesystem::path folder = arguments->folder;
    const std::filesystem::path out =
        arguments->out.empty() ? folder / "export" : std::filesystem::path(arguments->out);
    analysis::ExportCampaign(folder, out);
    std::cout << "written: " << (out / "trials.csv").string() << ", "
              << (out / "trials.json").string() << std::endl;
  });
}

}  // namespace talus::app
