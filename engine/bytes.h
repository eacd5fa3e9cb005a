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

class ByteWriter {
 public:
  template <Plain T>
  void operator()(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  template <Plain T, class A>
  void operator()(const std::vector<T, A>& list) {
    (*this)(static_cast<std::uint64_t>(list.size()));
    if (!list.empty()) {
      bytes_.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
    }
  }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
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
