#include "cad_import/step/broken_instances.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

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

/// The statement that begins at a place of the text, with its ';'.
std::string_view statement_at(std::string_view text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && text[end] != ';') {
    const std::size_t behind = behind_quotation(text, end);
    end = behind > end ? behind : end + 1;
  }
  return text.substr(begin, std::min(end + 1, text.size()) - begin);
}

/// "#62 = CARTESIAN_POINT(...)" of such a statement; "" of any other.
std::string_view instance_in(std::string_view statement) {
  const std::size_t start = statement.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || statement[start] != '#' || !statement.ends_with(';')) return {};
  return statement.substr(start, statement.size() - start - 1);
}

/// Takes the instances out of the text for which `is_one`.
template <class IsOne>
void remove_instances(std::string& text, const IsOne& is_one) {
  const std::string given = std::move(text);
  text.clear();
  for (std::size_t begin = 0; begin < given.size();) {
    const std::string_view statement = statement_at(given, begin), instance = instance_in(statement);
    begin += statement.size();
    if (instance.empty() || !is_one(instance)) text += statement;
  }
}

/// The number of an instance; -1 where it has none.
int number_of(std::string_view instance) {
  if (instance.empty()) return -1;
  const std::size_t first = std::min(instance.find_first_not_of(" \t\r\n", 1), instance.size());
  int number = -1;
  std::from_chars(instance.data() + first, instance.data() + instance.size(), number);
  return number;
}

bool has_repeated_numbers(std::string_view text) {
  std::vector<int> numbers;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::string_view statement = statement_at(text, begin), instance = instance_in(statement);
    begin += statement.size();
    if (const int number = number_of(instance); number >= 0) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return std::adjacent_find(numbers.begin(), numbers.end()) != numbers.end();
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
  remove_instances(text, [&](std::string_view instance) {
    const auto token = broken_token(instance, wanted);
    if (token) broken.push_back({label_of(instance), *token});
    return token.has_value();
  });
  return broken;
}

std::vector<std::string> remove_repeated_instances(std::string& text) {
  std::vector<std::string> repeated;
  if (!has_repeated_numbers(text)) return repeated;
  std::set<int> known;
  remove_instances(text, [&](std::string_view instance) {
    const int number = number_of(instance);
    const bool is_known = number >= 0 && !known.insert(number).second;
    if (is_known) repeated.push_back(label_of(instance));
    return is_known;
  });
  return repeated;
}

}  // namespace nurbeam
