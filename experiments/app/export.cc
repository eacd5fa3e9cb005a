// talus export
#include "experiments/analysis/export/export.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "base/text/shell_text.h"
#include "experiments/analysis/export/paraview.h"
#include "experiments/app/commands.h"

namespace talus::app {

void AddExportCommand(CLI::App& app) {
  struct Arguments {
    std::string folder;
    std::string out;
    bool vtk = false;
    std::optional<std::int64_t> trial{};
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("export",
                         "Write a campaign's trials as trials.csv and trials.json, or a heap for "
                         "ParaView");
  command->add_option("DIR", arguments->folder, "the campaign's folder")->required();
  command->add_option("--out", arguments->out,
                      "folder for the files; default: DIR/export, with --vtk DIR/vtk");
  CLI::Option* vtk = command->add_flag(
      "--vtk", arguments->vtk, "a heap with plate and tube, and state.py, which ParaView opens");
  command
      ->add_option("--trial", arguments->trial,
                   "whose heap; default: of the recommended set, else the best so far")
      ->check(CLI::Range(std::int64_t{1}, std::numeric_limits<std::int64_t>::max()))
      ->needs(vtk);
  command->callback([arguments] {
    const std::filesystem::path folder = arguments->folder;
    const std::filesystem::path out = arguments->out.empty()
                                          ? folder / (arguments->vtk ? "vtk" : "export")
                                          : std::filesystem::path(arguments->out);
    if (arguments->vtk) {
      const auto state =
          analysis::ExportVtk({.campaign = folder, .out = out, .trial = arguments->trial});
      std::cout << "written: " << state.string()
                << "; paraview --state=" << base::ShellWord(state.string()) << " opens it"
                << std::endl;
      return;
    }
    analysis::ExportCampaign(folder, out);
    std::cout << "written: " << (out / "trials.csv").string() << ", "
              << (out / "trials.json").string() << std::endl;
  });
}

}  // namespace talus::app
