#include "base/files/checked_text.h"

#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"

namespace talus::base {
namespace {

constexpr std::string_view kKey = "\"checksum_xxh3\": \"";
constexpr std::size_t kDigits = 16;

// What stands before the key and after the digits: on lines of their own, or all on one.
struct Around {
  std::string_view before;
  std::string_view after;  // with the quote that ends the digits
};
constexpr Around kLines{",\n  ", "\"\n}\n"};
constexpr Around kOneLine{", ", "\"}\n"};

const Around& AroundIn(std::string_view text) {
  return text.ends_with("\n}\n") ? kLines : kOneLine;
}

enum class Found { kNone, kWrong, kRight };

// Takes the checksum away from a text that has one.
Found Take(std::string& text) {
  const Around& around = AroundIn(text);
  const std::size_t length = around.before.size() + kKey.size() + kDigits + around.after.size();
  if (text.size() < length) return Found::kNone;
  const std::size_t at = text.size() - length;
  const std::size_t digits = at + around.before.size() + kKey.size();
  const std::string_view view = text;
  if (!view.substr(at).starts_with(around.before) ||
      view.substr(at + around.before.size(), kKey.size()) != kKey ||
      !view.ends_with(around.after)) {
    return Found::kNone;
  }
  const std::string checksum = text.substr(digits, kDigits);
  text.resize(at);
  text += around.after.substr(1);
  return Hex(Checksum(text)) == checksum ? Found::kRight : Found::kWrong;
}

}  // namespace

std::string WithChecksum(std::string text) {
  const Around& around = AroundIn(text);
  const std::string checksum = Hex(Checksum(text));
  text.resize(text.size() - (around.after.size() - 1));
  return text.append(around.before).append(kKey).append(checksum).append(around.after);
}

std::optional<std::string> CheckedText(std::string text, const std::string& name) {
  const Found found = Take(text);
  if (found == Found::kWrong) {
    throw Error(name + ": is damaged: it does not match its checksum");
  }
  return found == Found::kRight ? std::optional(std::move(text)) : std::nullopt;
}

std::optional<std::string> IfWhole(std::string text) {
  return Take(text) == Found::kRight ? std::optional(std::move(text)) : std::nullopt;
}

}  // namespace talus::base
