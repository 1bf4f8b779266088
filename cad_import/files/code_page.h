#pragma once
#include <optional>
#include <string>

namespace nurbeam {

/// Whether a code page of this name, as drawings declare it (ANSI_1251, DOS850, GB2312, ISO8859-2,
/// MACINTOSH), is known; the case of its letters does not count.
bool is_known_code_page(const std::string& page);

/// Whether some of its letters have two bytes: those of China, Japan and Korea.
bool has_letters_of_two_bytes(const std::string& page);

/// The text, which is in this code page, in UTF-8; U+FFFD for bytes that are no letter of it. Of a page that
/// is not known the text is taken for Windows-1252.
std::string from_code_page(const std::string& text, const std::string& page);

}  // namespace nurbeam
