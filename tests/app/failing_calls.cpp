// Preloaded into the program, so that calls fail as if a disk were broken or memory short.
//
// - FAIL_CALL=write|rename|fsync|lseek|thread|memory with FAIL_AT=n: the n-th of them fails, once. write is all that writes to files
//   but standard output and error; thread is what the program starts for itself; memory is what the program's own code asks for, from where it handles its first signal: what
//   comes before main() cannot be told, and FFmpeg's and Mesa's libraries abort or crash by themselves where they get none.
//   With FAIL_COUNTED=file the number of such calls is written there when the program ends.
// - FAIL_FROM=n, FAIL_COUNT=m: the n-th rename and the m - 1 behind it fail.
// - FAIL_SEEK=1: every lseek of a file that may be written to.
// - FAIL_OPEN="libEGL libOSMesa": libraries whose names begin so are not there.
// - FAIL_LATE_ENVIRONMENT=1: a variable that is set or taken away behind the start of a first thread, which may be reading the
//   environment just then, ends the program with status 97.
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <signal.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

extern "C" void* __libc_malloc(std::size_t);
extern "C" void* __libc_memalign(std::size_t, std::size_t);

namespace {

int number(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

template <class Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::atomic<long> calls = 0;
std::atomic<bool> in_main = false, has_threads = false;
thread_local bool opens_library = false;  // whose initialisers take functions of the program's for their own

// Counts a call of what FAIL_CALL names, and whether this one is to fail.
bool fails(const char* kind) {
  static const char* const wanted = std::getenv("FAIL_CALL");
  static const long at = number("FAIL_AT", 0);
  return wanted != nullptr && std::strcmp(wanted, kind) == 0 && ++calls == at;
}

bool fails_with_eio(const char* kind) {
  if (!fails(kind)) return false;
  errno = EIO;
  return true;
}

struct Counter {
  ~Counter() {
    const char* const path = std::getenv("FAIL_COUNTED");
    if (path == nullptr) return;
    if (std::FILE* file = std::fopen(path, "w")) {
      std::fprintf(file, "%ld\n", calls.load());
      std::fclose(file);
    }
  }
} counter;

// The code of the program itself: the first that is loaded.
struct OwnCode {
  std::uintptr_t begin = 0, end = 0;

  OwnCode() {
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* self) {
          auto& own = *static_cast<OwnCode*>(self);
          for (int i = 0; i < info->dlpi_phnum; ++i)
            if (info->dlpi_phdr[i].p_type == PT_LOAD && (info->dlpi_phdr[i].p_flags & PF_X) != 0) {
              own.begin = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
              own.end = own.begin + info->dlpi_phdr[i].p_memsz;
            }
          return 1;
        },
        this);
  }
  bool holds(const void* address) const {
    const auto at = reinterpret_cast<std::uintptr_t>(address);
    return at >= begin && at < end;
  }
};

bool is_own(const void* caller) {
  static const OwnCode own;
  return own.holds(caller);
}

bool is_memory_counted() {
  static const char* const wanted = std::getenv("FAIL_CALL");
  return wanted != nullptr && std::strcmp(wanted, "memory") == 0;
}

void* new_memory(std::size_t bytes, std::size_t alignment, const void* caller) {
  if (in_main && !opens_library && is_memory_counted() && is_own(caller) && fails("memory")) throw std::bad_alloc();
  void* const memory = alignment > 16 ? __libc_memalign(alignment, bytes) : __libc_malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void forbid_beside_threads(const char* variable) {
  if (!has_threads || std::getenv("FAIL_LATE_ENVIRONMENT") == nullptr) return;
  std::fprintf(stderr, "%s is changed beside threads\n", variable);
  _exit(97);
}

off_t seek(const char* name, int file, off_t offset, int whence) {
  const bool writes = (fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY;
  if (writes && (number("FAIL_SEEK", 0) != 0 || fails("lseek"))) {
    errno = EIO;
    return -1;
  }
  return real<off_t (*)(int, off_t, int)>(name)(file, offset, whence);
}

}  // namespace

void* operator new(std::size_t bytes) { return new_memory(bytes, 0, __builtin_return_address(0)); }
void* operator new[](std::size_t bytes) { return new_memory(bytes, 0, __builtin_return_address(0)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return new_memory(bytes, std::size_t(alignment), __builtin_return_address(0));
}

extern "C" {

int rename(const char* from, const char* to) noexcept {
  static std::atomic<int> renames = 0;
  const int first = number("FAIL_FROM", 0), count = number("FAIL_COUNT", 1), now = ++renames;
  if ((first > 0 && now >= first && now < first + count) || fails("rename")) {
    errno = EIO;
    return -1;
  }
  return real<int (*)(const char*, const char*)>("rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  if (fails_with_eio("rename")) return -1;
  return real<int (*)(int, const char*, int, const char*, unsigned)>("renameat2")(from_folder, from, to_folder, to, flags);
}

int sigaction(int signal, const struct sigaction* now, struct sigaction* before) noexcept {
  in_main = true;
  return real<int (*)(int, const struct sigaction*, struct sigaction*)>("sigaction")(signal, now, before);
}

int setenv(const char* name, const char* value, int overwrite) noexcept {
  forbid_beside_threads(name);
  return real<int (*)(const char*, const char*, int)>("setenv")(name, value, overwrite);
}
int unsetenv(const char* name) noexcept {
  forbid_beside_threads(name);
  return real<int (*)(const char*)>("unsetenv")(name);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* with) noexcept {
  // By way of the C++ library, as none of its libraries in C.
  Dl_info caller = {};
  if (dladdr(__builtin_return_address(0), &caller) != 0 && std::strstr(caller.dli_fname, "libstdc++") != nullptr && fails("thread"))
    return EAGAIN;
  has_threads = true;
  return real<int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create")(thread, attributes, run, with);
}

int fsync(int file) { return fails_with_eio("fsync") ? -1 : real<int (*)(int)>("fsync")(file); }

ssize_t write(int file, const void* bytes, std::size_t count) {
  if (file > 2 && fails_with_eio("write")) return -1;
  return real<ssize_t (*)(int, const void*, std::size_t)>("write")(file, bytes, count);
}
ssize_t writev(int file, const iovec* parts, int count) {
  if (file > 2 && fails_with_eio("write")) return -1;
  return real<ssize_t (*)(int, const iovec*, int)>("writev")(file, parts, count);
}
ssize_t pwrite(int file, const void* bytes, std::size_t count, off_t at) {
  if (fails_with_eio("write")) return -1;
  return real<ssize_t (*)(int, const void*, std::size_t, off_t)>("pwrite")(file, bytes, count, at);
}
ssize_t pwrite64(int file, const void* bytes, std::size_t count, off64_t at) {
  if (fails_with_eio("write")) return -1;
  return real<ssize_t (*)(int, const void*, std::size_t, off64_t)>("pwrite64")(file, bytes, count, at);
}
std::size_t fwrite(const void* bytes, std::size_t size, std::size_t count, std::FILE* file) {
  if (fileno(file) > 2 && fails_with_eio("write")) return 0;
  return real<std::size_t (*)(const void*, std::size_t, std::size_t, std::FILE*)>("fwrite")(bytes, size, count, file);
}

void* dlopen(const char* file, int flags) noexcept {
  // In a list of names, whether one of them begins the file's.
  const char* missing = file == nullptr ? nullptr : std::getenv("FAIL_OPEN");
  while (missing != nullptr && *missing != '\0') {
    const std::size_t length = std::strcspn(missing, " ");
    if (length > 0 && std::strncmp(file, missing, length) == 0)
      return real<void* (*)(const char*, int)>("dlopen")("library.that.is.not.there", flags);  // for dlerror()
    missing += length + (missing[length] == ' ');
  }
  opens_library = true;
  void* const library = real<void* (*)(const char*, int)>("dlopen")(file, flags);
  opens_library = false;
  return library;
}

off_t lseek(int file, off_t offset, int whence) noexcept { return seek("lseek", file, offset, whence); }
off_t lseek64(int file, off_t offset, int whence) noexcept { return seek("lseek64", file, offset, whence); }

}  // extern "C"
