// What differs between two JSON documents, key by key.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace talus::base {

struct JsonChange {
  std::string path;    // "powder.mass", "pairs[0].between"
  std::string before;  // as JSON, shortened
  std::string after;
};

// In the order of `before`, then what only `after` has. Arrays of different length differ as a
// whole.
std::vector<JsonChange> JsonChanges(const nlohmann::ordered_json& before,
                                    const nlohmann::ordered_json& after);

}  // namespace talus::base
