// Base64 [rfc4648], for images inside a page.
#pragma once

#include <string>
#include <string_view>

namespace talus::analysis {

std::string Base64(std::string_view bytes);

}  // namespace talus::analysis
