/// A library to be preloaded: counts allocations and system calls, and makes one of them, or all from one on,
/// fail. tests/torture/torture.py uses it.
///
/// QUADRILLE_FAILING_CALL="KIND own|forked NUMBER once|always" fails that call of that kind; "own" counts in
/// the process that was started, "forked" in each process forked from it, from its fork on.
/// QUADRILLE_CALL_COUNTS=FILE, which holds as many 64-bit zeros as counters, gets the number of calls: those
/// of the first process for each kind, then the most of any forked one. Calls that the C library makes inside
/// itself are not seen, so its streams count here as well.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* block, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace {

enum Kind {
  allocating,
  writing,
  reading,
  opening,
  renaming,
  synchronizing,
  closing,
  making_folders,
  mapping,
  kinds
};
constexpr const char* names[kinds] = {"allocate", "write", "read",  "open", "rename",
                                      "fsync",    "close", "mkdir", "mmap"};
constexpr int errors[kinds] = {ENOMEM, ENOSPC, EIO, EMFILE, EIO, EIO, EIO, EACCES, ENOMEM};

std::atomic<bool> watching{false};
std::atomic<long> calls[kinds];
bool forked = false, fails_forked = false, fails_always = false;
int failing_kind = kinds;
long failing_number = 0;
std::int64_t* shared_counts = nullptr;

/// Whether this call is to fail; errno is set then.
bool fails(Kind kind) {
  if (!watching.load(std::memory_order_relaxed)) return false;
  const long number = ++calls[kind];
  if (shared_counts != nullptr) {
    std::int64_t& most = shared_counts[kind + (forked ? kinds : 0)];
    if (number > most) most = number;
  }
  if (kind != failing_kind || forked != fails_forked) return false;
  if (fails_always ? number < failing_number : number != failing_number) return false;
  errno = errors[kind];
  return true;
}

void count_anew() {
  forked = true;
  for (auto& count : calls) count.store(0);
}

void read_order(const char* order) {
  char kind[16] = "", who[16] = "", how[16] = "";
  if (std::sscanf(order, "%15s %15s %ld %15s", kind, who, &failing_number, how) != 4) ::_exit(99);
  for (int i = 0; i < kinds; ++i) {
    if (std::strcmp(kind, names[i]) == 0) failing_kind = i;
  }
  fails_forked = std::strcmp(who, "forked") == 0;
  fails_always = std::strcmp(how, "always") == 0;
}

/// The value of a variable; std::getenv does not know them yet.
const char* value_of(const char* variable, char** environment) {
  const std::size_t length = std::strlen(variable);
  for (; *environment != nullptr; ++environment) {
    if (std::strncmp(*environment, variable, length) == 0 && (*environment)[length] == '=')
      return *environment + length + 1;
  }
  return nullptr;
}

/// Linked with -z initfirst: runs before the constructors of all other libraries, which are watched too.
__attribute__((constructor)) void start(int, char**, char** environment) {
  if (const char* file = value_of("QUADRILLE_CALL_COUNTS", environment)) {
    const int descriptor = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, file, O_RDWR));
    void* pages = reinterpret_cast<void*>(::syscall(SYS_mmap, nullptr, 2 * kinds * sizeof(std::int64_t),
                                                    PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0));
    if (descriptor < 0 || pages == MAP_FAILED) ::_exit(99);
    ::syscall(SYS_close, descriptor);
    shared_counts = static_cast<std::int64_t*>(pages);
  }
  if (const char* order = value_of("QUADRILLE_FAILING_CALL", environment)) read_order(order);
  ::pthread_atfork(nullptr, nullptr, count_anew);
  // oneTBB's free() asks dlsym() at its first call for the C library's, and dlsym() frees the message of a
  // library that was not found: without end, if that is the first call.
  std::free(std::malloc(1));
  watching.store(true);
}

/// The function that would have been called without this library.
template <class Function>
Function next(Function, const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

template <class... Arguments>
int system_call(Kind kind, long number, Arguments... arguments) {
  return fails(kind) ? -1 : static_cast<int>(::syscall(number, arguments...));
}

int open_file(int folder, const char* name, int flags, mode_t mode) {
  return system_call(opening, SYS_openat, folder, name, flags, mode);
}

mode_t mode_of(int flags, va_list more) {
  return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE ? va_arg(more, mode_t) : 0;
}

}  // namespace

#pragma GCC visibility push(default)
#pragma GCC diagnostic ignored "-Wmissing-declarations"
extern "C" {

void* malloc(size_t size) {
  return fails(allocating) ? nullptr : __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  return fails(allocating) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* block, size_t size) {
  return fails(allocating) ? nullptr : __libc_realloc(block, size);
}
void* memalign(size_t alignment, size_t size) {
  return fails(allocating) ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  return memalign(alignment, size);
}
int posix_memalign(void** block, size_t alignment, size_t size) {
  *block = memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  return fails(writing) ? -1 : ::syscall(SYS_write, descriptor, bytes, size);
}
ssize_t writev(int descriptor, const iovec* parts, int count) {
  return fails(writing) ? -1 : ::syscall(SYS_writev, descriptor, parts, count);
}
ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  return fails(writing) ? -1 : ::syscall(SYS_pwrite64, descriptor, bytes, size, offset);
}
ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t offset) {
  return pwrite(descriptor, bytes, size, offset);
}
size_t fwrite(const void* bytes, size_t size, size_t count, FILE* stream) {
  return fails(writing) ? 0 : next(&fwrite, "fwrite")(bytes, size, count, stream);
}
int fflush(FILE* stream) {
  return fails(writing) ? EOF : next(&fflush, "fflush")(stream);
}

ssize_t read(int descriptor, void* bytes, size_t size) {
  return fails(reading) ? -1 : ::syscall(SYS_read, descriptor, bytes, size);
}
size_t fread(void* bytes, size_t size, size_t count, FILE* stream) {
  return fails(reading) ? 0 : next(&fread, "fread")(bytes, size, count, stream);
}

int open(const char* name, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_file(AT_FDCWD, name, flags, mode);
}
int open64(const char* name, int flags, ...) __attribute__((alias("open")));
int openat(int folder, const char* name, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_file(folder, name, flags, mode);
}
int openat64(int folder, const char* name, int flags, ...) __attribute__((alias("openat")));
FILE* fopen(const char* name, const char* mode) {
  return fails(opening) ? nullptr : next(&fopen, "fopen")(name, mode);
}
FILE* fopen64(const char* name, const char* mode) {
  return fopen(name, mode);
}

int rename(const char* from, const char* to) {
  return system_call(renaming, SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
}
int link(const char* from, const char* to) {
  return system_call(renaming, SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0);
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  return system_call(renaming, SYS_linkat, from_folder, from, to_folder, to, flags);
}
int fsync(int descriptor) {
  return system_call(synchronizing, SYS_fsync, descriptor);
}
int fdatasync(int descriptor) {
  return system_call(synchronizing, SYS_fdatasync, descriptor);
}
int mkdir(const char* name, mode_t mode) {
  return system_call(making_folders, SYS_mkdirat, AT_FDCWD, name, mode);
}

// The descriptor is closed all the same, as by Linux.
int close(int descriptor) {
  const bool failing = fails(closing);
  const long result = ::syscall(SYS_close, descriptor);
  if (failing) errno = errors[closing];
  return failing ? -1 : static_cast<int>(result);
}
int fclose(FILE* stream) {
  const bool failing = fails(closing);
  const int result = next(&fclose, "fclose")(stream);
  if (failing) errno = errors[closing];
  return failing ? EOF : result;
}

void* mmap(void* place, size_t size, int protection, int flags, int descriptor, off_t offset) {
  if (fails(mapping)) return MAP_FAILED;
  return reinterpret_cast<void*>(::syscall(SYS_mmap, place, size, protection, flags, descriptor, offset));
}
void* mmap64(void* place, size_t size, int protection, int flags, int descriptor, off64_t offset) {
  return mmap(place, size, protection, flags, descriptor, offset);
}

}  // extern "C"
#pragma GCC visibility pop
