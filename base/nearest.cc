#include "base/nearest.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace talus::base {
namespace {

// Levenshtein distance, one row at a time.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

// That of a name's beginning is 1: "lin" means "linear" rather than "log".
std::size_t DistanceBelow(std::size_t limit, std::string_view name, std::string_view candidate) {
  if (name.size() >= 3 && candidate.starts_with(name)) return 1;
  // A letter too many or too few is an edit each: a name of megabytes is compared with none.
  const auto [shorter, longer] = std::minmax({name.size(), candidate.size()});
  return longer - shorter >= limit ? limit : EditDistance(name, candidate);
}

}  // namespace

std::string Nearest(std::string_view name, std::span<const std::string> known) {
  std::string best;
  // A name whose letters are all wrong means none of them.
  std::size_t best_distance = std::min(name.size(), std::max<std::size_t>(2, name.size() / 3) + 1);
  for (const std::string& candidate : known) {
    const std::size_t distance = DistanceBelow(best_distance, name, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string DidYouMean(std::string_view name, std::span<const std::string> known) {
  std::string kinds;
  int num_kinds = 0;
  for (const std::string& candidate : known) {
    if (!candidate.starts_with(std::string(name) + "_")) continue;
    kinds += (num_kinds++ > 0 ? ", \"" : "\"") + candidate + "\"";
  }
  if (num_kinds > 1) return "; did you mean one of " + kinds + "?";
  const std::string near = Nearest(name, known);
  return near.empty() ? "" : "; did you mean \"" + near + "\"?";
}

}  // namespace talus::base
