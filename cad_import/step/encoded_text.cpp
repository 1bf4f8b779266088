#include "cad_import/step/encoded_text.h"

#include <cctype>
#include <cstdint>
#include <sstream>

namespace nurbeam {

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
