// A record in a file of its own, with a checksum: what is damaged is taken for what is not there.
#pragma once

#include <filesystem>
#include <optional>

#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/journal/record_json.h"

namespace talus::campaign {

template <base::Visitable Record>
std::optional<Record> ReadRecordFile(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  const auto text = base::IfWhole(base::ReadFile(file));
  if (!text) return std::nullopt;
  return journal::ParseRecord<Record>(*text, file.string());
}

template <base::Visitable Record>
void WriteRecordFile(const std::filesystem::path& file, const Record& record) {
  base::WriteFileAtomically(file,
                            base::WithChecksum(base::JsonText(base::ToJson(record), 1) + "\n"));
}

}  // namespace talus::campaign
