#include "experiments/runners/slurm_options.h"

#include <array>
#include <string_view>

namespace talus::runners {
namespace {

struct OwnOption {
  std::string_view name;  // --name
  char letter;            // -l; 0: none
  const char* why;
};

constexpr const char* kFound = "would hide the trials' jobs from the campaign; leave it out";
constexpr const char* kPlaced = "would take the trials' files elsewhere; leave it out";
constexpr std::array<OwnOption, 17> kOwn{
    {{"job-name", 'J', kFound},
     {"array", 'a', "would run other tasks than the trials; \"max_jobs\" limits how many run"},
     {"clusters", 'M', "has jobs where squeue does not look; set SLURM_CLUSTERS for all of Slurm"},
     {"output", 'o', kPlaced},
     {"error", 'e', kPlaced},
     {"open-mode", 0, kPlaced},
     {"chdir", 'D', kPlaced},
     {"parsable", 0, kFound},
     {"quiet", 'Q', kFound},
     {"wait", 'W', "would hold the campaign up; leave it out"},
     {"wrap", 0, "takes the script's place; leave it out"},
     {"partition", 'p', "is what \"partition\" says; give it there"},
     {"account", 'A', "is what \"account\" says; give it there"},
     {"qos", 'q', "is what \"qos\" says; give it there"},
     {"time", 't', "is what \"time\" says; give it there"},
     {"mem", 0, "is what \"memory\" says; give it there"},
     {"cpus-per-task", 'c', "is what \"cores\" says; give it there"}}};

}  // namespace

// As getopt reads it: `--name=value`, `--name value`, any beginning of a name, `-lvalue`.
std::string OwnOptionOf(const std::string& directive) {
  if (!directive.starts_with("--")) {
    for (const OwnOption& own : kOwn) {
      if (directive.size() > 1 && own.letter != 0 && directive[1] == own.letter) return own.why;
    }
    return "";
  }
  const std::string name = directive.substr(2, directive.find_first_of("= \t") - 2);
  for (const OwnOption& own : kOwn) {
    if (!name.empty() && own.name.starts_with(name)) return own.why;
  }
  return "";
}

}  // namespace talus::runners
