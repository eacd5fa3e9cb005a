// The man pages, from the same definitions as --help.
#include <CLI/CLI.hpp>
#include <string>

#include "base/version.h"
#include "experiments/app/command_line.h"

namespace talus::app {
namespace {

// A hyphen-minus that can be searched and pasted, a backslash that is one, no request by accident.
std::string Roff(const std::string& text) {
  std::string roff;
  for (const char c : text) {
    const bool at_line_start = roff.empty() || roff.back() == '\n';
    if (at_line_start && (c == '.' || c == '\'')) roff += "\\&";
    if (c == '-') roff += '\\';
    roff += c == '\\' ? "\\e" : std::string(1, c);
  }
  return roff;
}

std::string Title(const std::string& page, const std::string& summary) {
  return ".TH " + Roff(page) + " 1 \"\" \"talus " + Roff(base::Version()) +
         "\" \"User commands\"\n.SH NAME\n" + Roff(page) + " \\- " + Roff(summary) + "\n";
}

std::string OptionHead(const CLI::Option& option) {
  if (option.get_positional()) return ".B " + Roff(option.get_name(true)) + "\n";
  const std::string names = option.get_name(false, true);
  const bool takes_value = option.get_items_expected_max() > 0 && option.get_type_size() > 0;
  const std::string value = takes_value ? " \\fI" + Roff(option.get_type_name()) + "\\fR" : "";
  return "\\fB" + Roff(names) + "\\fR" + value + "\n";
}

std::string Options(const CLI::App& verb) {
  std::string roff = ".SH OPTIONS\n";
  for (const CLI::Option* option : verb.get_options({})) {
    roff += ".TP\n" + OptionHead(*option) + Roff(option->get_description());
    if (!option->get_default_str().empty()) {
      roff += " (default: " + Roff(option->get_default_str()) + ")";
    }
    roff += "\n";
  }
  return roff;
}

std::string ExitStatus() {
  return ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nfailed\n.TP\n2\nbad input; nothing was "
         "written\n.TP\n130\ninterrupted; what was done is kept\n";
}

std::string Synopsis(const CLI::App& verb) {
  std::string roff = ".SH SYNOPSIS\n.B talus " + Roff(verb.get_name()) + "\n";
  for (const CLI::Option* option : verb.get_options({})) {
    if (!option->get_positional()) continue;
    const std::string name = Roff(option->get_name(true));
    roff += option->get_required() ? "\\fI" + name + "\\fR\n" : "[\\fI" + name + "\\fR]\n";
  }
  return roff + "[\\fIOPTIONS\\fR]\n";
}

}  // namespace

std::string ManPage(const CLI::App& app, const CLI::App& verb) {
  std::string roff = Title("talus-" + verb.get_name(), verb.get_description()) + Synopsis(verb) +
                     ".SH DESCRIPTION\n" + Roff(verb.get_description()) + ".\n";
  if (!verb.get_footer().empty()) roff += ".PP\n.nf\n" + Roff(verb.get_footer()) + "\n.fi\n";
  return roff + Options(verb) + ExitStatus() + ".SH SEE ALSO\n.BR " + Roff(app.get_name()) +
         " (1)\n";
}

std::string ManPage(const CLI::App& app) {
  std::string roff = Title(app.get_name(), app.get_description()) +
                     ".SH SYNOPSIS\n.B talus\n\\fIVERB\\fR [\\fIARGUMENTS\\fR]\n.SH VERBS\n";
  for (const CLI::App* verb : app.get_subcommands({})) {
    roff += ".TP\n.BR talus\\-" + Roff(verb->get_name()) + " (1)\n" +
            Roff(verb->get_description()) + "\n";
  }
  return roff + ExitStatus();
}

}  // namespace talus::app
