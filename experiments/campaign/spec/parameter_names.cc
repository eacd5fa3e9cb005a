#include "experiments/campaign/spec/parameter_names.h"

#include <optional>
#include <string_view>
#include <type_traits>

#include "experiments/campaign/spec/parameter_ranges.h"

namespace talus::campaign {

std::vector<std::string> ParameterNames() {
  std::vector<std::string> names;
  const ParameterRanges all;
  ParameterRanges::Visit(all, [&]<class T>(std::string_view name, const T&, base::FieldInfo = {}) {
    if constexpr (!std::is_same_v<T, std::optional<EarlierPosterior>>) names.emplace_back(name);
  });
  return names;
}

}  // namespace talus::campaign
