// A disk that is full from one write on, for full_disk_test.py: loaded before the C library
// (LD_PRELOAD), it refuses what takes room on a disk with ENOSPC, in the program TALUS_FULL_IN
// only.
//
//   TALUS_FULL_FROM=N   the first N - 1 such calls work, all later ones do not
//   TALUS_FULL_COUNT=F  the number of such calls is written to the file F at the end
#include <dlfcn.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>

namespace {

std::atomic<long> calls{0};

bool IsMeant() {
  static const bool meant = [] {
    const char* const wanted = getenv("TALUS_FULL_IN");
    char self[4096] = "";
    return wanted != nullptr && readlink("/proc/self/exe", self, sizeof self - 1) > 0 &&
           strcmp(self, wanted) == 0;
  }();
  return meant;
}

bool IsFull() {
  if (!IsMeant()) return false;
  const long call = ++calls;
  const char* const from = getenv("TALUS_FULL_FROM");
  if (from == nullptr || call < atol(from)) return false;
  errno = ENOSPC;
  return true;
}

bool IsOnDisk(int fd) {
  struct stat info {};
  return fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
}

template <class Function>
Function* Next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool Makes(const char* path, int flags) {
  return (flags & O_CREAT) != 0 && access(path, F_OK) != 0;
}

// Which of them are called is not ours to choose.
const struct Counter {
  ~Counter() {
    const char* const file = getenv("TALUS_FULL_COUNT");
    if (file == nullptr || !IsMeant()) return;
    FILE* const out = fopen(file, "w");
    if (out == nullptr) return;
    fprintf(out, "%ld\n", calls.load());
    fclose(out);
  }
} counter;

}  // namespace

extern "C" {

// NOLINTBEGIN: the names are the C library's
ssize_t write(int fd, const void* bytes, size_t count) {
  static const auto next = Next<decltype(write)>("write");
  return IsOnDisk(fd) && IsFull() ? -1 : next(fd, bytes, count);
}

ssize_t writev(int fd, const struct iovec* parts, int count) {
  static const auto next = Next<decltype(writev)>("writev");
  return IsOnDisk(fd) && IsFull() ? -1 : next(fd, parts, count);
}

ssize_t pwrite(int fd, const void* bytes, size_t count, off_t at) {
  static const auto next = Next<decltype(pwrite)>("pwrite");
  return IsOnDisk(fd) && IsFull() ? -1 : next(fd, bytes, count, at);
}

ssize_t pwrite64(int fd, const void* bytes, size_t count, off64_t at) {
  static const auto next = Next<decltype(pwrite64)>("pwrite64");
  return IsOnDisk(fd) && IsFull() ? -1 : next(fd, bytes, count, at);
}

int fsync(int fd) {
  static const auto next = Next<decltype(fsync)>("fsync");
  return IsOnDisk(fd) && IsFull() ? -1 : next(fd);
}

int mkdir(const char* path, mode_t mode) {
  static const auto next = Next<decltype(mkdir)>("mkdir");
  return access(path, F_OK) != 0 && IsFull() ? -1 : next(path, mode);
}

int open(const char* path, int flags, ...) {
  static const auto next = Next<decltype(open)>("open");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return Makes(path, flags) && IsFull() ? -1 : next(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  static const auto next = Next<decltype(open64)>("open64");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return Makes(path, flags) && IsFull() ? -1 : next(path, flags, mode);
}
// NOLINTEND

}  // extern "C"
