// A place in a text that is read from front to back, and errors that name it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace talus::imaging {

class TextCursor {
 public:
  // `text` must outlive the cursor; `file` is named in errors.
  TextCursor(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool AtEnd() const { return position_ >= text_.size(); }
  std::size_t position() const { return position_; }
  std::size_t Left() const { return AtEnd() ? 0 : text_.size() - position_; }  // [bytes]
  void Seek(std::size_t position) { position_ = position; }
  const std::string& file() const { return file_; }

  // The rest of this line, without its end; fails at the end of the text.
  std::string_view Line();
  // The next word after white space; empty at the end of the text.
  std::string_view Word();
  // The next word as a number, or as a count that the rest of the text can hold.
  double Number();
  std::size_t Count();
  std::string_view Bytes(std::size_t count);

  // Throws ConfigError "FILE:LINE: WHAT".
  [[noreturn]] void Fail(const std::string& what) const;

 private:
  std::string_view text_;
  std::string file_;
  std::size_t position_ = 0;
};

// Whether the whole of `word` is a number, which is then put into `value`.
bool ParseNumber(std::string_view word, double& value);

// The words of a line, parted by white space.
std::vector<std::string_view> Words(std::string_view line);

std::string_view Trimmed(std::string_view text);

}  // namespace talus::imaging
