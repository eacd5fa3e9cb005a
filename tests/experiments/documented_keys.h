// Keys of a file that a user reads stand in the page about it.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace talus {

// Expects each key of `json`, at any depth, in backquotes on the page. What `own` holds has keys
// that no page lists.
inline void ExpectKeysIn(const std::string& page, const nlohmann::ordered_json& json,
                         const std::string& own = {}) {
  for (const auto& [key, value] : json.items()) {
    if (json.is_object()) {
      EXPECT_NE(page.find('`' + key + '`'), std::string::npos) << key;
    }
    if (value.is_structured() && (own.empty() || key != own)) ExpectKeysIn(page, value, own);
  }
}

}  // namespace talus
