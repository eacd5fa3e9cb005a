#include "experiments/rigs/case/case_text.h"

#include "base/files/file.h"
#include "base/json/json_changes.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"

namespace talus::rigs {

std::string CaseText(const Case& rig_case) {
  return base::JsonText(base::ToJson(rig_case), 2) + "\n";
}

std::optional<std::string> RunDifference(const Case& there, const Case& here) {
  const auto run = [](Case c) {
    c.outputs = {};
    c.frame.reset();
    c.num_views = 1;
    c.threads = 1;
    c.checkpoint_interval = 0;
    return base::ToJson(c);
  };
  const auto changes = base::JsonChanges(run(there), run(here));
  if (changes.empty()) return std::nullopt;
  const base::JsonChange& first = changes.front();
  return first.path + " is " + first.before + " there and " + first.after + " here";
}

std::uint64_t CaseHash(const Case& rig_case) {
  Case relevant = rig_case;
  relevant.threads = 1;
  relevant.checkpoint_interval = 0;
  return base::Checksum(CaseText(relevant));
}

}  // namespace talus::rigs
