// A library to be preloaded (LD_PRELOAD) that lets the Nth call of a class of system functions
// fail, as in a machine that is out of memory, of room on its disk, of threads or of file
// descriptors.
//
//   FATHOM_FAULT=CLASS:N:MODE   MODE: once, or lasting (the Nth call and all that follow)
//   FATHOM_FAULT_COUNTS=FILE    a file of 4096 bytes, in which the calls of each class are counted
//
// What is counted begins where main() does: the loader and static initializers are as they are.
// Calls are caught where programs and libraries call the C library; what the C library calls itself
// (the stack of a thread, the blocks that malloc takes from the system) belongs to the call that
// asked for it. Standard error is left alone, so that what the program says of the fault is seen.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>

namespace {

enum Class {
  memory,
  map,
  open_,
  read_,
  write_,
  short_write,
  close_,
  sync_,
  rename_,
  thread,
  stat_
};
constexpr const char* names[] = {"memory", "map",  "open", "read",   "write", "short-write",
                                 "close",  "sync", "name", "thread", "stat"};
constexpr int classes = sizeof names / sizeof *names;

/// What the file of counts holds; scripts/dev/check-faults reads it.
struct Counts {
  std::atomic<std::uint64_t> calls[classes];
  std::atomic<std::uint64_t> failed;
};
static_assert(sizeof(Counts) <= 4096);

Counts own_counts{};
Counts* counts = &own_counts;
int chosen = -1;
std::uint64_t first_to_fail = 0;
bool lasting = false;
std::atomic<bool> armed{false};

/// Counts a call; whether it is to fail.
bool fails(Class which) {
  if (!armed.load(std::memory_order_relaxed)) return false;
  const std::uint64_t number = ++counts->calls[which];
  const bool fail =
      which == chosen && (number == first_to_fail || (lasting && number > first_to_fail));
  if (fail) ++counts->failed;
  return fail;
}

bool fails_with(Class which, int error) {
  if (!fails(which)) return false;
  errno = error;
  return true;
}

/// The C library's function of this name.
template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

void read_settings() {
  if (const char* file = ::getenv("FATHOM_FAULT_COUNTS")) {
    const long descriptor = ::syscall(SYS_openat, AT_FDCWD, file, O_RDWR | O_CLOEXEC);
    if (descriptor >= 0) {
      const long page = ::syscall(SYS_mmap, 0L, 4096L, long{PROT_READ | PROT_WRITE},
                                  long{MAP_SHARED}, descriptor, 0L);
      if (page > 0) counts = reinterpret_cast<Counts*>(page);
      ::syscall(SYS_close, descriptor);
    }
  }
  const char* setting = ::getenv("FATHOM_FAULT");
  const char* colon = setting ? ::strchr(setting, ':') : nullptr;
  if (!colon) return;
  for (int i = 0; i < classes; ++i) {
    const std::size_t length = ::strlen(names[i]);
    if (static_cast<std::size_t>(colon - setting) == length &&
        ::strncmp(setting, names[i], length) == 0) {
      chosen = i;
    }
  }
  char* end = nullptr;
  first_to_fail = ::strtoull(colon + 1, &end, 10);
  lasting = ::strcmp(end, ":lasting") == 0;
  // Programs that this one starts are left alone.
  ::unsetenv("FATHOM_FAULT");
  ::unsetenv("FATHOM_FAULT_COUNTS");
}

using Main = int(int, char**, char**);
Main* main_of_program = nullptr;

int armed_main(int count, char** arguments, char** environment) {
  read_settings();
  armed = true;
  return main_of_program(count, arguments, environment);
}

mode_t mode_of(int flags, va_list rest) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : mode_t{0};
}

}  // namespace

#define EXPORT extern "C" __attribute__((visibility("default")))
// The C library's, of the same type as the function that this stands in.
#define NEXT(name) static auto* const real = next<decltype(::name)>(#name)

EXPORT int __libc_start_main(Main* main, int argc, char** argv, void (*init)(), void (*fini)(),
                             void (*rtld_fini)(), void* stack_end) {
  using Start = int(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*);
  main_of_program = main;
  return next<Start>("__libc_start_main")(armed_main, argc, argv, init, fini, rtld_fini, stack_end);
}

// ---- memory

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

EXPORT void* malloc(std::size_t size) {
  return fails_with(memory, ENOMEM) ? nullptr : __libc_malloc(size);
}
EXPORT void* calloc(std::size_t count, std::size_t size) {
  return fails_with(memory, ENOMEM) ? nullptr : __libc_calloc(count, size);
}
EXPORT void* realloc(void* block, std::size_t size) {
  return fails_with(memory, ENOMEM) ? nullptr : __libc_realloc(block, size);
}
EXPORT void* memalign(std::size_t alignment, std::size_t size) {
  return fails_with(memory, ENOMEM) ? nullptr : __libc_memalign(alignment, size);
}
EXPORT void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails_with(memory, ENOMEM) ? nullptr : __libc_memalign(alignment, size);
}
EXPORT int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  if (fails(memory)) return ENOMEM;
  *block = __libc_memalign(alignment, size);
  return *block ? 0 : ENOMEM;
}

EXPORT void* mmap(void* at, std::size_t size, int protection, int flags, int file, off_t offset) {
  if (fails_with(map, ENOMEM)) return MAP_FAILED;
  NEXT(mmap);
  return real(at, size, protection, flags, file, offset);
}
EXPORT void* mmap64(void* at, std::size_t size, int protection, int flags, int file,
                    off64_t offset) {
  if (fails_with(map, ENOMEM)) return MAP_FAILED;
  NEXT(mmap64);
  return real(at, size, protection, flags, file, offset);
}

// ---- threads

EXPORT int pthread_create(pthread_t* id, const pthread_attr_t* attributes, void* (*work)(void*),
                          void* argument) {
  if (fails(thread)) return EAGAIN;
  NEXT(pthread_create);
  return real(id, attributes, work, argument);
}

// ---- opening: no descriptor is left

#define DEFINE_OPEN(name)                             \
  EXPORT int name(const char* path, int flags, ...) { \
    va_list rest;                                     \
    va_start(rest, flags);                            \
    const mode_t mode = mode_of(flags, rest);         \
    va_end(rest);                                     \
    if (fails_with(open_, EMFILE)) return -1;         \
    NEXT(name);                                       \
    return real(path, flags, mode);                   \
  }
DEFINE_OPEN(open)
DEFINE_OPEN(open64)

#define DEFINE_OPENAT(name)                                       \
  EXPORT int name(int folder, const char* path, int flags, ...) { \
    va_list rest;                                                 \
    va_start(rest, flags);                                        \
    const mode_t mode = mode_of(flags, rest);                     \
    va_end(rest);                                                 \
    if (fails_with(open_, EMFILE)) return -1;                     \
    NEXT(name);                                                   \
    return real(folder, path, flags, mode);                       \
  }
DEFINE_OPENAT(openat)
DEFINE_OPENAT(openat64)

EXPORT FILE* fopen(const char* path, const char* mode) {
  if (fails_with(open_, EMFILE)) return nullptr;
  NEXT(fopen);
  return real(path, mode);
}
EXPORT FILE* fopen64(const char* path, const char* mode) {
  if (fails_with(open_, EMFILE)) return nullptr;
  NEXT(fopen64);
  return real(path, mode);
}

// ---- reading: a broken disk

EXPORT ssize_t read(int file, void* to, std::size_t size) {
  if (fails_with(read_, EIO)) return -1;
  NEXT(read);
  return real(file, to, size);
}
EXPORT ssize_t pread(int file, void* to, std::size_t size, off_t offset) {
  if (fails_with(read_, EIO)) return -1;
  NEXT(pread);
  return real(file, to, size, offset);
}
EXPORT ssize_t pread64(int file, void* to, std::size_t size, off64_t offset) {
  if (fails_with(read_, EIO)) return -1;
  NEXT(pread64);
  return real(file, to, size, offset);
}
EXPORT ssize_t readv(int file, const iovec* parts, int count) {
  if (fails_with(read_, EIO)) return -1;
  NEXT(readv);
  return real(file, parts, count);
}
EXPORT std::size_t fread(void* to, std::size_t size, std::size_t count, FILE* file) {
  NEXT(fread);
  if (!fails_with(read_, EIO)) return real(to, size, count, file);
  file->_flags |= 0x20;  // glibc's mark of an error, which ferror() asks for
  return 0;
}

// ---- writing: a full disk. A short write is none: the rest is to be written by another call.

EXPORT ssize_t write(int file, const void* from, std::size_t size) {
  NEXT(write);
  if (file == STDERR_FILENO) return real(file, from, size);
  if (fails_with(write_, ENOSPC)) return -1;
  return real(file, from, size > 1 && fails(short_write) ? size / 2 : size);
}
EXPORT ssize_t pwrite(int file, const void* from, std::size_t size, off_t offset) {
  if (fails_with(write_, ENOSPC)) return -1;
  NEXT(pwrite);
  return real(file, from, size > 1 && fails(short_write) ? size / 2 : size, offset);
}
EXPORT ssize_t pwrite64(int file, const void* from, std::size_t size, off64_t offset) {
  if (fails_with(write_, ENOSPC)) return -1;
  NEXT(pwrite64);
  return real(file, from, size > 1 && fails(short_write) ? size / 2 : size, offset);
}
EXPORT ssize_t writev(int file, const iovec* parts, int count) {
  NEXT(writev);
  if (file == STDERR_FILENO) return real(file, parts, count);
  if (fails_with(write_, ENOSPC)) return -1;
  return real(file, parts, count > 1 && fails(short_write) ? 1 : count);
}
EXPORT std::size_t fwrite(const void* from, std::size_t size, std::size_t count, FILE* file) {
  NEXT(fwrite);
  if (file == stderr) return real(from, size, count, file);
  if (!fails_with(write_, ENOSPC)) return real(from, size, count, file);
  file->_flags |= 0x20;
  return 0;
}
EXPORT int fflush(FILE* file) {
  NEXT(fflush);
  if (file == stderr || !fails_with(write_, ENOSPC)) return real(file);
  return EOF;
}
EXPORT int ftruncate(int file, off_t size) {
  if (fails_with(write_, ENOSPC)) return -1;
  NEXT(ftruncate);
  return real(file, size);
}

// ---- closing: the descriptor is gone all the same

EXPORT int close(int file) {
  NEXT(close);
  const int result = real(file);
  return fails_with(close_, EIO) ? -1 : result;
}
EXPORT int fclose(FILE* file) {
  NEXT(fclose);
  const int result = real(file);
  return fails_with(close_, EIO) ? EOF : result;
}

// ---- to the disk

EXPORT int fsync(int file) {
  if (fails_with(sync_, EIO)) return -1;
  NEXT(fsync);
  return real(file);
}
EXPORT int fdatasync(int file) {
  if (fails_with(sync_, EIO)) return -1;
  NEXT(fdatasync);
  return real(file);
}

// ---- names of files

EXPORT int rename(const char* from, const char* to) noexcept {
  if (fails_with(rename_, EIO)) return -1;
  NEXT(rename);
  return real(from, to);
}
EXPORT int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  if (fails_with(rename_, EIO)) return -1;
  NEXT(renameat);
  return real(from_folder, from, to_folder, to);
}
EXPORT int renameat2(int from_folder, const char* from, int to_folder, const char* to,
                     unsigned flags) noexcept {
  if (fails_with(rename_, EIO)) return -1;
  NEXT(renameat2);
  return real(from_folder, from, to_folder, to, flags);
}
EXPORT int link(const char* from, const char* to) noexcept {
  if (fails_with(rename_, EIO)) return -1;
  NEXT(link);
  return real(from, to);
}
EXPORT int linkat(int from_folder, const char* from, int to_folder, const char* to,
                  int flags) noexcept {
  if (fails_with(rename_, EIO)) return -1;
  NEXT(linkat);
  return real(from_folder, from, to_folder, to, flags);
}
EXPORT int mkdir(const char* path, mode_t mode) noexcept {
  if (fails_with(rename_, EIO)) return -1;
  NEXT(mkdir);
  return real(path, mode);
}

// ---- properties of files

EXPORT int stat(const char* path, struct stat* status) noexcept {
  if (fails_with(stat_, EIO)) return -1;
  static auto* const real = next<int(const char*, struct stat*)>("stat");
  return real(path, status);
}
EXPORT int lstat(const char* path, struct stat* status) noexcept {
  if (fails_with(stat_, EIO)) return -1;
  static auto* const real = next<int(const char*, struct stat*)>("lstat");
  return real(path, status);
}
EXPORT int fstat(int file, struct stat* status) noexcept {
  if (fails_with(stat_, EIO)) return -1;
  static auto* const real = next<int(int, struct stat*)>("fstat");
  return real(file, status);
}
EXPORT int fstatat(int folder, const char* path, struct stat* status, int flags) noexcept {
  if (fails_with(stat_, EIO)) return -1;
  static auto* const real = next<int(int, const char*, struct stat*, int)>("fstatat");
  return real(folder, path, status, flags);
}
EXPORT int faccessat(int folder, const char* path, int mode, int flags) noexcept {
  if (fails_with(stat_, EIO)) return -1;
  NEXT(faccessat);
  return real(folder, path, mode, flags);
}
