#include "cad_import/files/drawing_letters.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "cad_import/files/code_page.h"
#include "cad_import/files/tolerant_text.h"

namespace nurbeam {
namespace {

bool is_beyond_ascii(char c) { return static_cast<unsigned char>(c) >= 0x80; }

/// The value of a variable of the header: what stands two lines below its name; "" without it.
std::string variable(std::string_view content, std::string_view name) {
  std::size_t at = content.substr(0, content.find("ENDSEC")).find(name);
  for (int line = 0; line < 2 && at != std::string_view::npos; ++line) {
    at = content.find('\n', at);
    if (at != std::string_view::npos) ++at;
  }
  if (at == std::string_view::npos) return "";
  std::string_view line = content.substr(at, content.find_first_of("\r\n", at) - at);
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return std::string(line.substr(0, line.find_last_not_of(" \t") + 1));
}

bool has_letters_of_three_bytes(std::string_view text) {
  return std::any_of(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0xE0; });
}

}  // namespace

std::string drawing_in_utf8(std::string content) {
  if (std::none_of(content.begin(), content.end(), is_beyond_ascii)) return content;
  const std::string page = variable(content, "$DWGCODEPAGE"), version = variable(content, "$ACADVER");
  const bool before_2007 = version < "AC1021";
  const bool may_be_both =
      before_2007 && has_letters_of_two_bytes(page) && !has_letters_of_three_bytes(content);
  if (is_utf8(content) && !may_be_both) return content;
  return from_code_page(content, page);
}

}  // namespace nurbeam
