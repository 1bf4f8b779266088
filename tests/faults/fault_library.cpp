// A library to be preloaded: it counts calls of the operating system on files below a directory, and lets one
// of them fail, or ends the process there. What is asked for stands in the environment:
//
// FAULT_DIRECTORY  files below it are counted, and all allocations
// FAULT_PROGRAM    only in processes of that name (/proc/self/comm)
// FAULT_CALLS      letters of the calls that are counted: o open for writing, w write, f fsync, r rename, u
// unlink,
//                  c close, m mkdir, t truncate, p mmap, a malloc
// FAULT_NUMBER     of the call that fails, from 1; 0: none
// FAULT_KIND       the error: EIO, ENOSPC or ENOMEM; "short": half of it is written; "kill": the process ends
// there;
//                  "power": so, and every file loses half of what it has been written without fsync
// FAULT_STICKY     1: all later calls fail too, as on a disk that stays full
// FAULT_LOG        gets a line for each counted call, or the one that fails: number, letter, file; of a
// malloc
//                  the library that asks for it, nothing where the program does; and "crash" with the library
//                  in which the process crashes
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>
#include <string>

namespace {

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

std::string program_name() {
  char name[64] = {};
  const int file = real<int(const char*, int, ...)>("open")("/proc/self/comm", O_RDONLY);
  const ssize_t size = file < 0 ? 0 : read(file, name, sizeof name - 1);
  if (file >= 0) real<int(int)>("close")(file);
  return {name, static_cast<std::size_t>(size > 0 ? size - 1 : 0)};  // without the end of the line
}

struct Faults {
  std::string directory = environment("FAULT_DIRECTORY"), calls = environment("FAULT_CALLS"),
              kind = environment("FAULT_KIND");
  long number = std::atol(environment("FAULT_NUMBER").c_str());
  bool sticky = environment("FAULT_STICKY") == "1";
  int log = -1;
  bool active = !directory.empty() &&
                (environment("FAULT_PROGRAM").empty() || environment("FAULT_PROGRAM") == program_name());
  std::atomic<long> count = 0;
  std::recursive_mutex mutex;
  std::set<std::string> unsynchronised;

  Faults() {
    if (const std::string file = environment("FAULT_LOG"); active && !file.empty())
      log = real<int(const char*, int, ...)>("open")(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC,
                                                     0666);
  }
};

std::atomic<bool> is_ready = false;
Faults* faults = nullptr;
thread_local bool inside = false;  // what the library itself does is not counted

bool counts() { return is_ready && !inside; }

/// The library in which memory is asked for, those of the language and this one apart; empty in a program.
std::string asking_library() {
  void* callers[24];
  const int count = backtrace(callers, 24);
  for (int i = 0; i < count; ++i) {
    Dl_info info;
    if (dladdr(callers[i], &info) == 0 || !info.dli_fname) continue;
    const std::string file = info.dli_fname, name = file.substr(file.rfind('/') + 1);
    const bool is_language = name.starts_with("libc.so") || name.starts_with("libstdc++") ||
                             name.starts_with("libgcc_s") || name.starts_with("libfault") ||
                             name.starts_with("ld-linux");
    if (!is_language) return name.find(".so") == std::string::npos ? "" : name;
  }
  return "";
}

void log_crash(int signal_number) {
  inside = true;
  const std::string line = "crash " + asking_library() + "\n";
  [[maybe_unused]] const ssize_t ignored =
      real<ssize_t(int, const void*, size_t)>("write")(faults->log, line.data(), line.size());
  std::signal(signal_number, SIG_DFL);
  raise(signal_number);
}

__attribute__((constructor)) void begin() {
  inside = true;
  faults = new Faults;
  inside = false;
  is_ready = faults->active;
  if (is_ready && faults->log >= 0)
    for (int crash : {SIGSEGV, SIGBUS, SIGABRT}) std::signal(crash, log_crash);
}

std::string absolute(const char* path) {
  if (!path || *path == '\0') return {};
  if (*path == '/') return path;
  char here[PATH_MAX];
  return getcwd(here, sizeof here) ? std::string(here) + "/" + path : path;
}

std::string path_of(int descriptor) {
  char path[PATH_MAX];
  const ssize_t size = readlink(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), path, sizeof path);
  return {path, static_cast<std::size_t>(size > 0 ? size : 0)};
}

bool is_below(const std::string& path) { return path.starts_with(faults->directory + "/"); }

[[noreturn]] void end_process(bool power_fails) {
  if (power_fails)
    for (const std::string& file : faults->unsynchronised) {
      struct stat status;
      if (stat(file.c_str(), &status) == 0 &&
          real<int(const char*, off_t)>("truncate")(file.c_str(), status.st_size / 2) != 0)
        continue;
    }
  kill(getpid(), SIGKILL);
  for (;;) pause();
}

constexpr int goes_on = 0, is_short = -1;

// Counts a call: goes_on, is_short, or the error that it is to have.
int fate(char letter, const std::string& what) {
  if (faults->calls.find(letter) == std::string::npos) return goes_on;
  const long number = ++faults->count;
  if (faults->log >= 0 && (faults->number == 0 || number == faults->number)) {
    char line[PATH_MAX + 64];
    const int size = std::snprintf(line, sizeof line, "%ld %c %s\n", number, letter, what.c_str());
    [[maybe_unused]] const ssize_t ignored =
        real<ssize_t(int, const void*, size_t)>("write")(faults->log, line, static_cast<size_t>(size));
  }
  if (faults->number == 0 || (faults->sticky ? number < faults->number : number != faults->number))
    return goes_on;
  if (faults->kind == "kill" || faults->kind == "power") end_process(faults->kind == "power");
  if (faults->kind == "short") return letter == 'w' ? is_short : ENOSPC;
  return faults->kind == "ENOSPC" ? ENOSPC : faults->kind == "ENOMEM" ? ENOMEM : EIO;
}

/// A call on a file, whose fate is known; errno is as it was where it goes on.
class Call {
 public:
  Call(char letter, const std::string& path) {
    const int before = errno;
    if (counts() && is_below(path)) {
      const std::lock_guard lock(faults->mutex);
      inside = true;
      fate_ = fate(letter, path);
      if (fate_ == goes_on || fate_ == is_short) note(letter, path);
      inside = false;
    }
    errno = fate_ > 0 ? fate_ : before;
  }
  bool fails() const { return fate_ > 0; }
  bool is_cut() const { return fate_ == is_short; }

 private:
  static void note(char letter, const std::string& path) {
    if (letter == 'w' || letter == 't') faults->unsynchronised.insert(path);
    if (letter == 'f' || letter == 'u') faults->unsynchronised.erase(path);
  }
  int fate_ = goes_on;
};

std::string file_of(int descriptor) {
  if (!counts()) return {};
  inside = true;
  const int before = errno;
  std::string path = path_of(descriptor);
  errno = before;
  inside = false;
  return path;
}

std::string named(const char* path) {
  if (!counts()) return {};
  inside = true;
  std::string found = absolute(path);
  inside = false;
  return found;
}

bool writes(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }

mode_t mode_of(int flags, va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

ssize_t cut_short(int descriptor, const void* bytes, size_t size) {
  const ssize_t written = real<ssize_t(int, const void*, size_t)>("write")(descriptor, bytes, size / 2);
  errno = ENOSPC;
  return written;
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t size) {
  const Call call('w', file_of(descriptor));
  if (call.fails()) return -1;
  if (call.is_cut()) return cut_short(descriptor, bytes, size);
  return real<ssize_t(int, const void*, size_t)>("write")(descriptor, bytes, size);
}

ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  const Call call('w', file_of(descriptor));
  if (call.fails()) return -1;
  return real<ssize_t(int, const struct iovec*, int)>("writev")(descriptor, parts, count);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t at) {
  const Call call('w', file_of(descriptor));
  if (call.fails()) return -1;
  const ssize_t written = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64")(
      descriptor, bytes, call.is_cut() ? size / 2 : size, at);
  if (call.is_cut()) errno = ENOSPC;
  return call.is_cut() ? -1 : written;
}
ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t at) {
  return pwrite64(descriptor, bytes, size, at);
}

int fsync(int descriptor) {
  const Call call('f', file_of(descriptor));
  return call.fails() ? -1 : real<int(int)>("fsync")(descriptor);
}
int fdatasync(int descriptor) {
  const Call call('f', file_of(descriptor));
  return call.fails() ? -1 : real<int(int)>("fdatasync")(descriptor);
}

int ftruncate64(int descriptor, off64_t size) {
  const Call call('t', file_of(descriptor));
  return call.fails() ? -1 : real<int(int, off64_t)>("ftruncate64")(descriptor, size);
}
int ftruncate(int descriptor, off_t size) { return ftruncate64(descriptor, size); }

// Closed it is, whatever it says.
int close(int descriptor) {
  const Call call('c', file_of(descriptor));
  const int result = real<int(int)>("close")(descriptor);
  if (!call.fails()) return result;
  errno = EIO;
  return -1;
}

int rename(const char* from, const char* to) {
  const Call call('r', named(to));
  if (call.fails()) return -1;
  const int result = real<int(const char*, const char*)>("rename")(from, to);
  if (result == 0 && counts()) {
    const std::lock_guard lock(faults->mutex);
    const std::string before = named(from), now = named(to);
    inside = true;
    if (faults->unsynchronised.erase(before) > 0)
      faults->unsynchronised.insert(now);
    else
      faults->unsynchronised.erase(now);
    inside = false;
  }
  return result;
}

int unlink(const char* path) {
  const Call call('u', named(path));
  return call.fails() ? -1 : real<int(const char*)>("unlink")(path);
}
int remove(const char* path) {
  const Call call('u', named(path));
  return call.fails() ? -1 : real<int(const char*)>("remove")(path);
}
int mkdir(const char* path, mode_t mode) {
  const Call call('m', named(path));
  return call.fails() ? -1 : real<int(const char*, mode_t)>("mkdir")(path, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  const Call call('o', writes(flags) ? named(path) : std::string());
  return call.fails() ? -1 : real<int(const char*, int, ...)>("open64")(path, flags, mode);
}
int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open64(path, flags, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  const Call call('o', *mode == 'r' ? std::string() : named(path));
  return call.fails() ? nullptr : real<FILE*(const char*, const char*)>("fopen64")(path, mode);
}
FILE* fopen(const char* path, const char* mode) { return fopen64(path, mode); }

void* mmap64(void* at, size_t size, int protection, int flags, int descriptor, off64_t offset) {
  const Call call('p', descriptor < 0 ? std::string() : file_of(descriptor));
  if (call.fails()) return MAP_FAILED;
  return real<void*(void*, size_t, int, int, int, off64_t)>("mmap64")(at, size, protection, flags, descriptor,
                                                                      offset);
}
void* mmap(void* at, size_t size, int protection, int flags, int descriptor, off_t offset) {
  return mmap64(at, size, protection, flags, descriptor, offset);
}

// Of the C library, which the allocations of C++ go through.
void* __libc_malloc(size_t size);
void* malloc(size_t size) {
  if (counts()) {
    inside = true;
    const bool is_counted = faults->calls.find('a') != std::string::npos;
    const bool is_told =
        is_counted && faults->log >= 0 && (faults->number == 0 || faults->count + 1 == faults->number);
    const std::string what = is_told ? asking_library() : "";
    const int before = errno, fated = is_counted ? fate('a', what) : goes_on;
    inside = false;
    errno = before;
    if (fated > 0) {
      errno = ENOMEM;
      return nullptr;
    }
  }
  return __libc_malloc(size);
}
}
