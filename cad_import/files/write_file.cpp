#include "cad_import/files/write_file.h"

#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error("cannot write " + file.string() + ": " + what);
}

void write_text(const fs::path& file, const std::string& text) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) fail(file, std::generic_category().message(errno));
}

}  // namespace

void write_at_once(const fs::path& file, const std::string& text) {
  fs::path temporary = file;
  temporary += ".part" + std::to_string(getpid());
  std::error_code ignored;
  try {
    write_text(temporary, text);
    fs::rename(temporary, file);
  } catch (const fs::filesystem_error& e) {
    fs::remove(temporary, ignored);
    fail(file, e.code().message());
  } catch (const std::runtime_error&) {
    fs::remove(temporary, ignored);
    throw;
  }
}

}  // namespace nurbeam
