#include "base/problems.h"

#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/replaced.h"

namespace talus::base {
namespace {

// A key or a value that holds a line break would write a line of its own.
std::string OnOneLine(std::string_view text) { return Replaced(text, "\n", "\\x0a"); }

}  // namespace

std::string Problems::FullPath(std::string_view path) const {
  if (prefix_.empty()) return std::string(path);
  if (path.empty()) return prefix_;
  return prefix_ + (path.front() == '[' ? "" : ".") + std::string(path);
}

std::string Problem::Text(std::string_view written) const {
  if (value.empty()) return message;
  const bool says_more = !written.empty() && written != value;
  const std::string as_written = says_more ? " (\"" + std::string(written) + "\")" : "";
  return "is " + value + as_written + ", " + message;
}

void Problems::Add(Problem problem) {
  problem.path = FullPath(problem.path);
  known_.insert(problem.path);
  if (list_.size() < kMostShown) {
    list_.push_back(std::move(problem));
  } else {
    ++num_more_;
  }
}

void Problems::AddUnread(std::string_view path, std::string message) {
  unread_.insert(FullPath(path));
  Add(path, std::move(message));
}

void Problems::Require(bool ok, std::string_view path, double value, std::string_view rule) {
  if (ok || known_.contains(FullPath(path))) return;
  std::ostringstream text;
  text << value;
  Add({.path = std::string(path), .message = std::string(rule), .value = text.str()});
}

void Problems::Require(bool ok, std::string_view path, std::string_view message) {
  if (!ok && !unread_.contains(FullPath(path))) Add(path, std::string(message));
}

void Problems::RequirePositive(std::string_view path, std::optional<double> value) {
  Require(!value || (*value > 0 && std::isfinite(*value)), path, value.value_or(0),
          "must be positive");
}

std::string Problems::Text() const {
  std::vector<std::string> paths;
  for (const Problem& problem : list_) paths.push_back(problem.path);
  std::vector<Location> places(paths.size());
  if (places_ && !paths.empty()) places = places_(paths);
  std::ostringstream text;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (i > 0) text << '\n';
    if (!file_.empty()) {
      text << OnOneLine(file_) << ':';
      if (places[i].line > 0) text << places[i].line << ':' << places[i].column << ':';
      text << ' ';
    }
    if (!paths[i].empty()) text << OnOneLine(paths[i]) << ": ";
    text << OnOneLine(list_[i].Text(places[i].written));
  }
  if (num_more_ > 0) text << "\n… and " << num_more_ << " more problems";
  return text.str();
}

void Problems::ThrowIfAny() const {
  if (!list_.empty()) throw ConfigError(Text());
}

}  // namespace talus::base
