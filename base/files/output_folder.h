// A folder that a command writes its results into, without loss of what others keep there.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace talus::base {

// Makes the folder where there is none. It may be new, empty, or one that the same command has
// written before, which the file `.talus` in it says. Throws ConfigError, before anything is
// written, when it holds other files or is the folder of one of `inputs`, and Error when it cannot
// be made. `command` is what a message calls it: "measure".
void ClaimOutputFolder(const std::filesystem::path& folder, std::string_view command,
                       std::span<const std::filesystem::path> inputs = {});

// Makes a folder where there is none. Throws ConfigError when its name is taken by something else,
// and Error when it cannot be made.
void MakeOutputFolder(const std::filesystem::path& folder);

// Whether files can be made in the folder, or the folder where there is none.
bool MayWriteInto(const std::filesystem::path& folder);

// Whether `command` has written into the folder.
bool IsOutputFolder(const std::filesystem::path& folder, std::string_view command);

// Removes the files in a folder, if there is one, whose names begin so: an earlier call of the
// command that writes them may have left more of them than this one will.
void RemoveFormerFiles(const std::filesystem::path& folder, std::string_view prefix);

// Whether a folder is absent or holds no file but those named.
bool HoldsOnly(const std::filesystem::path& folder, std::span<const std::string_view> names);

}  // namespace talus::base
