#include "cad_import/files/real_text.h"

namespace nurbeam {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }

std::size_t after_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

std::size_t after_sign(std::string_view text, std::size_t at) {
  return at < text.size() && (text[at] == '+' || text[at] == '-') ? at + 1 : at;
}

/// The place after the exponent that begins at `at`; `at` itself where none does.
std::size_t after_exponent(std::string_view text, std::size_t at) {
  if (at >= text.size() || (text[at] != 'E' && text[at] != 'e')) return at;
  const std::size_t digits = after_sign(text, at + 1), end = after_digits(text, digits);
  return end > digits ? end : at;
}

bool may_begin(std::string_view text, std::size_t at) {
  if (!is_digit(text[at]) && text[at] != '+' && text[at] != '-' && text[at] != '.') return false;
  const char before = at > 0 ? text[at - 1] : ' ';
  return !is_digit(before) && !is_letter(before) && before != '#' && before != '.' && before != '@';
}

}  // namespace

NumberText number_text(std::string_view text, std::size_t at, bool is_real) {
  if (!may_begin(text, at)) return {};
  const std::size_t whole = after_sign(text, at), point = after_digits(text, whole);
  const bool has_point = point < text.size() && text[point] == '.';
  const std::size_t end_of_digits = has_point ? after_digits(text, point + 1) : point;
  if (end_of_digits - whole == (has_point ? 1 : 0)) return {};
  const std::size_t end = after_exponent(text, end_of_digits);
  if (end < text.size() && is_letter(text[end])) return {};
  std::string number(text.substr(at, end_of_digits - at));
  if (!has_point && (is_real || end > end_of_digits)) number += '.';
  if (end > end_of_digits) (number += 'E') += text.substr(end_of_digits + 1, end - end_of_digits - 1);
  return {end - at, number};
}

bool opens_typed_real(std::string_view text) {
  return text.ends_with("_MEASURE(") || text.ends_with("PARAMETER_VALUE(");
}

}  // namespace nurbeam
