// Texts of others in HTML and SVG: shown as they are, never taken for markup; printable, as a page
// may be looked at in a terminal, and XML knows no control characters.
#pragma once

#include <string>
#include <string_view>

namespace talus::base {

std::string MarkupText(std::string_view text);

}  // namespace talus::base
