#pragma once
#include <filesystem>
#include <string>

namespace nurbeam {

/// Writes the text to a temporary name and renames it: a reader of `file` sees the old content or the whole
/// of the new one. Throws std::runtime_error when that fails; no part of it is left.
void write_at_once(const std::filesystem::path& file, const std::string& text);

}  // namespace nurbeam
