// SPDX-License-Identifier: GPL-3.0-or-later
/// A library for LD_PRELOAD that makes the n-th call of one kind fail, counted from the beginning of `main`.
///   EARTHTOP_FAULT=KIND:N:MODE  KIND is a name of `kKinds`, N counts from 1, MODE is one of
///                               once (this call fails), on (this one and all later ones), kill (SIGKILL instead of the call)
///   EARTHTOP_FAULT_COUNTS=FILE  where the numbers of calls are written when `main` returns
///   EARTHTOP_FAULT_TRACE=1      the calls that fail are traced on standard error
/// Kind `before` is the allocations before `main`.
#include <dirent.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

enum Kind {
  allocation,
  before,
  thread,
  write_call,
  sync_call,
  rename_call,
  open_call,
  stat_call,
  read_call,
  remove_call,
  change
};
struct KindRow {
  const char* name;
  int error;
};
/// `change` is every call that changes a file or a directory: a process killed at each of them is killed at every moment that
/// leaves another state on disk.
constexpr std::array<KindRow, 11> kKinds = {{{"alloc", ENOMEM},
                                             {"before", ENOMEM},
                                             {"thread", EAGAIN},
                                             {"write", ENOSPC},
                                             {"fsync", EIO},
                                             {"rename", EIO},
                                             {"open", EMFILE},
                                             {"stat", EIO},
                                             {"read", EIO},
                                             {"remove", EIO},
                                             {"change", EIO}}};

std::array<std::atomic<long>, kKinds.size()> counts{};
std::atomic<bool> in_main = false;
int chosen = -1;
long number = 0;
bool goes_on = false, kills = false, traces = false;
__attribute__((tls_model("initial-exec"))) thread_local bool is_tracing = false;

__attribute__((constructor(101))) void read_request() {
  const char* request = std::getenv("EARTHTOP_FAULT");
  if (request == nullptr) return;
  const char* colon = std::strchr(request, ':');
  if (colon == nullptr) return;
  const auto length = static_cast<std::size_t>(colon - request);
  for (std::size_t i = 0; i < kKinds.size(); ++i)
    if (std::strlen(kKinds[i].name) == length && std::strncmp(kKinds[i].name, request, length) == 0)
      chosen = static_cast<int>(i);
  char* mode = nullptr;
  number = std::strtol(colon + 1, &mode, 10);
  goes_on = std::strcmp(mode, ":on") == 0;
  kills = std::strcmp(mode, ":kill") == 0;
  traces = std::getenv("EARTHTOP_FAULT_TRACE") != nullptr;
}

void trace() {
  is_tracing = true;
  std::array<void*, 40> frames{};
  backtrace_symbols_fd(frames.data(), backtrace(frames.data(), static_cast<int>(frames.size())), STDERR_FILENO);
  if (::write(STDERR_FILENO, "\n", 1) < 0) std::abort();
  is_tracing = false;
}

/// Counts a call. @returns whether it has to fail; errno is set then
bool fails(Kind kind) {
  if (is_tracing || in_main != (kind != before)) return false;
  const long count = ++counts[static_cast<std::size_t>(kind)];
  if (static_cast<int>(kind) != chosen || number <= 0 || (goes_on ? count < number : count != number)) return false;
  if (traces) trace();
  if (kills) ::kill(::getpid(), SIGKILL);
  errno = kKinds[static_cast<std::size_t>(kind)].error;
  return true;
}
bool allocation_fails() { return fails(in_main ? allocation : before); }
bool change_fails(Kind kind) { return fails(kind) || fails(change); }

using Main = int (*)(int, char**, char**);
Main program_main = nullptr;

void write_counts() {
  const char* file = std::getenv("EARTHTOP_FAULT_COUNTS");
  if (file == nullptr) return;
  std::FILE* out = std::fopen(file, "w");
  if (out == nullptr) return;
  for (std::size_t i = 0; i < kKinds.size(); ++i) std::fprintf(out, "%s %ld\n", kKinds[i].name, counts[i].load());
  std::fclose(out);
}

int counted_main(int argc, char** argv, char** environment) {
  in_main = true;
  const int status = program_main(argc, argv, environment);
  in_main = false;
  write_counts();
  return status;
}

template <class Function>
Function next(Function, const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// The mode of a file that `open` may create, which is passed only then.
mode_t mode_of(int flags, std::va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}
bool open_fails(int flags) { return fails(open_call) || ((flags & O_CREAT) != 0 && fails(change)); }

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) { return allocation_fails() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return allocation_fails() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* old, std::size_t size) { return allocation_fails() ? nullptr : __libc_realloc(old, size); }
void* memalign(std::size_t alignment, std::size_t size) {
  return allocation_fails() ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return allocation_fails() ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** place, std::size_t alignment, std::size_t size) {
  if (allocation_fails()) return ENOMEM;
  *place = __libc_memalign(alignment, size);
  return *place != nullptr ? 0 : ENOMEM;
}

int __libc_start_main(Main main, int argc, char** argv, int (*init)(int, char**, char**), void (*fini)(), void (*end)(),
                      void* stack) {
  static const auto real = next(__libc_start_main, "__libc_start_main");
  program_main = main;
  return real(counted_main, argc, argv, init, fini, end, stack);
}

int pthread_create(pthread_t* id, const pthread_attr_t* attributes, void* (*start)(void*), void* argument) {
  static const auto real = next(pthread_create, "pthread_create");
  return fails(thread) ? EAGAIN : real(id, attributes, start, argument);
}

#define EARTHTOP_OPEN(name)                                  \
  int name(const char* file, int flags, ...) {               \
    static const auto real = next(name, #name);              \
    std::va_list arguments;                                  \
    va_start(arguments, flags);                              \
    const mode_t mode = mode_of(flags, arguments);           \
    va_end(arguments);                                       \
    return open_fails(flags) ? -1 : real(file, flags, mode); \
  }
EARTHTOP_OPEN(open)
EARTHTOP_OPEN(open64)
#define EARTHTOP_OPENAT(name)                                           \
  int name(int directory, const char* file, int flags, ...) {           \
    static const auto real = next(name, #name);                         \
    std::va_list arguments;                                             \
    va_start(arguments, flags);                                         \
    const mode_t mode = mode_of(flags, arguments);                      \
    va_end(arguments);                                                  \
    return open_fails(flags) ? -1 : real(directory, file, flags, mode); \
  }
EARTHTOP_OPENAT(openat)
EARTHTOP_OPENAT(openat64)

// A call: its result, name, parameters, arguments, and what its failing means.
#define EARTHTOP_CALL(result, name, parameters, arguments, failing, failure) \
  result name parameters {                                                   \
    static const auto real = next(name, #name);                              \
    return failing ? failure : real arguments;                               \
  }
EARTHTOP_CALL(std::FILE*, fopen, (const char* file, const char* mode), (file, mode), fails(open_call), nullptr)
EARTHTOP_CALL(std::FILE*, fopen64, (const char* file, const char* mode), (file, mode), fails(open_call), nullptr)
EARTHTOP_CALL(DIR*, opendir, (const char* name), (name), fails(open_call), nullptr)
EARTHTOP_CALL(ssize_t, write, (int file, const void* data, std::size_t size), (file, data, size), change_fails(write_call), -1)
EARTHTOP_CALL(ssize_t, pwrite, (int file, const void* data, std::size_t size, off_t at), (file, data, size, at),
              change_fails(write_call), -1)
EARTHTOP_CALL(ssize_t, pwrite64, (int file, const void* data, std::size_t size, off64_t at), (file, data, size, at),
              change_fails(write_call), -1)
EARTHTOP_CALL(int, ftruncate, (int file, off_t size), (file, size), change_fails(write_call), -1)
EARTHTOP_CALL(int, ftruncate64, (int file, off64_t size), (file, size), change_fails(write_call), -1)
EARTHTOP_CALL(int, fflush, (std::FILE * file), (file), change_fails(write_call), EOF)
EARTHTOP_CALL(int, fsync, (int file), (file), change_fails(sync_call), -1)
EARTHTOP_CALL(int, fdatasync, (int file), (file), change_fails(sync_call), -1)
EARTHTOP_CALL(int, rename, (const char* from, const char* to), (from, to), change_fails(rename_call), -1)
EARTHTOP_CALL(int, link, (const char* from, const char* to), (from, to), change_fails(rename_call), -1)
EARTHTOP_CALL(int, unlink, (const char* file), (file), change_fails(remove_call), -1)
EARTHTOP_CALL(int, rmdir, (const char* directory), (directory), change_fails(remove_call), -1)
EARTHTOP_CALL(int, mkdir, (const char* directory, mode_t mode), (directory, mode), change_fails(open_call), -1)
EARTHTOP_CALL(int, stat, (const char* file, struct stat* found), (file, found), fails(stat_call), -1)
EARTHTOP_CALL(int, lstat, (const char* file, struct stat* found), (file, found), fails(stat_call), -1)
EARTHTOP_CALL(int, fstat, (int file, struct stat* found), (file, found), fails(stat_call), -1)
EARTHTOP_CALL(int, stat64, (const char* file, struct stat64* found), (file, found), fails(stat_call), -1)
EARTHTOP_CALL(int, lstat64, (const char* file, struct stat64* found), (file, found), fails(stat_call), -1)
EARTHTOP_CALL(int, fstat64, (int file, struct stat64* found), (file, found), fails(stat_call), -1)
EARTHTOP_CALL(ssize_t, read, (int file, void* data, std::size_t size), (file, data, size), fails(read_call), -1)
EARTHTOP_CALL(ssize_t, pread, (int file, void* data, std::size_t size, off_t at), (file, data, size, at), fails(read_call), -1)
EARTHTOP_CALL(ssize_t, pread64, (int file, void* data, std::size_t size, off64_t at), (file, data, size, at), fails(read_call),
              -1)
EARTHTOP_CALL(void*, mmap, (void* place, std::size_t size, int protection, int flags, int file, off_t at),
              (place, size, protection, flags, file, at), fails(allocation), MAP_FAILED)
EARTHTOP_CALL(void*, mmap64, (void* place, std::size_t size, int protection, int flags, int file, off64_t at),
              (place, size, protection, flags, file, at), fails(allocation), MAP_FAILED)

}  // extern "C"
