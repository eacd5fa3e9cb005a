#include "experiments/analysis/sensitivity/sensitivity_text.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/counted.h"
#include "base/text/duration_text.h"
#include "base/text/joined.h"
#include "base/text/number_text.h"
#include "base/text/plain_number.h"
#include "experiments/journal/record_json.h"

namespace talus::analysis {
namespace {

using base::PlainNumber;
using base::ShortNumber;

std::string PlusMinus(double value, double error) {
  return ShortNumber(value, 3) + " ± " + ShortNumber(error, 1);
}

std::string RangeText(double low, double high) {
  return " (" + ShortNumber(low, 3) + " to " + ShortNumber(high, 3) + ")";
}

std::string MoveText(const FixedMove& move) {
  return move.name + " " + move.to + " in place of " + move.from;
}

std::string OutputsText(const FixedMove& move, bool many_experiments) {
  if (move.outputs.empty()) return "no output, as it acts on no experiment";
  return base::Joined(move.outputs, ", ", [&](const OutputShift& output) {
    const std::string name =
        (many_experiments ? output.experiment + " " : "") + output.output + " ";
    if (!std::isfinite(output.shift)) return name + "not known, as simulations have no value";
    return name + PlainNumber(output.shift, 2) + " (± " + PlainNumber(output.noise, 2) +
           " by chance)";
  });
}

std::string AnswerText(const FixedMove& move) {
  return base::Joined(move.answer, ", ", [&](const AnswerShift& shift) {
    return shift.parameter + " " + PlusMinus(shift.to, shift.standard_error) +
           RangeText(shift.low, shift.high) +
           (move.Exceeds(shift)  ? " (!)"
            : move.IsTold(shift) ? ""
                                 : " (?)");
  });
}

bool HasSeveralExperiments(const SensitivityTable& table) {
  for (const FixedMove& move : table.moves) {
    for (const OutputShift& output : move.outputs) {
      if (output.experiment != move.outputs.front().experiment) return true;
    }
  }
  return false;
}

std::string HeadText(const SensitivityTable& table) {
  const auto one = [](const SensitivityParameter& p) {
    return p.name + " " + base::WithUnit(p.value, p.unit, 3) + RangeText(p.low, p.high);
  };
  std::string text = "  as it stands      " + base::Joined(table.parameters, ", ", one);
  if (table.FitsNoSet()) {
    text += "\n                    no set fits: the answer is " +
            PlainNumber(table.implausibility, 2) + " standard deviations off";
  }
  text += "\n  simulated         " + base::Counted(table.num_simulations, "simulation") +
          " at scale factor " + ShortNumber(table.scale_factor);
  if (table.core_time > 0) {
    text += ", " + base::DurationText(table.core_time) + " of processor time";
  }
  return text + "\n";
}

}  // namespace

std::vector<std::string> SensitivityAlarms(const SensitivityTable& table) {
  std::vector<std::string> alarms;
  for (const FixedMove& move : table.moves) {
    for (const AnswerShift& shift : move.answer) {
      if (!move.Exceeds(shift)) continue;
      alarms.push_back(MoveText(move) + " would move " + shift.parameter + " from " +
                       ShortNumber(shift.from, 3) + " to " +
                       PlusMinus(shift.to, shift.standard_error) +
                       ", beyond half of its stated range" +
                       (move.FitsNoSet() ? ", though no set fits with it" : "") +
                       ": make sure of " + move.name + ", or add a test that tells it");
    }
  }
  return alarms;
}

std::string SensitivityText(const SensitivityTable& table) {
  std::string text = HeadText(table);
  const bool many = HasSeveralExperiments(table);
  for (const FixedMove& move : table.moves) {
    text += "  " + MoveText(move) + "\n";
    if (!move.why_not.empty()) {
      text += "            not known: " + move.why_not + "\n";
      continue;
    }
    text += "            answer " + AnswerText(move) + "\n            shifts " +
            OutputsText(move, many) + "; " + base::Counted(move.replicates, "simulation");
    if (move.num_failed > 0) text += ", " + std::to_string(move.num_failed) + " failed";
    if (move.num_followed > 0) {
      text += "; anew at the answer foretold, " + base::Counted(move.num_followed, "time") +
              (move.moves_still ? ", and it moves still" : "");
    }
    if (!move.why_not_followed.empty()) {
      text += move.num_followed > 0 ? "; then not, as " : "; not anew at the answer foretold, as ";
      text += move.why_not_followed;
    }
    if (move.FitsNoSet()) {
      text += "\n            no set fits with it: the answer is " +
              PlainNumber(move.implausibility, 2) + " standard deviations off" +
              (table.FitsNoSet() ? ", for " + PlainNumber(table.implausibility, 2) + " as it stands"
                                 : "");
    }
    text += "\n";
  }
  text +=
      "  Shifts of outputs are in what one simulation scatters by. (!) beyond half of the stated "
      "range, (?) not\n  told from the noise.\n";
  for (const std::string& alarm : SensitivityAlarms(table)) text += "  warning: " + alarm + "\n";
  return text;
}

std::filesystem::path SensitivityFile(const std::filesystem::path& campaign) {
  return campaign / "sensitivity.json";
}

std::optional<SensitivityTable> LoadSensitivity(const std::filesystem::path& campaign) {
  const std::filesystem::path path = SensitivityFile(campaign);
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    SensitivityTable table =
        journal::ParseRecord<SensitivityTable>(base::ReadFile(path), path.string());
    for (const FixedMove& move : table.moves) {
      if (std::ranges::count(move.outputs, 0, &OutputShift::num_modes) == 0) continue;
      throw base::ConfigError(path.string() + ": lacks num_modes of " + move.name +
                              ", by which chance is judged");
    }
    return table;
  } catch (const base::ConfigError& error) {
    throw base::ConfigError(std::string(error.what()) +
                            "\nrun `talus sensitivity` again, or remove the file");
  }
}

void WriteSensitivity(const SensitivityTable& table, const std::filesystem::path& campaign) {
  base::WriteFileAtomically(SensitivityFile(campaign),
                            base::JsonText(base::ToJson(table), 2) + "\n");
}

}  // namespace talus::analysis
