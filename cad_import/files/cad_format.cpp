#include "cad_import/files/cad_format.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace nurbeam {
namespace {

constexpr std::size_t section_column = 72;  // column 73, counted from 0
constexpr std::size_t count_width = 7;

std::string_view without_leading_space(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

bool begins_as_step(std::string_view text) {
  constexpr std::string_view keyword = "ISO-10303-21";
  const std::string_view begin = without_leading_space(text).substr(0, keyword.size());
  return std::equal(begin.begin(), begin.end(), keyword.begin(), keyword.end(),
                    [](unsigned char c, char wanted) { return std::toupper(c) == wanted; });
}

/// Whether a STEP text is one of IFC: by its schema, or else by its first instance.
bool is_ifc(std::string_view text) {
  constexpr std::size_t longest_header = 1 << 16;
  std::string header(text.substr(0, longest_header));
  std::transform(
      header.begin(), header.end(), header.begin(),
      [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const auto is_at = [&](std::size_t at) { return at < header.size() && header.compare(at, 3, "IFC") == 0; };
  const std::size_t schema = header.find("FILE_SCHEMA"), name = header.find('\'', schema);
  if (schema != std::string::npos && name != std::string::npos && is_at(name + 1)) return true;
  const std::size_t equals = header.find('=', std::min(header.find("ENDSEC"), header.size()));
  return equals != std::string::npos && is_at(header.find_first_not_of(" \t\r\n", equals + 1));
}

std::string_view without_trailing_space(std::string_view text) {
  return text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
}

bool has_iges_section(std::string_view line, char section) {
  return line.size() > section_column && line[section_column] == section;
}

std::string_view first_line(std::string_view text) { return text.substr(0, text.find_first_of("\r\n")); }

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    lines.push_back(first_line(text.substr(begin)));
    begin += lines.back().size() + 1;
  }
  return lines;
}

std::string_view terminate_line(const std::vector<std::string_view>& lines) {
  const auto line = std::find_if(lines.begin(), lines.end(), [](auto l) { return has_iges_section(l, 'T'); });
  return line == lines.end() ? std::string_view() : *line;
}

// Its pairs of lines: comments, and then the first section.
bool begins_as_dxf(std::string_view text) {
  const auto next_line = [&] {
    const std::string_view line =
        without_trailing_space(without_leading_space(text.substr(0, text.find('\n'))));
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    return line;
  };
  while (!text.empty()) {
    const std::string_view code = next_line();
    if (text.empty()) return false;
    const std::string_view value = next_line();
    if (code != "999") return code == "0" && value == "SECTION";
  }
  return false;
}

// The number after the letter in "S0000001G0000004D0000016P0000020"; nothing if there is none.
std::optional<long> declared_count(std::string_view terminate, char section) {
  const std::size_t at = terminate.substr(0, section_column).find(section);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string digits(terminate.substr(at + 1, count_width));
  char* end = nullptr;
  const long count = std::strtol(digits.c_str(), &end, 10);
  return end == digits.c_str() ? std::nullopt : std::optional(count);
}

}  // namespace

std::optional<CadFormat> format_of(const std::string& content) {
  if (begins_as_step(content)) return is_ifc(content) ? CadFormat::ifc : CadFormat::step;
  if (has_iges_section(first_line(content), 'S')) return CadFormat::iges;
  if (begins_as_dxf(content)) return CadFormat::dxf;
  if (const std::string_view text = without_leading_space(content);
      text.starts_with("DBRep_DrawableShape") || text.starts_with("CASCADE Topology V"))
    return CadFormat::brep;
  if (without_leading_space(content).starts_with('{')) return CadFormat::json;
  return std::nullopt;
}

std::optional<std::string> incompleteness(const std::string& content, CadFormat format) {
  if (const bool is_step_text = format == CadFormat::step || format == CadFormat::ifc;
      is_step_text && content.find("END-ISO-10303-21") == std::string::npos)
    return "the STEP file is truncated: it has no END-ISO-10303-21; export or copy it again";
  if (format == CadFormat::brep && content.find("\nTShapes ") == std::string::npos)
    return "the BREP file is truncated: it has no section TShapes; export or copy it again";
  if (format == CadFormat::iges && terminate_line(lines_of(content)).empty()) {
    return "the IGES file is truncated: no line has a 'T' (Terminate section) in column 73; export or copy "
           "it again";
  }
  return std::nullopt;
}

std::optional<std::string> miscounted_lines(const std::string& content) {
  const std::vector<std::string_view> lines = lines_of(content);
  const std::string_view terminate = terminate_line(lines);
  for (const char section : {'S', 'G', 'D', 'P'}) {
    const std::optional<long> declared = declared_count(terminate, section);
    const auto found =
        std::count_if(lines.begin(), lines.end(), [=](auto l) { return has_iges_section(l, section); });
    if (!declared || *declared == found) continue;
    return "section " + std::string(1, section) + " has " + std::to_string(found) +
           " lines, the Terminate section says " + std::to_string(*declared) +
           "; curves may be missing or wrong; export or copy it again";
  }
  return std::nullopt;
}

}  // namespace nurbeam
