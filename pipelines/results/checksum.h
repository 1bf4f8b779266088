#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

/// Checksums of the files and byte strings that nurbeam reads back: the SHA-256 of all bytes before it, as a
/// line of text at the end. Readers of netCDF and HDF5 take no notice of what follows their data.
namespace nurbeam {

/// A file or a byte string that has not the checksum it was written with.
struct DamagedError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws one that says so of `what`, and the cure.
[[noreturn]] void fail_as_damaged(const std::string& what);

enum class Checksum { right, none };

/// What a file that is to have a checksum says of it in an attribute: without this text it is of an earlier
/// version, which wrote none.
inline constexpr std::string_view checksum_attribute = "nurbeam SHA-256 at the end of the file";

/// Appends the checksum to a complete file. Throws std::runtime_error (file and reason).
void append_checksum(const std::filesystem::path& file);
/// Appends the checksum to a text.
void append_checksum(std::string& text);

/// Whether a file ends with a checksum, right or wrong. Throws std::runtime_error (file and reason).
bool has_checksum(const std::filesystem::path& file);

/// Whether a file has a checksum, which is the one of its bytes. Throws DamagedError where it is another, and
/// where it is missing though the file says that it has one; std::runtime_error (file and reason) where the
/// file cannot be read.
Checksum check_file(const std::filesystem::path& file);

/// Throws DamagedError where a text that is to end with a checksum ends without it or with another. `what`
/// names it in the message.
void check_text(std::string_view text, const std::string& what);

}  // namespace nurbeam
