#include "experiments/campaign/folder/time_taken.h"

#include <charconv>
#include <string>

#include "base/files/file.h"
#include "base/text/number_text.h"
#include "experiments/rigs/case/run_files.h"

namespace talus::campaign {

double TimeTaken(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / rigs::kTookFile;
  if (!std::filesystem::exists(file)) return 0;
  const std::string text = base::ReadFile(file);
  double seconds = 0;
  std::from_chars(text.data(), text.data() + text.size(), seconds);
  return seconds;
}

void KeepTimeTaken(const std::filesystem::path& folder, double seconds) {
  base::WriteFileAtomically(folder / rigs::kTookFile, base::ExactNumber(seconds));
}

}  // namespace talus::campaign
