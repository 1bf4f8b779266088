#include "cad_import/program/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

namespace nurbeam {

MemoryFile::MemoryFile(std::string_view text) : descriptor_(memfd_create("drawing", MFD_CLOEXEC)) {
  while (descriptor_ >= 0 && !text.empty()) {
    const ssize_t written = write(descriptor_, text.data(), text.size());
    if (written <= 0) break;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  const bool is_written = descriptor_ >= 0 && text.empty();
  if (is_written && access(path().c_str(), R_OK) == 0) return;
  if (descriptor_ >= 0) close(descriptor_);
  throw std::runtime_error(is_written
                               ? "/proc is not mounted, through which OpenCASCADE reads files here; mount it "
                                 "(mount -t proc proc /proc)"
                               : "there is no memory to hold the text of the file");
}

MemoryFile::~MemoryFile() { close(descriptor_); }

std::filesystem::path MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

}  // namespace nurbeam
