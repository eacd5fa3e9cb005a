#include "experiments/analysis/report/page/plain_page.h"

#include "base/text/markup.h"
#include "experiments/analysis/report/charts/colors.h"
#include "page_files.h"  // made by talus_embed

namespace talus::analysis {

std::string WithCode(const std::string& text) {
  std::string marked;
  bool is_code = false;
  std::size_t from = 0;
  for (std::size_t at = text.find('`'); at != std::string::npos; at = text.find('`', from)) {
    marked += base::MarkupText(text.substr(from, at - from)) + (is_code ? "</code>" : "<code>");
    is_code = !is_code;
    from = at + 1;
  }
  return marked + base::MarkupText(text.substr(from)) + (is_code ? "</code>" : "");
}

std::string HtmlRow(const std::vector<std::string>& cells, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) {
    row += "<" + std::string(tag) + ">" + base::MarkupText(cell) + "</" + tag + ">";
  }
  return row + "</tr>\n";
}

std::string HtmlScrolling(const std::string& table) {
  return "<div class=\"scroll\">" + table + "</div>\n";
}

std::string HtmlSection(const std::string& id, const std::string& title,
                        const std::string& content) {
  return "<section id=\"" + id + "\"><h2>" + title + "</h2>\n<div class=\"card\">\n" + content +
         "</div></section>\n";
}

std::string HtmlFigure(const std::string& svg, const std::string& caption) {
  return "<figure>" + svg + "<figcaption>" + base::MarkupText(caption) + "</figcaption></figure>\n";
}

std::string PageText(const PlainPage& page) {
  const std::string title = base::MarkupText(page.title);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         title + " – " + base::MarkupText(page.kind) +
         "</title>\n<link rel=\"icon\" href=\"data:,\">\n" + "<style>\n" + ColorProperties() +
         std::string(page_files::kPageCss) +
         "svg { max-width: 100%; height: auto; }\n</style>\n</head>\n<body>\n"
         "<header class=\"top\"><div class=\"wrap\"><p class=\"eyebrow\">" +
         base::MarkupText(page.kind) + "</p><h1>" + title + "</h1><p id=\"standing\">" +
         base::MarkupText(page.standing) + "</p></div></header>\n<main class=\"wrap\">\n" +
         page.sections + "</main>\n</body>\n</html>\n";
}

}  // namespace talus::analysis
