#include "experiments/rigs/case/case_text.h"

#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"

namespace talus::rigs {

std::string CaseText(const Case& rig_case) {
  return base::JsonText(base::ToJson(rig_case), 2) + "\n";
}

bool IsSameRun(const Case& a, const Case& b) {
  const auto run = [](Case c) {
    c.outputs = {};
    c.frame.reset();
    c.num_views = 1;
    c.threads = 1;
    c.checkpoint_interval = 0;
    return CaseText(c);
  };
  return run(a) == run(b);
}

std::uint64_t CaseHash(const Case& rig_case) {
  Case relevant = rig_case;
  relevant.threads = 1;
  relevant.checkpoint_interval = 0;
  return base::Checksum(CaseText(relevant));
}

}  // namespace talus::rigs
