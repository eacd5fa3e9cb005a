#include "experiments/campaign/answer/first_answer.h"

#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/campaign/answer/describe_posterior.h"

namespace talus::campaign {

std::string FirstAnswerText(const optimizer::Answer& answer, const optimizer::ParameterSpace& space,
                            const std::vector<journal::ParameterRecord>& parameters) {
  const std::vector<double> values = FreeValues(space, answer.point);
  const FreeRanges ranges = CredibleValues(space, answer);
  std::string text = "first answer, by what was reused:";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& unit = parameters[i].unit;
    text += (i == 0 ? " " : ", ") + parameters[i].name + " " + base::ShortNumber(values[i]) +
            " (90 % in " + base::ShortNumber(ranges.low[i]) + " … " +
            base::ShortNumber(ranges.high[i]) + ")" + (unit.empty() ? "" : " ") + unit;
  }
  return text + "; the joint 90 % region fills " +
         base::InPercent(answer.posterior->region_volume) + " % of the searched ranges";
}

}  // namespace talus::campaign
