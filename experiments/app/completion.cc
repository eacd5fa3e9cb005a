// Completion for the shells, from the same definitions as --help: verbs, their flags, and the words
// that a flag takes. Everything else is a file.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "base/text/joined.h"
#include "base/text/shell_text.h"
#include "experiments/app/command_line.h"

namespace talus::app {
namespace {

struct Flag {
  std::string name;  // with its hyphens
  std::string description;
  std::vector<std::string> words;  // that it takes; none: anything
  bool takes_value = false;
};

struct Verb {
  std::string name;
  std::string description;
  std::vector<Flag> flags;
  std::vector<std::string> words;  // of its first argument; none: files
};

// "TEXT:{bash,zsh}" → bash, zsh: how CLI11 writes a choice.
std::vector<std::string> Choices(const std::string& type) {
  std::vector<std::string> words;
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return words;
  std::size_t from = open + 1;
  while (from <= close) {
    const std::size_t end = std::min(type.find(',', from), close);
    words.push_back(type.substr(from, end - from));
    from = end + 1;
  }
  return words;
}

std::vector<Verb> Describe(const CLI::App& app) {
  std::vector<Verb> verbs;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    Verb verb{.name = command->get_name(),
              .description = command->get_description(),
              .flags = {},
              .words = {}};
    names.push_back(verb.name);
    for (const CLI::Option* option : command->get_options({})) {
      const std::vector<std::string> words = Choices(option->get_type_name());
      if (option->get_positional() && verb.words.empty()) verb.words = words;
      for (const std::string& flag : option->get_lnames()) {
        verb.flags.push_back(
            {.name = "--" + flag,
             .description = option->get_description(),
             .words = words,
             .takes_value = option->get_type_size() > 0 && option->get_items_expected_max() > 0});
      }
    }
    verbs.push_back(std::move(verb));
  }
  for (Verb& verb : verbs) {
    if (verb.name == "help" || verb.name == "man") verb.words = names;
  }
  return verbs;
}

std::string Join(const std::vector<std::string>& words) { return base::Joined(words, " "); }

std::string Bash(const std::vector<Verb>& verbs) {
  std::string cases;
  std::vector<std::string> names;
  for (const Verb& verb : verbs) {
    names.push_back(verb.name);
    std::vector<std::string> flags;
    for (const Flag& flag : verb.flags) {
      flags.push_back(flag.name);
      if (flag.words.empty()) continue;
      cases += "    " + verb.name + "," + flag.name +
               ") words=" + base::ShellQuoted(Join(flag.words)) + " ;;\n";
    }
    cases += "    " + verb.name +
             ",*)\n      [[ $current == -* ]] && words=" + base::ShellQuoted(Join(flags)) +
             " || words=" + base::ShellQuoted(Join(verb.words)) + " ;;\n";
  }
  return "# bash completion for talus\n"
         "_talus() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} words=\n"
         "  COMPREPLY=()\n"
         "  if [[ $COMP_CWORD == 1 ]]; then\n"
         "    COMPREPLY=($(compgen -W " +
         base::ShellQuoted(Join(names) + " --help --version") +
         " -- \"$current\"))\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]},$previous in\n" +
         cases +
         "  esac\n"
         "  [[ -n $words ]] && COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _talus talus\n";
}

// A text between the brackets and colons of an _arguments specification.
std::string ForZsh(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe;
}

std::string Zsh(const std::vector<Verb>& verbs) {
  std::string script = "#compdef talus\n_talus() {\n  local -a verbs\n  verbs=(\n";
  for (const Verb& verb : verbs) {
    script += "    " + base::ShellQuoted(verb.name + ":" + ForZsh(verb.description)) + "\n";
  }
  script +=
      "  )\n  if (( CURRENT == 2 )); then\n    _describe verb verbs\n    return\n  fi\n"
      "  case $words[2] in\n";
  for (const Verb& verb : verbs) {
    script += "    " + verb.name + ")\n      shift words; (( CURRENT-- ))\n      _arguments";
    for (const Flag& flag : verb.flags) {
      std::string spec = flag.name + "[" + ForZsh(flag.description) + "]";
      if (!flag.words.empty()) {
        spec += ":word:(" + Join(flag.words) + ")";
      } else if (flag.takes_value) {
        spec += ":value:_files";
      }
      script += " " + base::ShellQuoted(spec);
    }
    const std::string rest = verb.words.empty() ? "_files" : "(" + Join(verb.words) + ")";
    script += " " + base::ShellQuoted("*:argument:" + rest) + " ;;\n";
  }
  return script + "  esac\n}\n_talus \"$@\"\n";
}

std::string Fish(const std::vector<Verb>& verbs) {
  std::string script;
  for (const Verb& verb : verbs) {
    const std::string in_verb = " -n '__fish_seen_subcommand_from " + verb.name + "'";
    script += "complete -c talus -n __fish_use_subcommand -f -a " + verb.name + " -d " +
              base::ShellQuoted(verb.description) + "\n";
    for (const Flag& flag : verb.flags) {
      script += "complete -c talus" + in_verb + " -l " + flag.name.substr(2) + " -d " +
                base::ShellQuoted(flag.description);
      if (!flag.words.empty()) {
        script += " -x -a " + base::ShellQuoted(Join(flag.words));
      } else if (flag.takes_value) {
        script += " -r";
      }
      script += "\n";
    }
    if (!verb.words.empty()) {
      script +=
          "complete -c talus" + in_verb + " -f -a " + base::ShellQuoted(Join(verb.words)) + "\n";
    }
  }
  return script;
}

}  // namespace

std::string CompletionScript(const CLI::App& app, Shell shell) {
  const std::vector<Verb> verbs = Describe(app);
  switch (shell) {
    case Shell::kBash:
      return Bash(verbs);
    case Shell::kZsh:
      return Zsh(verbs);
    case Shell::kFish:
      return Fish(verbs);
  }
  return {};
}

}  // namespace talus::app
