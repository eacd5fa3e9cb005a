#include "imaging/photos/scale_mark.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/units.h"

namespace talus::imaging {
namespace {

constexpr double kShortest = 10;  // between the points [px]: less is no scale

// Takes a number and the character behind it off the front of `rest`.
double Take(std::string_view& rest, char behind) {
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc()) {
    throw base::ConfigError("has no number where a coordinate should be");
  }
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  if (rest.empty() || rest.front() != behind) {
    throw base::ConfigError(std::string("has no \"") + behind + "\" where it should be");
  }
  rest.remove_prefix(1);
  return value;
}

ScaleMark ParseMark(std::string_view rest) {
  ScaleMark mark;
  mark.x1 = Take(rest, ',');
  mark.y1 = Take(rest, '-');
  mark.x2 = Take(rest, ',');
  mark.y2 = Take(rest, '=');
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  try {
    mark.length = base::ParseQuantity(rest, base::Dimension::kLength);
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(std::string("ends in no length (") + error.what() + ")");
  }
  if (!(mark.length > 0 && mark.length <= 2)) {
    throw base::ConfigError("has a length that is not in (0, 2 m]");
  }
  if (!(std::hypot(mark.x2 - mark.x1, mark.y2 - mark.y1) >= kShortest)) {
    throw base::ConfigError("has two points less than 10 px apart");
  }
  return mark;
}

}  // namespace

double ScaleMark::pixel_size() const { return length / std::hypot(x2 - x1, y2 - y1); }

ScaleMark ParseScale(const std::string& text) {
  try {
    return ParseMark(text);
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(
        "\"" + text + "\" " + error.what() +
        "; write two points of a photograph in pixels from its upper left corner, as an image "
        "viewer shows them, and the length between them: \"104,310-884,312 = 30 mm\"");
  }
}

}  // namespace talus::imaging
