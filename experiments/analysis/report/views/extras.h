// What lies beside a campaign's journal and only adds to its report: tables, pictures and heaps.
// One that is damaged is left out, and the report says so.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "experiments/analysis/compare/profile_pictures.h"

namespace talus::analysis {

// What was left out, each file once: "DIR/predict/mixer/prediction.json: is empty".
using LeftOut = std::vector<std::string>;

void LeaveOut(const base::ConfigError& error, LeftOut& left_out);

// What `read` gives; an empty one where its file is damaged.
template <class Read>
auto ReadExtra(LeftOut& left_out, const Read& read) -> decltype(read()) {
  try {
    return read();
  } catch (const base::ConfigError& error) {
    LeaveOut(error, left_out);
    return {};
  }
}

// The picture in a file, without a caption; one without a PNG where there is no such file.
Picture ReadPicture(const std::filesystem::path& file, const std::string& name,
                    const std::string& title, LeftOut& left_out);

}  // namespace talus::analysis
