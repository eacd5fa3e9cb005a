// talus design
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "experiments/analysis/design/design_spec.h"
#include "experiments/analysis/design/design_text.h"
#include "experiments/analysis/design/rank_designs.h"
#include "experiments/app/command_line.h"
#include "experiments/app/commands.h"
#include "experiments/campaign/answer/consider.h"
#include "experiments/campaign/folder/design_folder.h"
#include "experiments/campaign/make_parts.h"

namespace talus::app {
namespace {

struct DesignArguments {
  std::string spec;
  std::vector<std::string> supposed;
  std::string out;
  bool json = false;
};

// Empty where nothing is supposed.
campaign::GivenSet Supposed(const analysis::DesignSpec& design,
                            const std::vector<std::string>& arguments) {
  if (arguments.empty()) return {};
  return campaign::ReadSet(campaign::SpaceOf(design.campaign), ReadSetArgument(arguments),
                           campaign::MayLack::kAny);
}

void Design(const DesignArguments& arguments) {
  const analysis::DesignSpec design = analysis::LoadDesignSpec(arguments.spec);
  const campaign::GivenSet supposed = Supposed(design, arguments.supposed);
  const std::filesystem::path folder =
      arguments.out.empty() ? std::filesystem::path(arguments.spec).stem().concat("_design")
                            : std::filesystem::path(arguments.out);
  base::ClaimOutputFolder(folder, "design");
  const campaign::CampaignLock lock(folder);  // its simulations are one process's at a time
  const campaign::JointView view = analysis::ViewOf(design, folder);
  const analysis::DesignTable table =
      analysis::RankDesigns(view, design.candidates,
                            campaign::MakeParts(view.spec, campaign::NextFolder(folder)), supposed);
  const std::string json = analysis::DesignJson(table);
  base::WriteFileAtomically(folder / "design.json", json);
  std::cout << (arguments.json ? json : analysis::DesignText(table, view, design.candidates))
            << std::flush;
}

}  // namespace

void AddDesignCommand(CLI::App& app) {
  auto arguments = std::make_shared<DesignArguments>();
  CLI::App* command =
      app.add_subcommand("design", "Before the bench: which one, two or three tests would decide");
  command
      ->add_option("SPEC", arguments->spec,
                   "a campaign's spec without data; `candidates` are the tests that could be made")
      ->required();
  command->add_option("SET", arguments->supposed,
                      "NAME=VALUE …: a powder that is supposed, as far as it is known");
  command->add_option("--out", arguments->out,
                      "folder for its simulations; default: the spec's name and _design");
  command->add_flag("--json", arguments->json, "as JSON");
  command->callback([arguments] { Design(*arguments); });
}

}  // namespace talus::app
