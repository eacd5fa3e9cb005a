// A page of text, tables and SVG charts in the report's style, without scripts: what a search and a
// comparison of batches are shown as.
#pragma once

#include <string>
#include <vector>

namespace talus::analysis {

// The text as HTML, what stands in backticks as code: it is a command.
std::string WithCode(const std::string& text);

// <tr> with these texts, which are escaped; `tag` is td or th.
std::string HtmlRow(const std::vector<std::string>& cells, const char* tag = "td");

// A table, as HTML, that may be wider than the page.
std::string HtmlScrolling(const std::string& table);

// `content` is HTML.
std::string HtmlSection(const std::string& id, const std::string& title,
                        const std::string& content);

// An <svg> with its caption.
std::string HtmlFigure(const std::string& svg, const std::string& caption);

struct PlainPage {
  std::string kind;  // "Search report"
  std::string title;
  std::string standing;  // one sentence below it
  std::string sections;  // HTML
};
std::string PageText(const PlainPage& page);

}  // namespace talus::analysis
