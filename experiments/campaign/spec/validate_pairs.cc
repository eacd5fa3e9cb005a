// What must hold between a campaign's pairs, and between these and what is searched: a property has
// one value, and none that is searched is without effect.
#include <string>
#include <vector>

#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"

namespace talus::campaign {
namespace {

using Pairs = std::vector<engine::PairSpec>;

struct StatesProperty {
  const std::string& property;
  bool& states;
  void operator()(std::string_view name, const std::optional<double>& value, base::FieldInfo = {}) {
    states |= name == property && value.has_value();
  }
};

bool States(const engine::PairSpec& pair, const ParameterPlace& place) {
  bool states = false;
  StatesProperty visitor{place.property, states};
  if (rigs::PartnerOf(pair) == place.body) engine::PairProperties::Visit(pair.stated, visitor);
  return states;
}

// Why the parameter cannot stand beside a pair that states the same property.
std::string Contradiction(const ParameterPlace& place) {
  if (place.is_pair) return "gives what the parameters give, too: keep one of the two";
  if (place.body == rigs::kPowder) {
    return "gives what the parameters give the powder, which would act on walls only: keep one of "
           "the two";
  }
  return "takes the place of what the parameters give the " +
         std::string(rigs::kBodyNames[place.body]) + ", which changes nothing: keep one of the two";
}

void CheckAgainst(const Pairs& pairs, const optimizer::ParameterSpace& space,
                  base::Problems& problems) {
  for (const optimizer::Parameter& parameter : space.parameters) {
    const ParameterPlace place = PlaceOf(parameter.name);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      problems.Require(!States(pairs[k], place),
                       "pairs[" + std::to_string(k) + "]." + place.property, Contradiction(place));
    }
  }
}

// A wall's own property says nothing where its pair with the powder gives the same.
void CheckOverridden(const optimizer::ParameterSpace& space, base::Problems& problems) {
  for (const optimizer::Parameter& parameter : space.parameters) {
    const ParameterPlace place = PlaceOf(parameter.name);
    if (!place.is_pair) continue;
    for (const optimizer::Parameter& other : space.parameters) {
      const ParameterPlace own = PlaceOf(other.name);
      problems.Require(own.is_pair || own.body != place.body || own.property != place.property,
                       "parameters." + other.name,
                       "changes nothing beside " + parameter.name +
                           ", which takes its place: keep one of the two");
    }
  }
}

}  // namespace

void ValidatePairs(const CampaignSpec& spec, base::Problems& problems) {
  const auto check = [&](const Pairs& pairs) {
    rigs::ValidatePairs(pairs, problems);
    if (spec.parameters) CheckAgainst(pairs, MakeSpace(*spec.parameters), problems);
  };
  check(spec.pairs);
  const std::vector<ExperimentSpec> none;
  const std::vector<ExperimentSpec>& experiments = spec.experiments ? *spec.experiments : none;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    if (!experiments[i].pairs) continue;
    problems.Within("experiments[" + std::to_string(i) + "]",
                    [&] { check(*experiments[i].pairs); });
  }
  if (spec.parameters) CheckOverridden(MakeSpace(*spec.parameters), problems);
}

}  // namespace talus::campaign
