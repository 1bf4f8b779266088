#include "cad_import/cad_format.h"

#include <string_view>

namespace nurbeam {
namespace {

constexpr std::size_t kSectionColumn = 72;  // column 73, counted from 0

std::string_view without_leading_space(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

bool has_iges_section(std::string_view line, char section) {
  return line.size() > kSectionColumn && line[kSectionColumn] == section;
}

std::string_view first_line(std::string_view text) { return text.substr(0, text.find_first_of("\r\n")); }

bool has_terminate_line(std::string_view text) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::string_view line = first_line(text.substr(begin));
    if (has_iges_section(line, 'T')) return true;
    begin += line.size() + 1;
  }
  return false;
}

}  // namespace

std::optional<CadFormat> format_of(const std::string& content) {
  if (without_leading_space(content).starts_with("ISO-10303-21")) return CadFormat::step;
  if (has_iges_section(first_line(content), 'S')) return CadFormat::iges;
  return std::nullopt;
}

std::string incompleteness(const std::string& content, CadFormat format) {
  if (format == CadFormat::step && content.find("END-ISO-10303-21") == std::string::npos) {
    return "the STEP file is truncated: it has no END-ISO-10303-21; export or copy it again";
  }
  if (format == CadFormat::iges && !has_terminate_line(content)) {
    return "the IGES file is truncated: no line has a 'T' (Terminate section) in column 73; export or copy "
           "it again";
  }
  return "";
}

}  // namespace nurbeam
