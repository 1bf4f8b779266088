#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace nurbeam {
namespace {

using Random = std::mt19937_64;

/// A piece [begin, end) of a text.
struct Piece {
  std::size_t begin, end;
};

// Not std::uniform_int_distribution, whose numbers differ between standard libraries.
std::size_t below(std::size_t count, Random& random) { return count == 0 ? 0 : random() % count; }

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_in_number(char c) { return is_digit(c) || c == '.' || c == '+' || c == '-' || c == 'E' || c == 'D'; }

template <class Predicate>
Piece run_around(const std::string& text, std::size_t at, Predicate belongs) {
  Piece piece{at, at};
  while (piece.begin > 0 && belongs(text[piece.begin - 1])) --piece.begin;
  while (piece.end < text.size() && belongs(text[piece.end])) ++piece.end;
  return piece;
}

// The first character from a random place on for which `is_wanted`; the size of the text if there is none.
template <class Predicate>
std::size_t random_place(const std::string& text, Predicate is_wanted, Random& random) {
  const auto from = text.begin() + static_cast<std::ptrdiff_t>(below(text.size(), random));
  return static_cast<std::size_t>(std::find_if(from, text.end(), is_wanted) - text.begin());
}

Piece random_line(const std::string& text, Random& random) {
  const std::size_t at = below(text.size(), random);
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t after = text.find('\n', at);
  return {before == std::string::npos ? 0 : before + 1, after == std::string::npos ? text.size() : after + 1};
}

std::string cut_out(const std::string& text, Piece piece) {
  return text.substr(piece.begin, piece.end - piece.begin);
}

void replace(std::string& text, Piece piece, std::string_view by) {
  text.replace(piece.begin, piece.end - piece.begin, by);
}

// ---- the changes ----

void flip_bytes(std::string& text, Random& random) {
  const std::size_t count = 1 + below(8, random);
  for (std::size_t i = 0; i < count && !text.empty(); ++i)
    text[below(text.size(), random)] = static_cast<char>(random() % 256);
}

void flip_bit(std::string& text, Random& random) {
  if (text.empty()) return;
  char& c = text[below(text.size(), random)];
  c = static_cast<char>(static_cast<unsigned char>(c) ^ (1U << random() % 8));
}

void change_digit(std::string& text, Random& random) {
  const std::size_t at = random_place(text, is_digit, random);
  if (at < text.size()) text[at] = static_cast<char>('0' + random() % 10);
}

// Padded to the old width where it fits, so that the columns of an IGES file stay.
void change_number(std::string& text, Random& random) {
  constexpr std::array<std::string_view, 24> odd_numbers{
      "0",        "-1",  "1",       "2",          "-0.",         "1.E308",     "-1.E308",   "1.E-320",
      "NAN",      "INF", "1.E9999", "2147483647", "-2147483648", "4294967296", "65536",     "1000000",
      "99999999", "3",   "25",      "26",         "100",         "0.5",        "1.0000001", ""};
  const std::size_t at = random_place(text, is_digit, random);
  if (at == text.size()) return;
  const Piece old = run_around(text, at, is_in_number);
  std::string number(odd_numbers[below(odd_numbers.size(), random)]);
  if (random() % 2 == 0 && number.size() < old.end - old.begin) number.resize(old.end - old.begin, ' ');
  replace(text, old, number);
}

// One number stands in place of another: references of STEP and pointers of IGES that lead elsewhere.
void copy_number(std::string& text, Random& random) {
  const std::size_t from = random_place(text, is_digit, random), to = random_place(text, is_digit, random);
  if (from == text.size() || to == text.size()) return;
  std::string number = cut_out(text, run_around(text, from, is_digit));
  const Piece old = run_around(text, to, is_digit);
  if (number.size() < old.end - old.begin) number.insert(0, old.end - old.begin - number.size(), ' ');
  replace(text, old, number);
}

void redirect_reference(std::string& text, Random& random) {
  const auto is_hash = [](char c) { return c == '#'; };
  const std::size_t from = random_place(text, is_hash, random), to = random_place(text, is_hash, random);
  if (from == text.size() || to == text.size()) return;
  const std::string reference = cut_out(text, run_around(text, std::min(from + 1, text.size()), is_digit));
  replace(text, run_around(text, std::min(to + 1, text.size()), is_digit), reference);
}

void copy_keyword(std::string& text, Random& random) {
  const std::size_t from = random_place(text, is_upper, random), to = random_place(text, is_upper, random);
  if (from == text.size() || to == text.size()) return;
  const std::string keyword = cut_out(text, run_around(text, from, is_upper));
  replace(text, run_around(text, to, is_upper), keyword);
}

void delete_line(std::string& text, Random& random) { replace(text, random_line(text, random), ""); }

void repeat_line(std::string& text, Random& random) {
  const Piece line = random_line(text, random);
  const std::string copy = cut_out(text, line);
  const std::size_t times = 1 + below(3, random);
  for (std::size_t i = 0; i < times; ++i) text.insert(line.end, copy);
}

void move_line(std::string& text, Random& random) {
  const Piece line = random_line(text, random);
  const std::string copy = cut_out(text, line);
  replace(text, line, "");
  text.insert(text.empty() ? 0 : random_line(text, random).begin, copy);
}

void repeat_block(std::string& text, Random& random) {
  const std::size_t begin = below(text.size(), random);
  const std::string block = text.substr(begin, 1 + below(2000, random));
  text.insert(below(text.size(), random), block);
}

void delete_block(std::string& text, Random& random) {
  text.erase(below(text.size(), random), 1 + below(500, random));
}

void insert_symbols(std::string& text, Random& random) {
  constexpr std::string_view marks = "(),;#*$'\"/\\.&!=\n\r\t @HEDT";
  const std::string symbols(1 + below(20, random), marks[below(marks.size(), random)]);
  text.insert(below(text.size(), random), symbols);
}

// What an upload that was cut off looks like, with and without the file's last line.
void truncate(std::string& text, Random& random) {
  const std::size_t last = text.rfind('\n', text.size() < 2 ? 0 : text.size() - 2);
  const std::string tail = last == std::string::npos ? "" : text.substr(last);
  text.resize(below(text.size(), random));
  if (random() % 4 != 0) text += tail;
}

void splice(std::string& text, const std::string& other, Random& random) {
  const Piece line = text.empty() ? Piece{0, 0} : random_line(text, random);
  if (other.empty()) return;
  if (random() % 4 == 0) {
    text = text.substr(0, line.begin) + other.substr(random_line(other, random).begin);
  } else {
    const std::size_t begin = random_line(other, random).begin;
    text.insert(line.begin, other.substr(begin, 1 + below(3000, random)));
  }
}

void change(std::string& text, const std::vector<std::string>& others, Random& random) {
  using Change = void (*)(std::string&, Random&);
  // A change that leaves the syntax whole comes more often: it gets deeper into the reader.
  constexpr std::array<Change, 20> kinds_of_change{
      flip_bytes,    flip_bit,           change_digit,       change_digit, change_digit,
      change_number, change_number,      change_number,      copy_number,  copy_number,
      copy_number,   redirect_reference, redirect_reference, copy_keyword, delete_line,
      repeat_line,   move_line,          repeat_block,       delete_block, insert_symbols};
  const std::size_t chosen = below(kinds_of_change.size() + 2, random);
  if (text.empty()) return;
  if (chosen < kinds_of_change.size())
    kinds_of_change[chosen](text, random);
  else if (chosen == kinds_of_change.size())
    truncate(text, random);
  else
    splice(text, others[below(others.size(), random)], random);
}

}  // namespace

std::string mutated(const std::string& content, const std::vector<std::string>& others,
                    std::mt19937_64& random) {
  std::string text = content;
  const std::size_t changes = 1 + below(4, random);
  for (std::size_t i = 0; i < changes; ++i) change(text, others, random);
  return text;
}

}  // namespace nurbeam
