#include "base/problems.h"

#include <algorithm>
#include <sstream>

#include "base/error.h"

namespace talus::base {

std::string Problems::FullPath(std::string_view path) const {
  if (prefix_.empty()) return std::string(path);
  if (path.empty()) return prefix_;
  return prefix_ + (path.front() == '[' ? "" : ".") + std::string(path);
}

void Problems::Add(std::string_view path, std::string message) {
  list_.push_back({FullPath(path), std::move(message)});
}

void Problems::Require(bool ok, std::string_view path, double value, std::string_view rule) {
  if (ok) return;
  const bool known = std::any_of(list_.begin(), list_.end(),
                                 [full = FullPath(path)](const auto& p) { return p.path == full; });
  if (known) return;
  std::ostringstream text;
  text << "is " << value << ", " << rule;
  Add(path, text.str());
}

void Problems::Require(bool ok, std::string_view path, std::string_view message) {
  if (!ok) Add(path, std::string(message));
}

// A missing key has no place of its own; the object that should hold it has.
Location Problems::Find(std::string_view path) const {
  while (true) {
    if (const auto found = source_.find(path); found != source_.end()) return found->second;
    if (path.empty()) return {};
    const auto cut = path.find_last_of(".[");
    path = cut == std::string_view::npos ? std::string_view() : path.substr(0, cut);
  }
}

std::string Problems::Text() const {
  std::ostringstream text;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const auto& [path, message] = list_[i];
    if (i > 0) text << '\n';
    if (!file_.empty()) {
      text << file_ << ':';
      if (const Location at = Find(path); at.line > 0) text << at.line << ':' << at.column << ':';
      text << ' ';
    }
    if (!path.empty()) text << path << ": ";
    text << message;
  }
  return text.str();
}

void Problems::ThrowIfAny() const {
  if (!list_.empty()) throw ConfigError(Text());
}

}  // namespace talus::base
