// Base64 [rfc4648]: bytes inside a text.
#pragma once

#include <string>
#include <string_view>

namespace talus::base {

std::string Base64(std::string_view bytes);

}  // namespace talus::base
