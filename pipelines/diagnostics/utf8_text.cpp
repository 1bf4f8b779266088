#include "pipelines/diagnostics/utf8_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace nurbeam {

namespace {

// Else it goes on with the character of the byte before.
bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

struct CharacterRange {
  std::uint32_t first, last;
};

// Those of the Unicode standard's annex 11 that are wide or full, in blocks.
constexpr std::array<CharacterRange, 10> wide_characters{{{0x1100, 0x115F},
                                                          {0x2E80, 0x303E},
                                                          {0x3041, 0xA4CF},
                                                          {0xAC00, 0xD7A3},
                                                          {0xF900, 0xFAFF},
                                                          {0xFE30, 0xFE6F},
                                                          {0xFF01, 0xFF60},
                                                          {0xFFE0, 0xFFE6},
                                                          {0x1F300, 0x1FAFF},
                                                          {0x20000, 0x3FFFD}}};
constexpr std::array<CharacterRange, 3> standing_over{{{0x0300, 0x036F}, {0x200B, 0x200F}, {0xFE00, 0xFE0F}}};

template <std::size_t n>
bool is_among(const std::array<CharacterRange, n>& ranges, std::uint32_t character) {
  return std::any_of(
      ranges.begin(), ranges.end(),
      [=](const CharacterRange& range) { return range.first <= character && character <= range.last; });
}

std::size_t columns_of(std::uint32_t character) {
  if (is_among(standing_over, character)) return 0;
  return is_among(wide_characters, character) ? 2 : 1;
}

// The payload of the first byte of a character: seven bits, or those behind its leading ones and a zero.
std::uint32_t first_bits(char byte) {
  const auto bits = static_cast<unsigned char>(byte);
  if (bits < 0x80U) return bits;
  if (bits < 0xE0U) return bits & 0x1FU;
  return bits < 0xF0U ? bits & 0x0FU : bits & 0x07U;
}

}  // namespace

std::size_t column_count(std::string_view text) {
  std::size_t columns = 0;
  for (std::size_t i = 0; i < text.size();) {
    std::uint32_t character = first_bits(text[i]);
    for (++i; i < text.size() && !begins_character(text[i]); ++i)
      character = (character << 6U) | (static_cast<unsigned char>(text[i]) & 0x3FU);
    columns += columns_of(character);
  }
  return columns;
}

std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

std::string first_characters(std::string_view text, std::size_t most) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (begins_character(text[i]) && ++characters > most) return std::string(text.substr(0, i)) + "...";
  return std::string(text);
}

}  // namespace nurbeam
