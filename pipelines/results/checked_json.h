#pragma once
#include <filesystem>
#include <string>

/// JSON files that nurbeam writes and reads back: "checksum" is the SHA-256 of all their other values,
/// however they are laid out.
namespace nurbeam {

/// The text of a JSON object, laid out over lines, with its checksum behind the other values.
std::string with_checksum(const std::string& object);

/// The text of such a file, without the checksum; as it is where it has none, which is of an earlier version.
/// Throws std::invalid_argument (file and reason) where it cannot be read or is no JSON object, DamagedError
/// where the checksum is another.
std::string checked_json(const std::filesystem::path& file);

}  // namespace nurbeam
