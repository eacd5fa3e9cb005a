// The known name that a mistyped one was probably meant to be.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace talus::base {

// The name of `known` that begins with `name` or has the smallest edit distance to it; "" if none
// is near (at most a third of the letters wrong, or two of three and more).
std::string Nearest(std::string_view name, std::span<const std::string> known);

// "; did you mean "NAME"?" of that name; of all that go on after it with "_", where there are
// several ("angle_of_repose": its methods); "" if none is near.
std::string DidYouMean(std::string_view name, std::span<const std::string> known);

}  // namespace talus::base
