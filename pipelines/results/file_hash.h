#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace nurbeam {

/// SHA-256 of a file's bytes, or of the first `most` of them, as 64 hexadecimal digits. Throws
/// std::runtime_error (file and reason) when the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& file,
                           std::uintmax_t most = std::numeric_limits<std::uintmax_t>::max());

/// SHA-256 of a text, likewise.
std::string sha256_of_text(const std::string& text);

}  // namespace nurbeam
