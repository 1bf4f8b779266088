#include "cad_import/dxf/dxf_entities.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace nurbeam {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

double number_in(const DxfPair& pair) {
  const std::string text(pair.value);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  constexpr double largest = 1e15;  // lengths of what is drawn far beyond that take for ever
  if (text.empty() || *end != '\0' || !(std::abs(value) <= largest))
    throw std::runtime_error("group " + std::to_string(pair.code) + " is '" + text +
                             "'; it must be a number from -1e15 to 1e15");
  return value;
}

/// A letter of the Basic Multilingual Plane.
void append_utf8(unsigned code, std::string& text) {
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
}

/// With the letters that drawings before 2007 write as U+00FC behind a backslash.
std::string decoded(std::string_view value) {
  constexpr std::string_view mark = "\\U+";
  constexpr std::size_t digits = 4;
  std::string text;
  while (!value.empty()) {
    unsigned code = 0;
    const char* const first = value.data() + mark.size();
    const bool is_letter = value.starts_with(mark) && value.size() >= mark.size() + digits &&
                           std::from_chars(first, first + digits, code, 16).ptr == first + digits;
    if (is_letter)
      append_utf8(code, text);
    else
      text += value[0];
    value.remove_prefix(is_letter ? mark.size() + digits : 1);
  }
  return text;
}

std::vector<DxfPair> pairs_of(std::string_view content) {
  std::vector<DxfPair> pairs;
  int line = 0;
  const auto next_line = [&] {
    const std::size_t end = std::min(content.find('\n'), content.size());
    const std::string_view text = trimmed(content.substr(0, end));
    content.remove_prefix(std::min(end + 1, content.size()));
    ++line;
    return text;
  };
  while (!content.empty()) {
    const std::string code(next_line());
    if (code.empty() && trimmed(content).empty()) break;
    char* end = nullptr;
    const long value = std::strtol(code.c_str(), &end, 10);
    if (code.empty() || *end != '\0' || value < -10 || value > 10000)
      throw std::runtime_error("line " + std::to_string(line) + " is '" + code.substr(0, 40) +
                               "'; a DXF file has a group code there; export or copy it again");
    pairs.push_back({static_cast<int>(value), next_line()});
  }
  return pairs;
}

}  // namespace

double DxfEntity::number_of(int code, double otherwise) const {
  const auto at = std::find_if(pairs.begin(), pairs.end(), [&](const DxfPair& p) { return p.code == code; });
  return at == pairs.end() ? otherwise : number_in(*at);
}

std::string DxfEntity::text_of(int code) const {
  const auto at = std::find_if(pairs.begin(), pairs.end(), [&](const DxfPair& p) { return p.code == code; });
  return at == pairs.end() ? "" : decoded(at->value);
}

std::vector<double> DxfEntity::numbers_of(int code) const {
  std::vector<double> values;
  for (const DxfPair& pair : pairs)
    if (pair.code == code) values.push_back(number_in(pair));
  return values;
}

DxfDrawing dxf_drawing(std::string_view content) {
  DxfDrawing drawing;
  std::string_view section, variable;
  bool names_section = false, in_block = false;
  DxfEntity* open = nullptr;  // whose pairs follow
  const auto begin = [&](std::string_view type, std::vector<DxfEntity>& list) {
    open = &list.emplace_back(DxfEntity{std::string(type), static_cast<int>(list.size()) + 1, {}});
  };
  const auto begin_in_blocks = [&](std::string_view type) {
    if (type == "BLOCK") {
      open = &drawing.blocks.emplace_back(DxfBlock{{std::string(type), 0, {}}, {}}).head;
      in_block = true;
    } else if (type == "ENDBLK") {
      in_block = false;
    } else if (in_block) {
      begin(type, drawing.blocks.back().entities);
    }
  };
  for (const DxfPair& pair : pairs_of(content)) {
    if (pair.code == 0) {
      open = nullptr;
      names_section = pair.value == "SECTION";
      if (names_section || pair.value == "ENDSEC") section = {};
      if (section == "TABLES" && pair.value == "LAYER") begin(pair.value, drawing.layers);
      if (section == "BLOCKS") begin_in_blocks(pair.value);
      if (section == "ENTITIES") begin(pair.value, drawing.entities);
    } else if (names_section && pair.code == 2) {
      section = pair.value;
      names_section = false;
    } else if (section == "HEADER") {
      if (pair.code == 9) variable = pair.value;
      if (pair.code == 70 && variable == "$INSUNITS") drawing.unit = static_cast<int>(number_in(pair));
    } else if (open) {
      open->pairs.push_back(pair);
    }
  }
  return drawing;
}

}  // namespace nurbeam
