#include "cad_import/step/encoded_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <sstream>

#include "cad_import/files/utf16.h"

namespace nurbeam {
namespace {

/// The number of so many hexadecimal digits; 0 where they are none.
std::uint32_t hexadecimal(std::string_view digits) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  return error == std::errc() && end == digits.data() + digits.size() ? number : 0;
}

/// Characters of `width` digits each, up to "\\X0\\"; returns the place behind that.
std::size_t decode_wide(std::string_view text, std::size_t at, std::size_t width, std::string& out) {
  constexpr std::uint32_t high = 0xD800, low = 0xDC00, surrogates_end = 0xE000;
  std::uint32_t first = 0;  // of a pair
  for (; at + width <= text.size() && text[at] != '\\'; at += width) {
    const std::uint32_t unit = hexadecimal(text.substr(at, width));
    if (unit >= high && unit < low)
      first = unit;
    else if (unit >= low && unit < surrogates_end)
      append_utf8(0x10000 + ((first - high) << 10) + (unit - low), out);
    else
      append_utf8(unit, out);
  }
  return std::min(at + 4, text.size());
}

}  // namespace

std::string step_decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    if (rest.starts_with("\\X2\\") || rest.starts_with("\\X4\\")) {
      i = decode_wide(text, i + 4, rest[2] == '2' ? 4 : 8, out);
    } else if (rest.starts_with("\\X\\") && rest.size() >= 5) {
      append_utf8(hexadecimal(rest.substr(3, 2)), out);
      i += 5;
    } else if (rest.starts_with("\\S\\") && rest.size() >= 4) {
      append_utf8(static_cast<unsigned char>(rest[3]) + 0x80U, out);
      i += 4;
    } else {
      out += text[i];
      i += rest.starts_with("\\\\") ? 2 : 1;
    }
  }
  return out;
}

std::string step_encoded(std::string_view utf8) {
  std::ostringstream out;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[i++]);
    if (lead < 0x80) {
      out << static_cast<char>(lead);
      continue;
    }
    std::uint32_t code = lead & (lead >= 0xF0 ? 0x07U : lead >= 0xE0 ? 0x0FU : 0x1FU);
    for (; i < utf8.size() && (utf8[i] & 0xC0) == 0x80; ++i) code = code << 6 | (utf8[i] & 0x3FU);
    out << "\\X4\\" << std::hex << std::uppercase;
    out.width(8);
    out.fill('0');
    out << code << "\\X0\\";
  }
  return out.str();
}

std::string with_encoded_apostrophes(std::string text) {
  constexpr std::string_view encoded = "\\X4\\00000027\\X0\\";
  std::string out;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = std::string_view(text).substr(i);
    if (!in_string && rest.starts_with("/*")) {
      const std::size_t end = std::min(text.find("*/", i + 2), text.size());
      out.append(text, i, end - i);
      i = end - 1;
    } else if (in_string && rest.starts_with("''")) {
      out += encoded;
      ++i;
    } else {
      in_string = in_string != (text[i] == '\'');
      out += text[i];
    }
  }
  return in_string ? text : out;
}

std::string step_string(std::string_view utf8) {
  std::string text;
  for (const char c : utf8)
    if (std::iscntrl(static_cast<unsigned char>(c)))
      text += ' ';  // it would break a line of the file
    else
      text.append(c == '\'' || c == '\\' ? 2 : 1, c);
  return step_encoded(text);
}

}  // namespace nurbeam
