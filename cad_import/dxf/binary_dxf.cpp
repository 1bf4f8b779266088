#include "cad_import/dxf/binary_dxf.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace nurbeam {
namespace {

constexpr std::string_view first_bytes{"AutoCAD Binary DXF\r\n\x1A\0", 22};

enum class ValueKind { text, real, integer_16, integer_32, integer_64, boolean, chunk };

/// Group codes up to `last` that are above those of the range before it.
struct CodeRange {
  int last;
  ValueKind kind;
};

/// The kinds of values by group code (DXF reference, "Group code value types").
constexpr auto ranges = std::to_array<CodeRange>(
    {{9, ValueKind::text},          {59, ValueKind::real},        {79, ValueKind::integer_16},
     {99, ValueKind::integer_32},   {109, ValueKind::text},       {149, ValueKind::real},
     {159, ValueKind::text},        {169, ValueKind::integer_64}, {179, ValueKind::integer_16},
     {209, ValueKind::text},        {239, ValueKind::real},       {269, ValueKind::text},
     {289, ValueKind::integer_16},  {299, ValueKind::boolean},    {309, ValueKind::text},
     {319, ValueKind::chunk},       {369, ValueKind::text},       {389, ValueKind::integer_16},
     {399, ValueKind::text},        {409, ValueKind::integer_16}, {419, ValueKind::text},
     {429, ValueKind::integer_32},  {439, ValueKind::text},       {459, ValueKind::integer_32},
     {469, ValueKind::real},        {1003, ValueKind::text},      {1004, ValueKind::chunk},
     {1009, ValueKind::text},       {1059, ValueKind::real},      {1070, ValueKind::integer_16},
     {1071, ValueKind::integer_32}, {5009, ValueKind::text}});

class BinaryPairs {
 public:
  explicit BinaryPairs(std::string_view content) : content_(content), at_(first_bytes.size()) {
    // Before release 13 a group code has one byte: "0", "SECTION" begins with 0 'S', not with 0 0.
    short_codes_ = at_ + 1 < content_.size() && content_[at_ + 1] != '\0';
    text_.reserve(2 * content.size());
  }

  std::string text() && {
    for (std::string_view value; value != "EOF";) {
      const int code = group_code();
      append(code);
      text_ += '\n';
      const std::size_t begin = text_.size();
      append_value(kind_of(code));
      value = code == 0 ? std::string_view(text_).substr(begin) : std::string_view();
      if (value != "EOF") text_ += '\n';
    }
    return std::move(text_ += '\n');
  }

 private:
  template <class Number>
  Number number() {
    if (content_.size() - at_ < sizeof(Number)) fail_truncated();
    Number value;
    std::memcpy(&value, content_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

  [[noreturn]] static void fail_truncated() {
    throw std::runtime_error("the binary DXF file is truncated: it has no EOF; export or copy it again");
  }

  int group_code() {
    constexpr int code_of_two_bytes_follows = 255;
    if (!short_codes_) return number<std::int16_t>();
    const int code = number<std::uint8_t>();
    return code == code_of_two_bytes_follows ? number<std::int16_t>() : code;
  }

  ValueKind kind_of(int code) const {
    const auto range =
        std::find_if(ranges.begin(), ranges.end(), [code](const CodeRange& of) { return code <= of.last; });
    if (code >= 0 && range != ranges.end()) return range->kind;
    throw std::runtime_error("the binary DXF file has the group code " + std::to_string(code) + " at byte " +
                             std::to_string(at_) + "; DXF has 0 to 5009; export or copy it again");
  }

  template <class Number>
  void append(Number value) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    text_.append(digits, end);
  }

  /// Up to the byte 0. A line end, which would break the pair, becomes a blank.
  void append_text() {
    const std::size_t end = content_.find('\0', at_);
    if (end == std::string_view::npos) fail_truncated();
    const std::size_t begin = text_.size();
    text_ += content_.substr(at_, end - at_);
    std::replace_if(
        text_.begin() + static_cast<std::ptrdiff_t>(begin), text_.end(),
        [](char c) { return c == '\n' || c == '\r'; }, ' ');
    at_ = end + 1;
  }

  void append_chunk() {
    constexpr std::string_view digits = "0123456789ABCDEF";
    for (int left = number<std::uint8_t>(); left > 0; --left) {
      const auto byte = number<std::uint8_t>();
      text_ += digits[byte >> 4];
      text_ += digits[byte & 0xF];
    }
  }

  void append_value(ValueKind kind) {
    switch (kind) {
      case ValueKind::text:
        return append_text();
      case ValueKind::real:
        return append(number<double>());
      case ValueKind::integer_16:
        return append(number<std::int16_t>());
      case ValueKind::integer_32:
        return append(number<std::int32_t>());
      case ValueKind::integer_64:
        return append(number<std::int64_t>());
      case ValueKind::boolean:
        return append(static_cast<int>(number<std::uint8_t>()));
      case ValueKind::chunk:
        return append_chunk();
    }
  }

  std::string_view content_;
  std::size_t at_;
  bool short_codes_;
  std::string text_;
};

}  // namespace

bool is_binary_dxf(std::string_view content) { return content.starts_with(first_bytes); }

std::string text_of_binary_dxf(std::string_view content) { return BinaryPairs(content).text(); }

}  // namespace nurbeam
