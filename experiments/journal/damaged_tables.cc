#include "experiments/journal/damaged_tables.h"

#include <set>
#include <sstream>
#include <string_view>

#include "experiments/journal/schema.h"

namespace talus::journal {
namespace {

// One space between words, and no comments.
std::string Bare(std::string_view sql) {
  std::istringstream lines{std::string(sql)};
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find("--")));
    for (std::string word; words >> word;) text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

std::set<std::string> StatementsOf(std::string_view schema) {
  std::istringstream parts(Bare(schema));
  std::set<std::string> statements;
  for (std::string part; std::getline(parts, part, ';');) {
    if (const std::string statement = Bare(part); !statement.empty()) statements.insert(statement);
  }
  return statements;
}

}  // namespace

std::string DamagedTables(Database& database) {
  std::set<std::string> missing = StatementsOf(kSchema);
  Statement tables = database.Prepare(
      "SELECT name, sql FROM sqlite_schema WHERE type <> 'view' AND sql IS NOT NULL");
  while (tables.Step()) {
    if (missing.erase(Bare(tables.Text(1))) == 0) {
      return "the table " + tables.Text(0) + " is not as it was made";
    }
  }
  return missing.empty() ? "" : "a table is missing";
}

}  // namespace talus::journal
