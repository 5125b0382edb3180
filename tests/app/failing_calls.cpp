// Preloaded into the program: the FAIL_FROM-th rename and the FAIL_COUNT - 1 behind it fail as if the disk were broken;
// with FAIL_SEEK every lseek of a file that may be written to does.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>

#include <cerrno>
#include <cstdlib>

namespace {

int number(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

template <class Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

off_t seek(const char* name, int file, off_t offset, int whence) {
  if (number("FAIL_SEEK", 0) != 0 && (fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY) {
    errno = EIO;
    return -1;
  }
  return real<off_t (*)(int, off_t, int)>(name)(file, offset, whence);
}

}  // namespace

extern "C" {

int rename(const char* from, const char* to) noexcept {
  static int calls = 0;
  const int first = number("FAIL_FROM", 0), count = number("FAIL_COUNT", 1);
  ++calls;
  if (first > 0 && calls >= first && calls < first + count) {
    errno = EIO;
    return -1;
  }
  return real<int (*)(const char*, const char*)>("rename")(from, to);
}

off_t lseek(int file, off_t offset, int whence) noexcept { return seek("lseek", file, offset, whence); }
off_t lseek64(int file, off_t offset, int whence) noexcept { return seek("lseek64", file, offset, whence); }

}  // extern "C"
