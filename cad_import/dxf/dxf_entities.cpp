#include "cad_import/dxf/dxf_entities.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "cad_import/dxf/encoded_letters.h"

namespace nurbeam {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

/// The whole of the text as a number.
template <class Number>
std::optional<Number> number_in(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The pairs of a content, line by line.
class PairLines {
 public:
  explicit PairLines(std::string_view content) : rest_(content) {}

  /// The pairs up to the one of EOF.
  std::vector<DxfPair> all() {
    std::vector<DxfPair> pairs;
    while (!rest_.empty()) {
      const std::string_view code = next_line();
      if (code.empty() && trimmed(rest_).empty()) break;
      pairs.push_back({group_code(code), {}});
      pairs.back().value = next_line();
      if (pairs.back().code == 0 && pairs.back().value == "EOF") return pairs;
    }
    throw std::runtime_error("the DXF file is truncated: it has no EOF; export or copy it again");
  }
  /// Blanks and the mark of the end of files of DOS are nothing.
  std::size_t bytes_behind() const {
    return rest_.find_first_not_of(" \t\r\n\x1A") == std::string_view::npos ? 0 : rest_.size();
  }

 private:
  std::string_view next_line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view text = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    return text;
  }
  int group_code(std::string_view text) const {
    const std::optional<int> code = number_in<int>(text);
    if (code && *code >= -10 && *code <= 10000) return *code;
    throw std::runtime_error("line " + std::to_string(line_) + " is '" + std::string(text.substr(0, 40)) +
                             "'; a DXF file has a group code there; export or copy it again");
  }

  std::string_view rest_;
  int line_ = 0;
};

/// What stands from each pair of code 0 to the next, given to `take` one after another.
template <class Take>
void for_each_entity(std::span<const DxfPair> pairs, const Take& take) {
  const auto is_first = [](const DxfPair& pair) { return pair.code == 0; };
  for (auto at = std::find_if(pairs.begin(), pairs.end(), is_first); at != pairs.end();) {
    const auto next = std::find_if(at + 1, pairs.end(), is_first);
    take(DxfEntity{at->value, 0, {at + 1, next}});
    at = next;
  }
}

void read_header(std::span<const DxfPair> pairs, DxfDrawing& drawing) {
  std::string_view variable;
  for (const DxfPair& pair : pairs) {
    if (pair.code == 9) variable = pair.value;
    if (pair.code == 70 && variable == "$INSUNITS") drawing.unit = pair.whole_number();
    if (pair.code == 70 && variable == "$MEASUREMENT") drawing.measurement = pair.whole_number();
    if (pair.code == 3 && variable == "$DWGCODEPAGE") drawing.code_page = pair.value;
  }
}

const DxfPair* first_of(std::span<const DxfPair> pairs, int code) {
  const auto at = std::find_if(pairs.begin(), pairs.end(), [&](const DxfPair& p) { return p.code == code; });
  return at == pairs.end() ? nullptr : &*at;
}

bool is_known_section(std::string_view name) {
  constexpr std::array<std::string_view, 8> known{"HEADER",   "CLASSES",        "TABLES",  "BLOCKS",
                                                  "ENTITIES", "THUMBNAILIMAGE", "OBJECTS", "ACDSDATA"};
  return std::find(known.begin(), known.end(), name) != known.end();
}

/// Its name. A section in another one, and values before the first entity, are strays.
std::string_view begun_section(const DxfEntity& entity, std::string_view open,
                               std::vector<std::string>& strays) {
  const DxfPair* const found = first_of(entity.pairs, 2);
  const std::string_view name = found ? found->value : std::string_view();
  constexpr int comment = 999;
  const auto values = std::count_if(entity.pairs.begin(), entity.pairs.end(),
                                    [](const DxfPair& pair) { return pair.code != comment; });
  if (!open.empty()) strays.push_back("SECTION in section " + std::string(open));
  if (values > 1 && (name == "ENTITIES" || name == "BLOCKS"))
    strays.push_back("values before the first entity of section " + std::string(name));
  return name;
}

void append(DxfEntity entity, std::vector<DxfEntity>& list) {
  entity.number = static_cast<int>(list.size()) + 1;
  list.push_back(entity);
}

}  // namespace

double DxfPair::number() const {
  const std::optional<double> number = number_in<double>(value);
  constexpr double largest = 1e15;  // lengths of what is drawn far beyond that take for ever
  if (!number || !(std::abs(*number) <= largest))
    throw std::runtime_error("group " + std::to_string(code) + " is '" + std::string(value) +
                             "'; it must be a number from -1e15 to 1e15");
  return *number;
}

int DxfPair::whole_number() const {
  constexpr double largest = 1e9;
  const double exactly = number();
  if (!(std::abs(exactly) <= largest))
    throw std::runtime_error("group " + std::to_string(code) + " is '" + std::string(value) +
                             "'; it must be a number from -1e9 to 1e9");
  return static_cast<int>(exactly);
}

double DxfEntity::number_of(int code, double otherwise) const {
  const DxfPair* const pair = first_of(pairs, code);
  return pair ? pair->number() : otherwise;
}

int DxfEntity::whole_number_of(int code, int otherwise) const {
  const DxfPair* const pair = first_of(pairs, code);
  return pair ? pair->whole_number() : otherwise;
}

std::string DxfEntity::text_of(int code) const {
  const DxfPair* const pair = first_of(pairs, code);
  return pair ? decoded_letters(pair->value) : "";
}

std::vector<double> DxfEntity::numbers_of(int code) const {
  std::vector<double> values;
  for (const DxfPair& pair : pairs)
    if (pair.code == code) values.push_back(pair.number());
  return values;
}

DxfEntity DxfEntity::part_of_class(std::string_view name) const {
  constexpr int marker = 100;
  const auto begin = std::find_if(pairs.begin(), pairs.end(), [&](const DxfPair& pair) {
    return pair.code == marker && pair.value == name;
  });
  if (begin == pairs.end()) return *this;
  const auto end =
      std::find_if(begin + 1, pairs.end(), [](const DxfPair& pair) { return pair.code == marker; });
  return {type, number, {begin + 1, end}};
}

DxfDrawing dxf_drawing(std::string_view content) {
  DxfDrawing drawing;
  PairLines lines(content);
  drawing.pairs = lines.all();
  drawing.bytes_behind = lines.bytes_behind();
  std::string_view section;
  bool in_block = false;
  const auto add_to_blocks = [&](const DxfEntity& entity) {
    if (entity.type == "BLOCK") drawing.blocks.push_back({entity, {}});
    if (!in_block && entity.type != "BLOCK")
      drawing.strays.push_back(std::string(entity.type) + " outside of blocks");
    in_block = entity.type == "BLOCK" || (in_block && entity.type != "ENDBLK");
    if (in_block && entity.type != "BLOCK") append(entity, drawing.blocks.back().entities);
  };
  for_each_entity(drawing.pairs, [&](const DxfEntity& entity) {
    if (entity.type == "SECTION") {
      section = begun_section(entity, section, drawing.strays);
      if (section == "HEADER") read_header(entity.pairs, drawing);
    } else if (entity.type == "ENDSEC") {
      section = {};
    } else if (section == "TABLES" && entity.type == "LAYER") {
      append(entity, drawing.layers);
    } else if (section == "BLOCKS") {
      add_to_blocks(entity);
    } else if (section == "ENTITIES" && entity.type != "EOF") {
      append(entity, drawing.entities);
    } else if (!is_known_section(section) && entity.type != "EOF") {
      drawing.strays.push_back(std::string(entity.type) + (section.empty()
                                                               ? " outside of sections"
                                                               : " in section " + std::string(section)));
    }
  });
  return drawing;
}

}  // namespace nurbeam
