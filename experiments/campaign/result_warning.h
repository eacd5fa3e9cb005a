// What a user should know before trusting a result: facts as data, put in words in one place.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "base/field.h"

namespace talus::campaign {

enum class WarningKind {
  kBound,            // `parameter` of the recommended set lies on its `side`
  kFewGrains,        // `value` grains across the plate of `experiment` at `scale_factor`
  kImplausible,      // no set fits `experiment`: the best is `value` standard deviations off
  kExtrapolated,     // nothing was simulated at the target `scale_factor`
  kUnlearntLevel,    // the bias of `scale_factor` is not known
  kNotModelsChoice,  // another candidate was confirmed better than the model's set
  kOther             // of an earlier version's result, in words
};

struct ResultWarning {
  WarningKind kind = WarningKind::kOther;
  std::optional<std::string> parameter{};
  std::optional<std::string> side{};  // "lower" or "upper"
  std::optional<std::string> experiment{};
  std::optional<double> scale_factor{};
  std::optional<double> value{};
  std::string text{};  // the same in words, for people

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("kind", self.kind);
    visit("parameter", self.parameter);
    visit("side", self.side);
    visit("experiment", self.experiment);
    visit("scale_factor", self.scale_factor);
    visit("value", self.value);
    visit("text", self.text);
  }
};

// With its text filled in.
ResultWarning Worded(ResultWarning warning);

}  // namespace talus::campaign

template <>
struct talus::base::Names<talus::campaign::WarningKind> {
  using K = talus::campaign::WarningKind;
  static constexpr std::array kList{
      std::pair{"bound", K::kBound},
      std::pair{"few_grains", K::kFewGrains},
      std::pair{"implausible", K::kImplausible},
      std::pair{"extrapolated", K::kExtrapolated},
      std::pair{"unlearnt_scale_factor", K::kUnlearntLevel},
      std::pair{"not_the_models_choice", K::kNotModelsChoice},
      std::pair{"other", K::kOther},
  };
};
