#include "engine/run/run.h"

#include <charconv>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"

namespace talus::engine {
namespace {

constexpr std::string_view kMagic = "talus run 1\n";

}  // namespace

// Magic; checksum of the rest; input hash, times and state, each on a line; the engine's bytes.
std::string Pack(RunCheckpoint checkpoint) {
  std::ostringstream times;
  times.precision(17);
  times << checkpoint.timing.wall_time << ' ' << checkpoint.timing.cpu_time;
  const std::string no_checksum = base::Hex(0);
  const std::size_t header = kMagic.size() + no_checksum.size() + 1;
  std::string bytes = std::move(checkpoint.simulation);
  bytes.insert(0, std::string(kMagic) + no_checksum + "\n" + base::Hex(checkpoint.input_hash) +
                      "\n" + times.str() + "\n" + checkpoint.state + "\n");
  const std::uint64_t checksum = base::Checksum(std::string_view(bytes).substr(header));
  bytes.replace(kMagic.size(), no_checksum.size(), base::Hex(checksum));
  return bytes;
}

RunCheckpoint Unpack(const std::string& bytes) {
  constexpr std::size_t kDigits = 16;
  const std::size_t header = kMagic.size() + kDigits + 1;
  if (!bytes.starts_with(kMagic)) throw base::Error("is not a checkpoint of this version");
  const std::string_view rest =
      bytes.size() < header ? std::string_view() : std::string_view(bytes).substr(header);
  const std::string expected = base::Hex(base::Checksum(rest)) + "\n";
  if (bytes.compare(kMagic.size(), kDigits + 1, expected) != 0) {
    throw base::Error("is damaged or cut off: its checksum does not fit");
  }
  const std::size_t hash_end = rest.find('\n');
  const std::size_t times_end = rest.find('\n', hash_end + 1);
  const std::size_t state_end = rest.find('\n', times_end + 1);
  if (hash_end != kDigits || times_end == std::string::npos || state_end == std::string::npos ||
      times_end < hash_end || state_end < times_end) {
    throw base::Error("is damaged: its head is not complete");
  }
  RunCheckpoint checkpoint;
  std::from_chars(rest.data(), rest.data() + kDigits, checkpoint.input_hash, 16);
  std::istringstream times(std::string(rest.substr(kDigits + 1, times_end - kDigits - 1)));
  times >> checkpoint.timing.wall_time >> checkpoint.timing.cpu_time;
  checkpoint.state = rest.substr(times_end + 1, state_end - times_end - 1);
  checkpoint.simulation = rest.substr(state_end + 1);
  return checkpoint;
}

}  // namespace talus::engine
