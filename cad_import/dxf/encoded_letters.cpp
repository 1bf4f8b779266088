#include "cad_import/dxf/encoded_letters.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <optional>

#include "cad_import/files/code_page.h"

namespace nurbeam {
namespace {

/// A letter of the Basic Multilingual Plane.
std::string utf8_of(unsigned code) {
  std::string text;
  const auto tail = [&](unsigned shift) { text += static_cast<char>(0x80 | ((code >> shift) & 0x3F)); };
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | (code >> 6));
    tail(0);
  } else {
    text += static_cast<char>(0xE0 | (code >> 12));
    tail(6);
    tail(0);
  }
  return text;
}

/// The first four digits, hexadecimal.
std::optional<unsigned> four_digits(std::string_view text) {
  constexpr std::size_t count = 4;
  unsigned value = 0;
  if (text.size() < count ||
      std::from_chars(text.data(), text.data() + count, value, 16).ptr != text.data() + count)
    return std::nullopt;
  return value;
}

/// What a letter in several bytes is: they, and the digit before them for their code page.
std::optional<std::string> letter_of_page(char page, std::optional<unsigned> bytes) {
  constexpr std::array pages{"", "ANSI_932", "ANSI_950", "ANSI_949", "ANSI_1361", "ANSI_936"};
  if (page < '1' || page > '5' || !bytes) return std::nullopt;
  std::string text;
  if (*bytes > 0xFF) text += static_cast<char>(*bytes >> 8);
  text += static_cast<char>(*bytes & 0xFF);
  return from_code_page(text, pages[static_cast<std::size_t>(page - '0')]);
}

}  // namespace

std::string decoded_letters(std::string_view value) {
  constexpr std::size_t unicode = 7, several_bytes = 8;  // characters
  std::string text;
  while (!value.empty()) {
    std::optional<std::string> letter;
    std::size_t used = unicode;
    if (value.starts_with("\\U+")) {
      if (const auto code = four_digits(value.substr(3))) letter = utf8_of(*code);
    } else if (value.starts_with("\\M+") && value.size() >= several_bytes) {
      letter = letter_of_page(value[3], four_digits(value.substr(4)));
      used = several_bytes;
    }
    if (!letter) used = 1;
    text += letter.value_or(std::string(1, value[0]));
    value.remove_prefix(used);
  }
  return text;
}

}  // namespace nurbeam
