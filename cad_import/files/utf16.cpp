#include "cad_import/files/utf16.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace nurbeam {
namespace {

enum class Order { none, little, big };

Order order_of(std::string_view text) {
  if (text.size() < 4) return Order::none;
  if (text.starts_with("\xFF\xFE")) return Order::little;
  if (text.starts_with("\xFE\xFF")) return Order::big;
  const auto is_pair = [&](std::size_t letter, std::size_t zero) {
    return text[zero] == 0 && text[zero + 2] == 0 && text[letter] > 0 && text[letter + 2] > 0;
  };
  if (is_pair(0, 1)) return Order::little;
  return is_pair(1, 0) ? Order::big : Order::none;
}

}  // namespace

void append_utf8(std::uint32_t point, std::string& out) {
  const auto tail = [&](int shift) { out += static_cast<char>(0x80 | ((point >> shift) & 0x3F)); };
  if (point < 0x80) {
    out += static_cast<char>(point);
  } else if (point < 0x800) {
    out += static_cast<char>(0xC0 | (point >> 6));
    tail(0);
  } else if (point < 0x10000) {
    out += static_cast<char>(0xE0 | (point >> 12));
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xF0 | (point >> 18));
    for (const int shift : {12, 6, 0}) tail(shift);
  }
}

std::string without_utf16(std::string text) {
  const Order order = order_of(text);
  if (order == Order::none) return text;
  const auto unit_at = [&](std::size_t i) {
    const auto first = static_cast<unsigned char>(text[i]), second = static_cast<unsigned char>(text[i + 1]);
    return static_cast<std::uint32_t>(order == Order::little ? first | second << 8 : first << 8 | second);
  };
  constexpr std::uint32_t mark = 0xFEFF, high = 0xD800, low = 0xDC00, surrogates_end = 0xE000;
  std::string out;
  for (std::size_t i = unit_at(0) == mark ? 2 : 0; i + 1 < text.size(); i += 2) {
    std::uint32_t point = unit_at(i);
    if (point >= high && point < low && i + 3 < text.size()) {
      const std::uint32_t next = unit_at(i + 2);
      if (next >= low && next < surrogates_end) {
        point = 0x10000 + ((point - high) << 10) + (next - low);
        i += 2;
      }
    }
    append_utf8(point, out);
  }
  return out;
}

}  // namespace nurbeam
