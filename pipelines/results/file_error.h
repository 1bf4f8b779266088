#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>

namespace nurbeam {

/// Throws "<file>: <reason>", a std::runtime_error.
[[noreturn]] inline void fail(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": " + reason);
}

/// Throws where something is there that is no file, such as a pipe, which may have to be waited for.
inline void check_is_file(const std::filesystem::path& file) {
  const std::filesystem::file_status status = std::filesystem::status(file);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    fail(file, std::string("is a ") +
                   (std::filesystem::is_directory(status) ? "directory" : "device or a pipe") +
                   "; expected a file");
}

}  // namespace nurbeam
