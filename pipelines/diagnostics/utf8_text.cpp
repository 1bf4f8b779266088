#include "pipelines/diagnostics/utf8_text.h"

#include <algorithm>

namespace nurbeam {

namespace {

// Else it goes on with the character of the byte before.
bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

}  // namespace

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
