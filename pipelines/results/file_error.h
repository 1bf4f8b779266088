#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>

namespace nurbeam {

/// Throws "<file>: <reason>", a std::runtime_error.
[[noreturn]] inline void fail(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": " + reason);
}

}  // namespace nurbeam
