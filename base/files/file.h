// Whole files, read and written so that a crash or a full disk never leaves half of one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace talus::base {

inline constexpr std::uint64_t kLargestRead = std::uint64_t{4} << 30;  // 4 GiB

// The whole file. Throws ConfigError that names the path when it cannot be read, holds more than
// `limit` bytes, or is no plain file: a pipe or a device may never end.
std::string ReadFile(const std::filesystem::path& path, std::uint64_t limit = kLargestRead);

// The last bytes of a file, at most `count`; empty when it cannot be read.
std::string ReadTail(const std::filesystem::path& path, std::size_t count);

// What the written file survives. kPowerCut: waits for the disk, some milliseconds. kProgram:
// survives a crash of the program but may be lost in a power cut; for what can be made again.
enum class Outlives { kPowerCut, kProgram };

// The last name of a folder's path, whether or not that ends with a slash or is relative (".").
std::string FolderName(const std::filesystem::path& folder);

// Writes beside `path`, syncs, then renames: a reader sees the old file or the new one. Throws
// Error (with the system's reason, such as a full disk) and removes the partial file when it fails.
void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes,
                         Outlives outlives = Outlives::kPowerCut);

// What Unwritten says between a file's name and the system's reason.
inline constexpr std::string_view kUnwritten = ": cannot be written: ";

// Throws Unwritten, which names a file that the system refused to write; `code` is errno's.
[[noreturn]] void ThrowUnwritten(const std::filesystem::path& path, int code);

// XXH3, 64 bits [xxhash]: detects damage, not malice.
std::uint64_t Checksum(std::string_view bytes);

// 16 hexadecimal digits.
std::string Hex(std::uint64_t value);

}  // namespace talus::base
