#include "cad_import/iges/iges_global.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace nurbeam {
namespace {

constexpr std::size_t text_width = 72;
constexpr std::size_t scale_field = 13;
constexpr std::size_t unit_flag_field = 14;
constexpr std::size_t unit_name_field = 15;

struct IgesUnit {
  int flag;
  std::string_view name;
  double in_metres;
};

// IGES 5.3, 2.2.4.3.14 and 2.2.4.3.15; flag 3 stands for the unit named in parameter 15.
constexpr std::array<IgesUnit, 12> known_units{{{1, "INCH", 0.0254},
                                                {1, "IN", 0.0254},
                                                {2, "MM", 1e-3},
                                                {4, "FT", 0.3048},
                                                {5, "MI", 1609.344},
                                                {6, "M", 1},
                                                {7, "KM", 1e3},
                                                {8, "MIL", 2.54e-5},
                                                {9, "UM", 1e-6},
                                                {10, "CM", 1e-2},
                                                {11, "UIN", 2.54e-8},
                                                {11, "UINCH", 2.54e-8}}};

[[noreturn]] void fail(std::size_t parameter, const std::string& what) {
  throw std::runtime_error("IGES Global section, parameter " + std::to_string(parameter) + ": " + what);
}

// Columns 1 to 72 of the lines with a 'G' in column 73.
std::string global_text(const std::string& content) {
  std::string text;
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = std::min(content.find_first_of("\r\n", begin), content.size());
    if (end - begin > text_width && content[begin + text_width] == 'G')
      text.append(content, begin, text_width);
    begin = end + 1;
  }
  if (text.empty())
    throw std::runtime_error("the IGES file has no Global section (no line with 'G' in column 73)");
  return text;
}

// The parameters one after another; each call gives the next, without its delimiter.
class Parameters {
 public:
  explicit Parameters(std::string text) : text_(std::move(text)) {}

  std::string next() {
    ++number_;
    if (ended_) return "";
    skip_blanks();
    const std::size_t digits = count_digits();
    const bool is_hollerith = digits > 0 && at_ + digits < text_.size() && text_[at_ + digits] == 'H';
    std::string value = is_hollerith ? hollerith(digits) : plain();
    take_delimiter(is_hollerith);
    return value;
  }
  void delimiters(char parameter, char record) {
    parameter_delimiter_ = parameter;
    record_delimiter_ = record;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  std::size_t count_digits() const {
    std::size_t end = at_;
    while (end < text_.size() && std::isdigit(static_cast<unsigned char>(text_[end]))) ++end;
    return end - at_;
  }
  std::string hollerith(std::size_t digits) {
    std::size_t count = 0;
    std::from_chars(text_.data() + at_, text_.data() + at_ + digits, count);
    at_ += digits + 1;
    if (count > text_.size() - at_)
      fail(number_, "the Hollerith count " + std::to_string(count) + " is too large");
    at_ += count;
    return text_.substr(at_ - count, count);
  }
  std::string plain() {
    const std::string ends{parameter_delimiter_, record_delimiter_};
    const std::size_t end = std::min(text_.find_first_of(ends, at_), text_.size());
    std::string value = text_.substr(at_, end - at_);
    at_ = end;
    return value.erase(value.find_last_not_of(' ') + 1);
  }
  void take_delimiter(bool after_hollerith) {
    skip_blanks();
    if (at_ >= text_.size()) {
      ended_ = true;
      return;
    }
    if (text_[at_] != parameter_delimiter_ && text_[at_] != record_delimiter_) {
      fail(number_, std::string(after_hollerith ? "a wrong Hollerith count: " : "") + "expected '" +
                        parameter_delimiter_ + "' or '" + record_delimiter_ + "', found '" + text_[at_] +
                        "'");
    }
    ended_ = text_[at_] == record_delimiter_;
    ++at_;
  }

  std::string text_;
  std::size_t at_ = 0;
  std::size_t number_ = 0;
  bool ended_ = false;
  char parameter_delimiter_ = ',';
  char record_delimiter_ = ';';
};

// Parameters 1 to 15, at the index of their number.
std::vector<std::string> first_parameters(const std::string& text, IgesGlobal& global) {
  std::vector<std::string> values(1);
  // Parameter 1 defines the delimiter that ends it: "1H,," or, by default, nothing before ','.
  const bool own_delimiter = text.starts_with("1H") && text.size() > 3;
  const char delimiter = own_delimiter ? text[2] : ',';
  Parameters parameters(text);
  parameters.delimiters(delimiter, ';');
  values.push_back(parameters.next());
  const std::size_t second = text.find(delimiter, own_delimiter ? 3 : 0) + 1;
  const bool own_record = text.compare(second, 2, "1H") == 0 && second + 2 < text.size();
  global.parameter_delimiter = delimiter;
  global.record_delimiter = own_record ? text[second + 2] : ';';
  parameters.delimiters(delimiter, global.record_delimiter);
  while (values.size() <= unit_name_field) values.push_back(parameters.next());
  return values;
}

template <class Number>
Number number_or(const std::vector<std::string>& values, std::size_t parameter, Number fallback) {
  std::string text = values[parameter];
  if (text.empty()) return fallback;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
  Number value = fallback;
  const auto [end, error] = std::from_chars(text.data() + (text[0] == '+'), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    fail(parameter, "'" + text + "' is not a number");
  return value;
}

std::string trimmed_upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  text.erase(0, text.find_first_not_of(' '));
  return text.erase(text.find_last_not_of(' ') + 1);
}

double unit_in_metres(int flag, const std::string& name) {
  const std::string wanted = trimmed_upper(name);
  const auto* const unit = std::find_if(known_units.begin(), known_units.end(), [&](const IgesUnit& u) {
    return flag == 3 ? u.name == wanted : u.flag == flag;
  });
  if (unit == known_units.end()) {
    fail(unit_flag_field,
         "unit flag " + std::to_string(flag) + " with name '" + name +
             "' is no length unit; known are flags 1 to 11 and the names INCH MM FT MI M KM MIL UM CM UIN");
  }
  const auto* const named = std::find_if(known_units.begin(), known_units.end(),
                                         [&](const IgesUnit& u) { return u.name == wanted; });
  if (named != known_units.end() && named->in_metres != unit->in_metres) {
    fail(unit_name_field, "unit flag " + std::to_string(flag) + " is " + std::string(unit->name) +
                              ", but the name is '" + name +
                              "'; they must agree, and no one can tell which is right");
  }
  return unit->in_metres;
}

}  // namespace

IgesGlobal parse_iges_global(const std::string& content) {
  IgesGlobal global;
  const std::vector<std::string> values = first_parameters(global_text(content), global);
  global.unit_flag = number_or(values, unit_flag_field, 1);
  global.unit_name = values[unit_name_field];
  global.unit_in_metres = unit_in_metres(global.unit_flag, global.unit_name);
  global.scale = number_or(values, scale_field, 1.0);
  return global;
}

}  // namespace nurbeam
