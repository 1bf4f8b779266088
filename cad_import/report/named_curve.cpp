#include "cad_import/report/named_curve.h"

#include <string_view>

namespace nurbeam {
namespace {

constexpr std::string_view hexadecimal = "0123456789abcdefABCDEF";

}  // namespace

bool is_colour(const std::string& text) {
  constexpr std::size_t length = 7;
  return text.size() == length && text[0] == '#' &&
         text.find_first_not_of(hexadecimal, 1) == std::string::npos;
}

std::array<int, 3> parts_of_colour(const std::string& colour) {
  constexpr int base = 16;
  const auto part = [&](std::size_t at) { return std::stoi(colour.substr(at, 2), nullptr, base); };
  return {part(1), part(3), part(5)};
}

int level_number(const std::string& layer) {
  constexpr std::size_t most_digits = 8;
  const bool is_number = !layer.empty() && layer.size() <= most_digits &&
                         layer.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? std::stoi(layer) : 0;
}

}  // namespace nurbeam
