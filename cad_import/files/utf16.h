#pragma once
#include <cstdint>
#include <string>

namespace nurbeam {

/// Adds a character by its number in Unicode.
void append_utf8(std::uint32_t point, std::string& out);

/// A text in UTF-16 of either byte order, with a byte-order mark or beginning with ASCII letters, as UTF-8;
/// any other as it is.
std::string without_utf16(std::string text);

}  // namespace nurbeam
