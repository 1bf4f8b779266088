#include "cad_import/step/broken_instances.h"

#include <cctype>
#include <cstddef>
#include <optional>
#include <string_view>

namespace nurbeam {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The place behind the string or comment that begins at `at`; `at` itself where none does.
std::size_t behind_quotation(std::string_view text, std::size_t at) {
  const auto behind = [&](std::string_view mark, std::size_t from) {
    const std::size_t found = text.find(mark, from);
    return found == std::string_view::npos ? text.size() : found + mark.size();
  };
  if (text[at] == '\'' || text[at] == '"') return behind(text.substr(at, 1), at + 1);
  return text.substr(at, 2) == "/*" ? behind("*/", at + 2) : at;
}

std::size_t behind_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// [+-] digits [. [digits] [E [+-] digits]]; the digits before the point may be missing, as some write it.
bool is_number(std::string_view token) {
  std::size_t at = token.starts_with('+') || token.starts_with('-') ? 1 : 0;
  const std::size_t whole = behind_digits(token, at);
  if (whole == token.size()) return whole > at;
  if (token[whole] != '.') return false;
  if (whole == at && behind_digits(token, whole + 1) == whole + 1) return false;
  at = behind_digits(token, whole + 1);
  if (at == token.size()) return true;
  if (token[at] != 'E') return false;
  ++at;
  if (at < token.size() && (token[at] == '+' || token[at] == '-')) ++at;
  return at < token.size() && behind_digits(token, at) == token.size();
}

bool is_enumeration(std::string_view token) {
  return token.size() > 2 && token.front() == '.' && token.back() == '.';
}

bool is_reference(std::string_view token) {
  return token.size() > 1 && token[0] == '#' && behind_digits(token, 1) == token.size();
}

/// Whether the token, before the character `next`, may stand in an instance.
bool is_allowed(std::string_view token, char next) {
  const bool is_keyword = std::isalpha(static_cast<unsigned char>(token[0])) != 0 || token[0] == '!';
  return token == "*" || token == "$" || is_number(token) || is_reference(token) || is_enumeration(token) ||
         (is_keyword && next == '(');
}

bool has_two_points(std::string_view token) {
  const std::size_t first = token.find('.');
  return token.find_first_not_of("+-.0123456789E") == std::string_view::npos &&
         first != std::string_view::npos && token.find('.', first + 1) != std::string_view::npos;
}

/// The first token that must not be there; nothing where all may.
std::optional<std::string> broken_token(std::string_view value, BrokenToken wanted) {
  for (std::size_t at = 0; at < value.size();) {
    const std::size_t behind = behind_quotation(value, at);
    if (behind > at || std::string_view("(), \t\r\n=").find(value[at]) != std::string_view::npos) {
      at = behind > at ? behind : at + 1;
      continue;
    }
    std::size_t end = at;
    while (end < value.size() &&
           (is_word(value[end]) || std::string_view("+-.#*$!").find(value[end]) != std::string_view::npos))
      ++end;
    if (end == at && wanted == BrokenToken::any) return std::string(1, value[at]);
    if (end == at) ++end;
    const std::size_t next = value.find_first_not_of(" \t\r\n", end);
    const std::string_view token = value.substr(at, end - at);
    const bool is_wanted = wanted == BrokenToken::any || has_two_points(token);
    if (is_wanted && !is_allowed(token, next == std::string_view::npos ? ' ' : value[next]))
      return std::string(token);
    at = end;
  }
  return std::nullopt;
}

std::string label_of(std::string_view instance) {
  std::string label;
  for (const char c : instance) {
    if (c == '(') break;
    if (c == '=')
      label += ' ';
    else if (std::isspace(static_cast<unsigned char>(c)) == 0)
      label += c;
  }
  return label;
}

}  // namespace

bool may_have_broken_numbers(const std::string& text) {
  for (std::size_t at = text.find('.'); at != std::string::npos;) {
    const std::size_t next = text.find('.', at + 1);
    if (next == std::string::npos) return false;
    if (text.find_first_not_of("0123456789", at + 1) == next) return true;
    at = next;
  }
  return false;
}

std::vector<BrokenInstance> remove_broken_instances(std::string& text, BrokenToken wanted) {
  std::vector<BrokenInstance> broken;
  const std::string given = std::move(text);
  const std::string_view all = given;
  text.clear();
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = begin;
    while (end < all.size() && all[end] != ';') {
      const std::size_t behind = behind_quotation(all, end);
      end = behind > end ? behind : end + 1;
    }
    end = std::min(end + 1, all.size());
    std::string_view statement = all.substr(begin, end - begin);
    begin = end;
    const std::size_t start = statement.find_first_not_of(" \t\r\n");
    const bool is_instance =
        start != std::string_view::npos && statement[start] == '#' && statement.ends_with(';');
    const std::string_view instance =
        is_instance ? statement.substr(start, statement.size() - start - 1) : "";
    if (const auto token = broken_token(instance, wanted))
      broken.push_back({label_of(instance), *token});
    else
      text += statement;
  }
  return broken;
}

}  // namespace nurbeam
