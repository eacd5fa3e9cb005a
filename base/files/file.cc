#include "base/files/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.h"
#include "base/files/descriptor.h"

namespace talus::base {
namespace {

bool WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// Fills `bytes` from `offset` on; what a file that has become shorter lacks is cut off.
bool ReadAll(int fd, std::uint64_t offset, std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count =
        ::pread(fd, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return true;
}

// The new name of a file, which its folder holds. Some file systems sync no folders, and some
// folders may be written but not read; the file itself is safe, so neither is an error.
void SyncFolderOf(const std::filesystem::path& path) {
  const std::filesystem::path parent = path.parent_path();
  const Descriptor folder(
      ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() >= 0) ::fsync(folder.get());
}

}  // namespace

std::string FolderName(const std::filesystem::path& folder) {
  const std::filesystem::path clean = std::filesystem::absolute(folder).lexically_normal();
  return (clean.has_filename() ? clean : clean.parent_path()).filename().string();
}

void ThrowUnwritten(const std::filesystem::path& path, int code) {
  throw Unwritten(path.string() + std::string(kUnwritten) + std::strerror(code));
}

std::string ReadFile(const std::filesystem::path& path, std::uint64_t limit) {
  // Without O_NONBLOCK a pipe that nobody writes to would be waited for.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat info {};
  if (file.get() < 0 || ::fstat(file.get(), &info) != 0) {
    throw ConfigError(path.string() + ": cannot be read: " + std::strerror(errno));
  }
  if (S_ISDIR(info.st_mode)) throw ConfigError(path.string() + ": is a folder; name a file");
  if (!S_ISREG(info.st_mode)) {
    throw ConfigError(path.string() + ": is a pipe or a device; name a plain file");
  }
  const auto size = static_cast<std::uint64_t>(info.st_size);
  if (size > limit) {
    throw ConfigError(path.string() + ": holds " + std::to_string(size >> 20) +
                      " MiB, more than the " + std::to_string(limit >> 20) +
                      " MiB that are read of such a file");
  }
  std::string bytes(size, '\0');
  if (!ReadAll(file.get(), 0, bytes)) {
    throw ConfigError(path.string() + ": reading stopped with an error: " + std::strerror(errno));
  }
  return bytes;
}

std::string ReadTail(const std::filesystem::path& path, std::size_t count) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat info {};
  if (file.get() < 0 || ::fstat(file.get(), &info) != 0 || !S_ISREG(info.st_mode)) return {};
  const auto size = static_cast<std::uint64_t>(info.st_size);
  std::string bytes(std::min<std::uint64_t>(size, count), '\0');
  if (!ReadAll(file.get(), size - bytes.size(), bytes)) return {};
  return bytes;
}

void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes,
                         Outlives outlives) {
  const bool sync = outlives == Outlives::kPowerCut;
  const std::string temporary = path.string() + ".tmp" + std::to_string(::getpid());
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.get() < 0) ThrowUnwritten(path, errno);
  if (!WriteAll(file.get(), bytes) || (sync && ::fsync(file.get()) != 0) || !file.Close() ||
      ::rename(temporary.c_str(), path.c_str()) != 0) {
    const int code = errno;
    ::unlink(temporary.c_str());
    ThrowUnwritten(path, code);
  }
  if (sync) SyncFolderOf(path);
}

std::uint64_t Checksum(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::string Hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

}  // namespace talus::base
