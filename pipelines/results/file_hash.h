#pragma once
#include <filesystem>
#include <string>

namespace nurbeam {

/// SHA-256 of a file's bytes as 64 hexadecimal digits. Throws std::runtime_error (file and reason) when the
/// file cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

/// SHA-256 of a text, likewise.
std::string sha256_of_text(const std::string& text);

}  // namespace nurbeam
