// talus init
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_file.h"
#include "base/problems.h"
#include "base/text/name.h"
#include "base/text/number_text.h"
#include "base/text/shell_text.h"
#include "experiments/app/bench_questions.h"
#include "experiments/app/commands.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/campaign/spec/spec_draft.h"
#include "imaging/photos/experiment.h"
#include "imaging/photos/photo_set.h"

namespace talus::app {
namespace {

struct InitArguments {
  std::vector<std::string> photos;
  std::filesystem::path out = "campaign.json";
  std::vector<std::string> tests;
  campaign::SpecAnswers answers;
};

// Names in the spec are as seen from the spec's own folder.
std::filesystem::path SeenFrom(const std::filesystem::path& spec,
                               const std::filesystem::path& photo) {
  if (!base::IsUtf8(photo.string())) {
    throw base::ConfigError(photo.string() +
                            ": its name is not UTF-8, as the text of a spec must be; rename it");
  }
  const auto folder = std::filesystem::absolute(spec).parent_path();
  return std::filesystem::absolute(photo).lexically_normal().lexically_proximate(
      folder.lexically_normal());
}

// How the photographs are read, and what a reader may want to change of it.
void Say(const imaging::PhotoSet& set, const std::string& unread) {
  std::cout << imaging::ReadingText(set) << " (name another with --pattern)\n";
  if (!unread.empty()) std::cout << "note: " << unread << '\n';
  if (set.missing.empty()) return;
  std::cout << "note: " << imaging::MissingText(set)
            << ": the spec goes on without (allow_missing_views)\n";
}

// Photographs one by one: what their names say of runs, or else views of one heap.
void AddRuns(const InitArguments& arguments, campaign::SpecAnswers& answers) {
  base::Problems problems;
  for (const std::string& photo : arguments.photos) {
    problems.Require(std::filesystem::is_regular_file(photo), photo,
                     "is not there; give a folder of photographs, or photographs one by one");
  }
  problems.ThrowIfAny();
  const std::vector<std::filesystem::path> files(arguments.photos.begin(), arguments.photos.end());
  const imaging::PhotoSet set = imaging::SortPhotos(files, answers.pattern);
  answers.missing = imaging::MissingText(set);
  std::size_t matched = 0;
  for (const imaging::PhotoFiles& run : set.runs) {
    imaging::PhotoRun named{.name = run.run, .photos = {}};
    for (const imaging::PhotoFile& view : run.views) {
      named.photos.push_back(SeenFrom(arguments.out, view.path));
    }
    matched += named.photos.size();
    answers.runs.push_back(std::move(named));
  }
  if (matched != files.size()) {
    throw base::ConfigError("the pattern \"" + set.pattern + "\" fits " + std::to_string(matched) +
                            " of " + std::to_string(files.size()) +
                            " photographs; give one that fits all with --pattern");
  }
  Say(set, "");
}

void FindPhotographs(const InitArguments& arguments, campaign::SpecAnswers& answers) {
  const std::string& first = arguments.photos.front();
  if (arguments.photos.size() > 1 || !std::filesystem::is_directory(first)) {
    AddRuns(arguments, answers);
    return;
  }
  const imaging::PhotoSet set = imaging::FindPhotos(first, answers.pattern);
  answers.pattern = set.pattern;
  answers.missing = imaging::MissingText(set);
  std::cout << first << ": ";
  Say(set, imaging::UnreadText(first, set));
  answers.folder = SeenFrom(arguments.out, first);
}

// Without a plate the table counts as far as `measure` has it, which the simulated plate is as wide
// as: a little farther than the heap reaches.
void MeasureTable(const std::filesystem::path& out, campaign::SpecAnswers& answers) {
  if (!answers.HasPhotographs() || answers.scale.empty() || !answers.plate_diameter.empty()) return;
  const auto folder = std::filesystem::absolute(out).parent_path();
  imaging::ExperimentOptions options;
  options.pattern = answers.pattern;
  options.scale = answers.scale;
  if (!answers.folder.empty()) options.photos = folder / answers.folder;
  options.runs = answers.runs;
  options.allow_missing_views = !answers.missing.empty();
  for (imaging::PhotoRun& run : options.runs) {
    for (auto& photo : run.photos) photo = folder / photo;
  }
  try {
    const imaging::Experiment heap = imaging::MeasureExperiment(options);
    answers.plate_diameter = base::ShortNumber(1e3 * heap.aehp.frame.plate_diameter) + " mm";
  } catch (const imaging::UnusablePhotosError& error) {
    throw base::ConfigError(std::string(error.what()) +
                            "\n--plate-diameter: is missing, and these photographs do not give "
                            "it; write how wide the part of the table is that counts, such as 1.1 "
                            "times the heap");
  } catch (const base::ConfigError& error) {
    throw base::ConfigError("--scale: " + std::string(error.what()));
  }
  std::cout << "the table counts over " << answers.plate_diameter
            << ", 1.1 times the heap, and the simulated plate is as wide (another with "
               "--plate-diameter)\n";
}

// A folder of photographs, if some were taken; there may be other tests only.
void AskForPhotographs(InitArguments& arguments) {
  while (std::cin && arguments.photos.empty()) {
    const std::string folder =
        AskLine("folder of the photographs of a heap (Enter: none, other tests were made)");
    if (folder.empty()) return;
    if (std::filesystem::exists(folder)) {
      arguments.photos.push_back(folder);
    } else {
      std::cerr << folder << ": is not there\n";
    }
  }
}

// That of the photographs' folder, in which a dot may stand: "Ti64_v1.2".
std::string NameOf(const InitArguments& arguments) {
  if (!arguments.answers.name.empty()) return arguments.answers.name;
  if (arguments.photos.empty()) return arguments.out.stem().string();
  const auto path = std::filesystem::absolute(arguments.photos.front()).lexically_normal();
  const bool ends_with_slash = path.filename().empty();
  std::error_code unread;  // what cannot be looked at is refused with the photographs
  const bool is_folder = !ends_with_slash && std::filesystem::is_directory(path, unread);
  const std::string name = (is_folder ? path : path.parent_path()).filename().string();
  return name.empty() ? arguments.out.stem().string() : name;
}

std::string CheckedSpec(const campaign::SpecAnswers& answers, const std::filesystem::path& out) {
  std::string text = campaign::DraftSpec(answers);
  const base::JsonFile file = base::ParseJson(text, out.string());
  try {
    campaign::ReadCampaignSpec(file);
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(ProblemsByFlag(error.what(), answers, out.string()));
  }
  return text;
}

// On a terminal the answers are asked for again until they go together.
std::string SpecOf(campaign::SpecAnswers& answers, const std::filesystem::path& out) {
  while (true) {
    try {
      return CheckedSpec(answers, out);
    } catch (const base::ConfigError& error) {
      if (!AsksOnTerminal()) throw;
      std::cerr << error.what() << "\nonce more, from the beginning; Enter keeps an answer\n";
      if (!AskAgain(answers)) return CheckedSpec(answers, out);  // by what is answered now
    }
  }
}

void Init(InitArguments& arguments) {
  if (std::filesystem::exists(arguments.out)) {
    throw base::ConfigError(arguments.out.string() +
                            ": is there already; name another file with --out");
  }
  const auto folder = std::filesystem::absolute(arguments.out).parent_path();
  if (!std::filesystem::is_directory(folder)) {
    throw base::ConfigError(arguments.out.string() + ": there is no folder " + folder.string() +
                            "; make it, or name another file with --out");
  }
  if (arguments.photos.empty() && AsksOnTerminal()) AskForPhotographs(arguments);
  campaign::SpecAnswers answers = arguments.answers;
  if (!answers.name.empty()) {  // no answer could mend it
    base::Problems problems;
    base::RequireName(problems, "--name", answers.name);
    problems.ThrowIfAny();
  }
  answers.name = NameOf(arguments);
  for (const std::string& test : arguments.tests) {
    answers.tests.push_back(campaign::ParseDraftTest(test));
  }
  if (arguments.photos.empty() && answers.tests.empty() && !AsksOnTerminal()) {
    throw base::ConfigError(
        "PHOTOS or --test is required, since there is nothing to calibrate on, and with them the "
        "powder: --mass, --density and --grain-diameter; `talus help init` says more");
  }
  if (!arguments.photos.empty()) FindPhotographs(arguments, answers);
  MeasureTable(arguments.out, answers);
  std::string text;
  try {
    Complete(answers);
    text = SpecOf(answers, arguments.out);
  } catch (const base::ConfigError&) {
    const std::string flags = AnswerFlags(answers);
    if (AsksOnTerminal() && !flags.empty()) {
      std::cerr << "\nthe answers so far, for another try:" << flags << '\n';
    }
    throw;
  }
  base::WriteFileAtomically(arguments.out, text);
  std::cout << arguments.out.string() << ": written; read its comments, then `talus validate "
            << base::ShellWord(arguments.out.string()) << "` says what it will cost\n";
}

}  // namespace

void AddInitCommand(CLI::App& app) {
  auto arguments = std::make_shared<InitArguments>();
  CLI::App* verb =
      app.add_subcommand("init", "Write a commented spec for photographs of a heap, to start from");
  verb->add_option("PHOTOS", arguments->photos,
                   "a folder of photographs, or photographs one by one; none where other tests "
                   "were made only");
  verb->add_option("--out", arguments->out, "file to write")->capture_default_str();
  verb->add_option("--name", arguments->answers.name,
                   "of the powder; default: that of the photographs' folder, else of the file");
  verb->add_option(
      "--pattern", arguments->answers.pattern,
      "of the photographs' names: {run}, {view}, *, such as {run}/{view}.jpg; default: "
      "what fits");
  AddQuestionFlags(*verb, arguments->answers);
  verb->add_option(
      "--scale", arguments->answers.scale,
      "of a heap on a table without a plate: two points in pixels and the length between "
      "them, such as \"104,310-884,312=30mm\"; --plate-diameter is then the part of the table "
      "that counts, by default 1.1 times the heap");
  verb->add_flag("--cohesive", arguments->answers.cohesive,
                 "search the surface energy, too: fine or moist powder");
  verb->add_option("--test", arguments->tests,
                   "a test of the same powder, such as "
                   "\"tapped_density:diameter=12mm,tapped_density=1480kg/m^3±5kg/m^3\"; with "
                   "photographs of a heap or alone, any of " +
                       campaign::TestNames())
      ->allow_extra_args(false);
  verb->footer("On a terminal it asks for what is not given.");
  verb->callback([arguments] { Init(*arguments); });
}

}  // namespace talus::app
