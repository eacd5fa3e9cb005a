// Values to bytes and back, for the checkpoint: one function that names the fields serves both.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/error.h"

namespace talus::engine {

template <class T>
concept Plain = std::is_trivially_copyable_v<T>;

// Appends to a text; without one it only counts, so that the text can have its room at once.
class ByteWriter {
 public:
  explicit ByteWriter(std::string* bytes) : bytes_(bytes) {}

  template <Plain T>
  void operator()(const T& value) {
    Append(&value, sizeof(T));
  }
  template <Plain T, class A>
  void operator()(const std::vector<T, A>& list) {
    (*this)(static_cast<std::uint64_t>(list.size()));
    Append(list.data(), list.size() * sizeof(T));
  }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    Append(text.data(), text.size());
  }
  std::size_t count() const { return count_; }  // of bytes so far

 private:
  void Append(const void* from, std::size_t size) {
    count_ += size;
    if (bytes_ != nullptr && size > 0) bytes_->append(static_cast<const char*>(from), size);
  }

  std::string* bytes_;
  std::size_t count_ = 0;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <Plain T>
  void operator()(T& value) {
    std::memcpy(&value, Take(sizeof(T)).data(), sizeof(T));
  }
  template <Plain T, class A>
  void operator()(std::vector<T, A>& list) {
    list.resize(Count(sizeof(T)));
    const std::string_view from = Take(list.size() * sizeof(T));
    if (!list.empty()) std::memcpy(list.data(), from.data(), from.size());
  }
  void operator()(std::string& text) { text = Take(Count(1)); }

  // The number of elements that follow, each of `size` bytes at least.
  std::uint64_t Count(std::uint64_t size) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > rest_.size() / size) throw base::Error("the checkpoint is damaged");
    return count;
  }
  bool AtEnd() const { return rest_.empty(); }

 private:
  std::string_view Take(std::uint64_t size) {
    if (size > rest_.size()) throw base::Error("the checkpoint is damaged");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  std::string_view rest_;
};

}  // namespace talus::engine
