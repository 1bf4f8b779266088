#pragma once
#include <filesystem>
#include <string_view>

namespace nurbeam {

/// A text as a file for those who read files only; it is on no disk and gone with this.
class MemoryFile {
 public:
  /// Throws std::runtime_error when there is no memory for it, or no /proc to find it under.
  explicit MemoryFile(std::string_view text);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::filesystem::path path() const;

 private:
  int descriptor_;
};

}  // namespace nurbeam
