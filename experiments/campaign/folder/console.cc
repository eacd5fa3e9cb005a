#include "experiments/campaign/folder/console.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/printable.h"
#include "experiments/journal/journal.h"

namespace talus::campaign {
namespace {

void PrintEvent(const char* event, const nlohmann::ordered_json& fields) {
  nlohmann::ordered_json line{{"event", event}, {"time_utc", journal::UtcNow()}};
  line.update(fields);
  std::cout << base::JsonText(line) << std::endl;
}

}  // namespace

Console::Console(std::filesystem::path log, Output output,
                 std::chrono::steady_clock::duration period)
    : log_(std::move(log)),
      output_(output),
      terminal_(output == Output::kStandardError && ::isatty(STDERR_FILENO) == 1),
      period_(period),
      said_(std::chrono::steady_clock::now()) {}

Console::~Console() { ClearStatus(); }

void Console::ClearStatus() {
  if (std::exchange(status_shown_, false)) base::EraseTerminalLine(STDERR_FILENO);
}

// A log that cannot be written is no reason to end: what matters is in the journal.
void Console::Log(const std::string& text) {
  std::ofstream(log_, std::ios::app) << journal::UtcNow() << ' ' << base::Printable(text) << '\n';
}

void Console::Line(const std::string& text) {
  ClearStatus();
  if (output_ == Output::kStandardError) std::cerr << text << std::endl;
  if (output_ == Output::kJson) PrintEvent("message", {{"text", text}});
  Log(text);
}

void Console::Trial(const TrialProgress& trial) {
  ClearStatus();
  // Reused ones come by dozens at once, and one line has told of them.
  const bool shown = output_ == Output::kStandardError && trial.kind != journal::TrialKind::kReused;
  if (shown) std::cerr << ProgressText(trial) << std::endl;
  if (output_ == Output::kJson) PrintEvent("trial", base::ToJson(trial));
  Log(ProgressText(trial));
}

void Console::Status(const CampaignProgress& progress) {
  if (output_ == Output::kJson) {
    const nlohmann::ordered_json json = base::ToJson(progress);
    const std::string text = base::JsonText(json);
    if (std::exchange(last_status_, text) != text) PrintEvent("progress", json);
  }
  if (!terminal_) {
    const auto now = std::chrono::steady_clock::now();
    if (output_ != Output::kStandardError || now - said_ < period_) return;
    said_ = now;
    std::cerr << ProgressText(progress) << std::endl;
    return;
  }
  base::EraseTerminalLine(STDERR_FILENO);
  std::cerr << ProgressText(progress) << std::flush;
  status_shown_ = true;
}

}  // namespace talus::campaign
