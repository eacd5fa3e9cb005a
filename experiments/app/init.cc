// talus init
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_file.h"
#include "base/problems.h"
#include "base/text/counted.h"
#include "base/units.h"
#include "experiments/app/commands.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/campaign/spec/spec_draft.h"
#include "imaging/photos/photo_set.h"

namespace talus::app {
namespace {

struct InitArguments {
  std::vector<std::string> photos;
  std::filesystem::path out = "campaign.json";
  std::vector<std::string> tests;
  campaign::SpecAnswers answers;
};

// Something that only the bench knows.
struct Question {
  const char* flag;
  const char* words;    // of the question and the help
  const char* example;  // with its unit
  base::Dimension dimension;
  std::string campaign::SpecAnswers::*answer;
  bool may_be_open = false;  // without it the spec searches it
};
using enum base::Dimension;
constexpr Question kQuestions[] = {
    {"--plate-diameter", "diameter of the plate", "10 mm", kLength,
     &campaign::SpecAnswers::plate_diameter},
    {"--tube-diameter", "inner diameter of the tube", "10 mm", kLength,
     &campaign::SpecAnswers::tube_diameter},
    {"--lift-velocity", "speed at which the tube is lifted", "10 mm/s", kVelocity,
     &campaign::SpecAnswers::lift_velocity},
    {"--mass", "mass filled into the tube", "1.5 g", kMass, &campaign::SpecAnswers::mass},
    {"--density", "density of the grains", "4400 kg/m^3", kDensity,
     &campaign::SpecAnswers::density},
    {"--grain-diameter", "median diameter of the grains", "80 um", kLength,
     &campaign::SpecAnswers::grain_diameter},
    {"--restitution", "coefficient of restitution of the grains", "0.8", kNone,
     &campaign::SpecAnswers::restitution, true},
    {"--rolling-damping", "rolling damping of the EPSD law", "0.3", kNone,
     &campaign::SpecAnswers::rolling_damping, true},
};

// Until the answer is a quantity; nothing where there is no more input, or nobody knows it.
std::string Ask(const Question& question) {
  std::string answer;
  while (std::cin) {
    std::cerr << question.words << " (such as " << question.example
              << (question.may_be_open ? "; Enter when nobody has measured it" : "")
              << "): " << std::flush;
    if (!std::getline(std::cin, answer)) continue;
    if (answer.empty() && question.may_be_open) return answer;
    if (answer.empty()) continue;
    try {
      base::ParseQuantity(answer, question.dimension);
      return answer;
    } catch (const base::ConfigError& error) {
      std::cerr << error.what() << '\n';
    }
  }
  return {};
}

bool AsksOnTerminal() { return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDERR_FILENO) == 1; }

// A line of input; empty where there is none, or the usual answer is taken.
std::string AskLine(const std::string& words) {
  std::string answer;
  std::cerr << words << ": " << std::flush;
  std::getline(std::cin, answer);
  return answer;
}

std::string WordsOf(const campaign::TestQuestion& question) {
  std::string words = "  " + question.key + ", " + question.words;
  if (!question.is_number) return words + " (Enter: " + question.usual + ")";
  return words + " (\"value ± error\"" +
         (question.usual_error.empty() ? "" : "; without an error ± " + question.usual_error) +
         "; Enter: not measured)";
}

// The other tests that were made of the powder, one after the other, until there are no more.
void AskTests(campaign::SpecAnswers& answers) {
  while (std::cin) {
    const std::string name = AskLine("a further test of the same powder, if one was made (" +
                                     campaign::TestNames() + "; Enter: none)");
    if (name.empty()) return;
    try {
      campaign::DraftTest test = campaign::ParseDraftTest(name);
      for (const campaign::TestQuestion& question : campaign::QuestionsOf(test.kind)) {
        test.answers.emplace_back(question.key, AskLine(WordsOf(question)));
      }
      campaign::DraftTestText(test);
      answers.tests.push_back(std::move(test));
    } catch (const base::ConfigError& error) {
      std::cerr << error.what() << '\n';
    }
  }
}

// Asks on a terminal; elsewhere every missing flag is named at once.
void Complete(campaign::SpecAnswers& answers) {
  const bool asks = AsksOnTerminal();
  base::Problems problems;
  for (const Question& question : kQuestions) {
    std::string& answer = answers.*question.answer;
    if (asks && answer.empty()) answer = Ask(question);
    if (answer.empty() && !question.may_be_open) {
      problems.Add(question.flag, std::string("is missing; give the ") + question.words + ": \"" +
                                      question.example + "\"");
    }
  }
  problems.ThrowIfAny();
  if (asks && answers.tests.empty()) AskTests(answers);
}

// Names in the spec are as seen from the spec's own folder.
std::filesystem::path SeenFrom(const std::filesystem::path& spec,
                               const std::filesystem::path& photo) {
  const auto folder = std::filesystem::absolute(spec).parent_path();
  return std::filesystem::absolute(photo).lexically_normal().lexically_proximate(
      folder.lexically_normal());
}

std::size_t NumFiles(const std::filesystem::path& folder) {
  std::error_code none;
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, none)) {
    count += entry.is_regular_file(none);
  }
  return count;
}

void Say(const std::vector<std::string>& photos, const std::string& pattern,
         const imaging::PhotoSet& set) {
  std::size_t views = 0;
  std::string names;
  for (const imaging::PhotoFiles& run : set.runs) {
    views += run.views.size();
    names += (names.empty() ? " (" : ", ") + run.run;
  }
  std::cout << (photos.size() == 1 ? photos.front() + ": " : "")
            << base::Counted(static_cast<long long>(set.runs.size()), "heap") << names << "), "
            << views << " photographs, read by the pattern \"" << pattern
            << "\"; name another with --pattern\n";
  if (photos.size() != 1) return;
  const std::size_t files = NumFiles(photos.front());
  if (files > views) {
    std::cout << "note: " << base::Counted(static_cast<long long>(files - views), "other file")
              << " in it not read by this pattern\n";
  }
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
  const std::string pattern =
      answers.pattern.empty() ? imaging::RecognisePattern(files) : answers.pattern;
  const imaging::PhotoSet set = imaging::SortPhotos(files, pattern);
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
    throw base::ConfigError("the pattern \"" + pattern + "\" fits " + std::to_string(matched) +
                            " of " + std::to_string(files.size()) +
                            " photographs; give one that fits all with --pattern");
  }
  Say(arguments.photos, pattern, set);
}

void FindPhotographs(const InitArguments& arguments, campaign::SpecAnswers& answers) {
  const std::string& first = arguments.photos.front();
  if (arguments.photos.size() > 1 || !std::filesystem::is_directory(first)) {
    AddRuns(arguments, answers);
    return;
  }
  if (answers.pattern.empty())
    answers.pattern = imaging::RecognisePattern(std::filesystem::path(first));
  Say(arguments.photos, answers.pattern, imaging::FindPhotos(first, answers.pattern));
  answers.folder = SeenFrom(arguments.out, first);
}

void Init(const InitArguments& arguments) {
  if (std::filesystem::exists(arguments.out)) {
    throw base::ConfigError(arguments.out.string() +
                            ": is there already; name another file with --out");
  }
  campaign::SpecAnswers answers = arguments.answers;
  for (const std::string& test : arguments.tests) {
    answers.tests.push_back(campaign::ParseDraftTest(test));
  }
  FindPhotographs(arguments, answers);
  Complete(answers);
  const std::string text = campaign::DraftSpec(answers);
  campaign::ReadCampaignSpec(base::ParseJson(text, arguments.out.string()));
  base::WriteFileAtomically(arguments.out, text);
  std::cout << arguments.out.string() << ": written; read its comments, then `talus validate "
            << arguments.out.string() << "` says what it will cost\n";
}

}  // namespace

void AddInitCommand(CLI::App& app) {
  auto arguments = std::make_shared<InitArguments>();
  CLI::App* verb =
      app.add_subcommand("init", "Write a commented spec for photographs of a heap, to start from");
  verb->add_option("PHOTOS", arguments->photos,
                   "a folder of photographs, or photographs one by one")
      ->required();
  verb->add_option("--out", arguments->out, "file to write")->capture_default_str();
  verb->add_option("--name", arguments->answers.name, "of the powder; default: that of the folder");
  verb->add_option(
      "--pattern", arguments->answers.pattern,
      "of the photographs' names: {run}, {view}, *, such as {run}/{view}.jpg; default: "
      "what fits");
  for (const Question& question : kQuestions) {
    verb->add_option(question.flag, arguments->answers.*question.answer,
                     std::string(question.words) +
                         (question.may_be_open ? "; without it the spec searches it, as a nuisance"
                                               : " with its unit, such as \"" +
                                                     std::string(question.example) + "\""));
  }
  verb->add_option(
      "--scale", arguments->answers.scale,
      "of a heap on a table without a plate: two points in pixels and the length between "
      "them, such as \"104,310-884,312=30mm\"");
  verb->add_flag("--cohesive", arguments->answers.cohesive,
                 "search the surface energy, too: fine or moist powder");
  verb->add_option("--test", arguments->tests,
                   "a further test of the same powder, such as "
                   "\"tapped_density:diameter=12mm,tapped_density=1480kg/m^3±5kg/m^3\"; any of " +
                       campaign::TestNames())
      ->allow_extra_args(false);
  verb->footer("On a terminal it asks for what is not given.");
  verb->callback([arguments] {
    if (arguments->answers.name.empty()) {
      const auto path = std::filesystem::absolute(arguments->photos.front()).lexically_normal();
      const bool ends_with_slash = path.filename().empty();
      arguments->answers.name = (ends_with_slash ? path.parent_path() : path).stem().string();
    }
    Init(*arguments);
  });
}

}  // namespace talus::app
