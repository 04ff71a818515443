// Preloaded into a program (LD_PRELOAD), lets calls that write into a folder fail as on a full disk:
//   FAIL_PROGRAM=NAME  in this program only
//   FAIL_FOLDER=DIR    below this folder only
//   FAIL_AT=K          the K-th such call, counted from 1; with FAIL_ONWARD=1 every later one too
//   FAIL_BYTES=N       instead of FAIL_AT: there is room for so many bytes
//   FAIL_MARK=FILE     is made once anything has failed
//   FAIL_THREADS=NAME  no thread can be started from a library of such a name
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<long> calls{0}, bytesLeft{-1};

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

long numberOf(const char* name) {
  return std::strtol(setting(name), nullptr, 10);
}

bool isBelow(const char* path) {
  static const bool meant = std::strcmp(setting("FAIL_PROGRAM"), program_invocation_short_name) == 0;
  const char* folder = setting("FAIL_FOLDER");
  return meant && *folder != '\0' && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool isBelow(int descriptor) {
  char link[40] = "/proc/self/fd/", path[4096];
  char digits[12];
  int n = 0;
  for (int rest = descriptor; n == 0 || rest > 0; rest /= 10)
    digits[n++] = static_cast<char>('0' + rest % 10);
  char* end = link + std::strlen(link);
  while (n > 0) *end++ = digits[--n];
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length <= 0) return false;
  path[length] = '\0';
  return isBelow(path);
}

int refuse() {
  const int mark =
      static_cast<int>(syscall(SYS_openat, AT_FDCWD, setting("FAIL_MARK"), O_WRONLY | O_CREAT, 0644));
  if (mark >= 0) syscall(SYS_close, mark);
  errno = ENOSPC;
  return -1;
}

// Whether this call is one that fails.
bool isDue() {
  const long at = numberOf("FAIL_AT");
  if (at <= 0) return false;
  const long now = ++calls;
  return now == at || (now > at && numberOf("FAIL_ONWARD") != 0);
}

// How much of so many bytes there is room for; all of them where nothing limits that.
size_t roomFor(size_t bytes) {
  if (*setting("FAIL_BYTES") == '\0') return bytes;
  long unset = -1;
  bytesLeft.compare_exchange_strong(unset, numberOf("FAIL_BYTES"));
  const long left = bytesLeft;
  const size_t room = left < static_cast<long>(bytes) ? static_cast<size_t>(left) : bytes;
  bytesLeft -= static_cast<long>(room);
  return room;
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* data, size_t size) {
  static const auto call = real<ssize_t(int, const void*, size_t)>("write");
  if (size > 0 && isBelow(descriptor)) {
    if (isDue()) return refuse();
    size = roomFor(size);
    if (size == 0) return refuse();
  }
  return call(descriptor, data, size);
}

ssize_t writev(int descriptor, const iovec* parts, int count) {
  static const auto call = real<ssize_t(int, const iovec*, int)>("writev");
  if (isBelow(descriptor)) {
    if (isDue()) return refuse();
    if (*setting("FAIL_BYTES") != '\0' && count > 0) {
      for (; count > 1 && parts->iov_len == 0; --count) ++parts;
      return write(descriptor, parts->iov_base, parts->iov_len);
    }
  }
  return call(descriptor, parts, count);
}

ssize_t pwrite(int descriptor, const void* data, size_t size, off_t offset) {
  static const auto call = real<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  if (isBelow(descriptor) && isDue()) return refuse();
  return call(descriptor, data, size, offset);
}

int fsync(int descriptor) {
  static const auto call = real<int(int)>("fsync");
  if (isBelow(descriptor) && isDue()) return refuse();
  return call(descriptor);
}

int ftruncate(int descriptor, off_t size) noexcept {
  static const auto call = real<int(int, off_t)>("ftruncate");
  if (isBelow(descriptor) && isDue()) return refuse();
  return call(descriptor, size);
}

int rename(const char* from, const char* to) noexcept {
  static const auto call = real<int(const char*, const char*)>("rename");
  if (isBelow(from) && isDue()) return refuse();
  return call(from, to);
}

int mkdir(const char* path, mode_t mode) noexcept {
  static const auto call = real<int(const char*, mode_t)>("mkdir");
  if (isBelow(path) && isDue()) return refuse();
  return call(path, mode);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) noexcept {
  using Create = int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto call = real<Create>("pthread_create");
  const char* refused = setting("FAIL_THREADS");
  Dl_info caller{};
  if (*refused != '\0' && dladdr(__builtin_return_address(0), &caller) != 0 &&
      std::strstr(caller.dli_fname, refused))
    return EAGAIN;
  return call(thread, attributes, start, argument);
}

}  // extern "C"
