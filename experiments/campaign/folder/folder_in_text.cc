#include "experiments/campaign/folder/folder_in_text.h"

#include <regex>

#include "base/text/shell_text.h"

namespace talus::campaign {

std::string WithFolder(const std::string& text, const std::filesystem::path& folder) {
  static const std::regex kCommand(R"((talus [a-z-]+ )DIR\b)");
  const std::string word = base::ShellWord(folder.string());
  std::string named;
  std::string::const_iterator from = text.begin();
  for (std::sregex_iterator at(text.begin(), text.end(), kCommand), end; at != end; ++at) {
    named.append(from, text.begin() + at->position());
    named += at->str(1) + word;
    from = text.begin() + at->position() + at->length();
  }
  return named.append(from, text.end());
}

}  // namespace talus::campaign
