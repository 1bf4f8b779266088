#include "cad_import/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

namespace nurbeam {

namespace fs = std::filesystem;

namespace {

// Waits until a file, or the names in a directory, are on the disk. False with errno where that fails.
bool reaches_the_disk(const fs::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  // Some file systems cannot synchronise a directory, and say so.
  const bool done = fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS;
  const int reason = errno;
  close(descriptor);
  errno = reason;
  return done;
}

[[noreturn]] void fail(const fs::path& file, const std::string& reason) {
  std::error_code ignored;
  fs::remove(temporary_name(file), ignored);
  throw std::runtime_error(file.string() + ": " + reason);
}

// Why the temporary file cannot be given its name, which it has afterwards if there is no reason.
std::optional<std::string> obstacle_to_publishing(const fs::path& file) {
  if (!reaches_the_disk(temporary_name(file)))
    return std::string("cannot be written: ") + std::strerror(errno);
  std::error_code error;
  fs::rename(temporary_name(file), file, error);
  if (error) return "cannot be renamed from its temporary name: " + error.message();
  const fs::path directory = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!reaches_the_disk(directory))
    return std::string("its directory cannot be written: ") + std::strerror(errno);
  return std::nullopt;
}

std::optional<std::string> obstacle_to_writing(const fs::path& file, const std::string& text) {
  errno = 0;
  std::ofstream out(temporary_name(file), std::ios::binary);
  out << text;
  out.close();
  if (!out) return "cannot be written: " + std::generic_category().message(errno);
  return obstacle_to_publishing(file);
}

}  // namespace

fs::path temporary_name(const fs::path& file) { return file.string() + ".part"; }

void publish(const fs::path& file) {
  if (const auto obstacle = obstacle_to_publishing(file)) fail(file, *obstacle);
}

std::vector<Diagnostic> write_at_once(const fs::path& file, const std::string& text) {
  const std::optional<std::string> obstacle = obstacle_to_writing(file, text);
  if (!obstacle) return {};
  std::error_code ignored;
  fs::remove(temporary_name(file), ignored);
  return {{Severity::error, file.string(), *obstacle}};
}

}  // namespace nurbeam
