#include "experiments/campaign/folder/design_folder.h"

#include <algorithm>

#include "base/text/number_text.h"
#include "experiments/campaign/folder/record_file.h"
#include "optimizer/space/point_rows.h"

namespace talus::campaign {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecord = "design.json";

}  // namespace

Eigen::VectorXd PointOf(const DesignRecord& record, std::size_t index) {
  return optimizer::VectorOf(record.points[index]);
}

fs::path DesignFolder::trial(std::size_t index) const {
  return root / "trials" / base::FileNumber(static_cast<std::int64_t>(index) + 1);
}

std::optional<DesignRecord> DesignFolder::Read() const {
  return ReadRecordFile<DesignRecord>(root / kRecord);  // damaged: it is simulated again
}

void DesignFolder::Make(const DesignRecord& record) const {
  fs::remove_all(root);
  fs::create_directories(root);
  WriteRecordFile(root / kRecord, record);
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
