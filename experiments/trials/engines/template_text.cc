#include "experiments/trials/engines/template_text.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/nearest.h"
#include "base/trimmed.h"

namespace talus::trials {
namespace {

constexpr std::string_view kOpening = "{{";
constexpr std::string_view kClosing = "}}";
constexpr std::string_view kQuotedOpening = "\"{{\"";
constexpr const char* kWayOut = "; two braces of the file's own are written {{ \"{{\" }}";
constexpr std::string_view kBlank = " \t\r";

bool IsName(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_';
  });
}

std::size_t IndexOf(const std::vector<std::string>& columns, const std::string& name) {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                  columns.begin());
}

}  // namespace

TextTemplate::TextTemplate(std::string_view text, std::string file) : file_(std::move(file)) {
  int line = 1;
  while (true) {
    const std::size_t start = std::min(text.find(kOpening), text.size());
    parts_.push_back(
        {.kind = Kind::kText, .text = std::string(text.substr(0, start)), .line = line});
    line +=
        static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(start), '\n'));
    text.remove_prefix(start);
    if (text.empty()) break;
    const std::size_t end = text.find(kClosing);
    if (end == std::string_view::npos) {
      throw base::ConfigError(file_ + ":" + std::to_string(line) + ": \"{{\" has no \"}}\"" +
                              kWayOut);
    }
    AddTag(base::Trimmed(text.substr(kOpening.size(), end - kOpening.size()), kBlank), line);
    text.remove_prefix(end + kClosing.size());
  }
  DropLinesOfLoneTags();
  CheckSections();
}

void TextTemplate::AddTag(std::string_view inner, int line) {
  Part tag{.kind = Kind::kValue, .text = {}, .line = line};
  if (inner.starts_with('#') || inner.starts_with('/')) {
    tag.kind = inner.front() == '#' ? Kind::kOpen : Kind::kClose;
    inner = base::Trimmed(inner.substr(1), kBlank);
  }
  tag.text = inner;
  if (inner == kQuotedOpening) {
    tag.kind = Kind::kBraces;
    tag.text = kOpening;
  } else if (!IsName(inner)) {
    throw base::ConfigError(Place(tag) + "\"{{ " + tag.text +
                            " }}\" must hold a name of letters, digits and _" + kWayOut);
  }
  parts_.push_back(std::move(tag));
}

void TextTemplate::DropLinesOfLoneTags() {
  // Parts alternate: text, tag, text, …, text.
  bool begins_line = true;  // the text before the tag, also where a dropped line stood before that
  for (std::size_t i = 1; i + 1 < parts_.size(); i += 2) {
    const bool before_begins_line = std::exchange(begins_line, false);
    if (parts_[i].kind != Kind::kOpen && parts_[i].kind != Kind::kClose) continue;
    std::string& before = parts_[i - 1].text;
    std::string& after = parts_[i + 1].text;
    const std::size_t line_start = before.find_last_of('\n') + 1;  // npos + 1 = 0
    const std::size_t line_end = after.find('\n');
    const bool first_of_line = line_start > 0 || before_begins_line;
    if (!first_of_line ||
        !base::Trimmed(std::string_view(before).substr(line_start), kBlank).empty() ||
        line_end == std::string::npos ||
        !base::Trimmed(std::string_view(after).substr(0, line_end), kBlank).empty()) {
      continue;
    }
    before.resize(line_start);
    after.erase(0, line_end + 1);
    begins_line = true;
  }
}

void TextTemplate::CheckSections() const {
  const Part* open = nullptr;
  for (const Part& part : parts_) {
    if (part.kind == Kind::kOpen) {
      if (open) throw base::ConfigError(Place(part) + "a section inside another is not read");
      open = &part;
    } else if (part.kind == Kind::kClose) {
      if (!open || open->text != part.text) {
        throw base::ConfigError(Place(part) + "{{/ " + part.text + " }} closes nothing");
      }
      open = nullptr;
    }
  }
  if (open) throw base::ConfigError(Place(*open) + "{{# " + open->text + " }} is not closed");
}

std::string TextTemplate::Place(const Part& part) const {
  return file_ + ":" + std::to_string(part.line) + ": ";
}

void TextTemplate::Check(const TemplateValues& known, base::Problems& problems) const {
  const TemplateTable* table = nullptr;
  for (const Part& part : parts_) {
    std::vector<std::string> names;
    if (part.kind == Kind::kOpen || part.kind == Kind::kClose) {
      const auto found = known.tables.find(part.text);
      table = part.kind == Kind::kOpen && found != known.tables.end() ? &found->second : nullptr;
      for (const auto& [name, unused] : known.tables) names.push_back(name);
    } else {
      for (const auto& [name, unused] : known.scalars) names.push_back(name);
      if (table) names.insert(names.end(), table->columns.begin(), table->columns.end());
    }
    if (part.is_text() || IndexOf(names, part.text) < names.size()) continue;
    problems.Add("", Place(part) + "the placeholder \"" + part.text + "\" is not known" +
                         base::DidYouMean(part.text, names));
  }
}

std::set<std::string> TextTemplate::Names() const {
  std::set<std::string> names;
  for (const Part& part : parts_) {
    if (!part.is_text()) names.insert(part.text);
  }
  return names;
}

std::string TextTemplate::Fill(const TemplateValues& values) const {
  std::string text;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (part.is_text()) text += part.text;
    if (part.kind == Kind::kValue) text += values.scalars.at(part.text);
    if (part.kind == Kind::kOpen) {
      const std::size_t open = i;
      while (parts_[i].kind != Kind::kClose) ++i;
      text += FillRows(open, i, values);
    }
  }
  return text;
}

// The parts between two tags of a section, once for each row of its table.
std::string TextTemplate::FillRows(std::size_t open, std::size_t close,
                                   const TemplateValues& values) const {
  const TemplateTable& table = values.tables.at(parts_[open].text);
  std::string text;
  for (const std::vector<std::string>& row : table.rows) {
    for (std::size_t p = open + 1; p < close; ++p) {
      const Part& part = parts_[p];
      const std::size_t column = part.is_text() ? 0 : IndexOf(table.columns, part.text);
      if (part.is_text()) {
        text += part.text;
      } else {
        text += column < row.size() ? row[column] : values.scalars.at(part.text);
      }
    }
  }
  return text;
}

}  // namespace talus::trials
