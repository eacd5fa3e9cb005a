// The enumerators of an enum by name, as JSON writes them: kLeftOut is "left_out".
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace talus::base {

// "talus::campaign::AlarmKind::kLeftOut", out of the compiler's signature of this function.
template <auto kValue>
constexpr std::string_view EnumeratorOf() {
  const std::string_view signature = __PRETTY_FUNCTION__;
  const std::string_view mark = "kValue = ";
  const std::size_t begin = signature.find(mark) + mark.size();
  return signature.substr(begin, signature.find_first_of(";]", begin) - begin);
}

// "left_out", ended by a zero.
template <auto kValue>
inline constexpr auto kSnakeName = [] {
  constexpr std::string_view kWhole = EnumeratorOf<kValue>();
  constexpr std::string_view kName = kWhole.substr(kWhole.rfind(':') + 2);  // without the k
  std::array<char, 2 * kName.size() + 1> snake{};
  std::size_t size = 0;
  for (const char c : kName) {
    const bool is_capital = c >= 'A' && c <= 'Z';
    if (is_capital && size > 0) snake[size++] = '_';
    snake[size++] = is_capital ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return snake;
}();

// All of an enum whose values run from 0 to `kLast`, in their order.
template <auto kLast>
constexpr auto EnumeratorNames() {
  using Enum = decltype(kLast);
  return []<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    return std::array{
        std::pair<const char*, Enum>{kSnakeName<Enum{kIndex}>.data(), Enum{kIndex}}...};
  }
  (std::make_index_sequence<static_cast<std::size_t>(kLast) + 1>());
}

}  // namespace talus::base
