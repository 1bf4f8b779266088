#include "pipelines/results/checksum.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "pipelines/results/file_error.h"
#include "pipelines/results/file_hash.h"

namespace nurbeam {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view begin = "\nnurbeam SHA-256 ", end = "\n";
constexpr std::size_t digits = 64, line_size = begin.size() + digits + end.size();

std::string line_of(const std::string& digest) { return std::string(begin) + digest + std::string(end); }

bool is_line(std::string_view text) {
  return text.size() == line_size && text.starts_with(begin) && text.ends_with(end);
}

std::uintmax_t size_of(const fs::path& file) {
  check_is_file(file);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) fail(file, "cannot be read: " + error.message());
  return size;
}

// The last bytes of a file, as many as a line of a checksum has; all of a shorter one.
std::string last_line(const fs::path& file, std::uintmax_t size) {
  std::string line(std::min<std::uintmax_t>(size, line_size), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(size - line.size()));
  stream.read(line.data(), static_cast<std::streamsize>(line.size()));
  if (!stream) fail(file, std::string("cannot be read: ") + std::strerror(errno));
  return line;
}

bool contains(const fs::path& file, std::string_view text) {
  std::ifstream stream(file, std::ios::binary);
  std::string piece(1 << 16, '\0');
  std::size_t kept = 0;  // of the piece before, in which the text may begin
  while (stream) {
    stream.read(piece.data() + kept, static_cast<std::streamsize>(piece.size() - kept));
    const std::string_view there(piece.data(), kept + static_cast<std::size_t>(stream.gcount()));
    if (there.find(text) != std::string_view::npos) return true;
    kept = std::min(there.size(), text.size());
    std::memmove(piece.data(), there.data() + there.size() - kept, kept);
  }
  return false;
}

}  // namespace

void fail_as_damaged(const std::string& what) {
  throw DamagedError(what +
                     ": is damaged or was changed: it has not the checksum (SHA-256) that it was written "
                     "with; take an undamaged copy, or make it anew");
}

void append_checksum(const fs::path& file) {
  const std::string line = line_of(sha256_of_file(file));
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::app);
  stream << line;
  stream.close();
  if (!stream) fail(file, std::string("cannot be written: ") + std::strerror(errno));
}

void append_checksum(std::string& text) { text += line_of(sha256_of_text(text)); }

bool has_checksum(const fs::path& file) { return is_line(last_line(file, size_of(file))); }

Checksum check_file(const fs::path& file) {
  const std::uintmax_t size = size_of(file);
  const std::string line = last_line(file, size);
  if (!is_line(line)) {
    if (contains(file, checksum_attribute)) fail_as_damaged(file.string());
    return Checksum::none;
  }
  if (line != line_of(sha256_of_file(file, size - line_size))) fail_as_damaged(file.string());
  return Checksum::right;
}

void check_text(std::string_view text, const std::string& what) {
  const std::string_view line = text.substr(text.size() - std::min(text.size(), line_size));
  if (!is_line(line)) fail_as_damaged(what);
  if (line != line_of(sha256_of_text(std::string(text.substr(0, text.size() - line_size)))))
    fail_as_damaged(what);
}

}  // namespace nurbeam
