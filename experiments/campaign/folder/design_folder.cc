#include "experiments/campaign/folder/design_folder.h"

#include <algorithm>

#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/number_text.h"
#include "experiments/journal/record_json.h"

namespace talus::campaign {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecord = "design.json";

}  // namespace

fs::path DesignFolder::trial(std::size_t index) const {
  return root / "trials" / base::FileNumber(static_cast<std::int64_t>(index) + 1);
}

std::optional<DesignRecord> DesignFolder::Read() const {
  const fs::path file = root / kRecord;
  if (!fs::exists(file)) return std::nullopt;
  const auto text = base::IfWhole(base::ReadFile(file));
  if (!text) return std::nullopt;  // damaged: it is simulated again
  return journal::ParseRecord<DesignRecord>(*text, file.string());
}

void DesignFolder::Make(const DesignRecord& record) const {
  fs::remove_all(root);
  fs::create_directories(root);
  base::WriteFileAtomically(root / kRecord,
                            base::WithChecksum(base::JsonText(base::ToJson(record), 1) + "\n"));
}

fs::path NextFolder(const fs::path& campaign) { return fs::absolute(campaign) / "next"; }

std::vector<DesignFolder> DesignsOf(const fs::path& campaign) {
  std::vector<DesignFolder> designs;
  const fs::path next = NextFolder(campaign);
  if (!fs::is_directory(next)) return designs;
  for (const fs::directory_entry& entry : fs::directory_iterator(next)) {
    if (fs::exists(entry.path() / kRecord)) designs.push_back({entry.path()});
  }
  std::sort(designs.begin(), designs.end(),
            [](const DesignFolder& a, const DesignFolder& b) { return a.root < b.root; });
  return designs;
}

}  // namespace talus::campaign
