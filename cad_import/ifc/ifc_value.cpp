#include "cad_import/ifc/ifc_value.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "cad_import/step/encoded_text.h"

namespace nurbeam {
namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  IfcValue value(int depth) {
    constexpr int deepest_value = 60;
    if (depth > deepest_value) fail("is nested too deeply");
    skip_blanks();
    if (at_end()) fail("ends too early");
    const char c = text_[at_];
    if (c == '$' || c == '*') {
      ++at_;
      return {};
    }
    if (c == '#') return reference();
    if (c == '\'') return string();
    if (c == '.' && at_ + 1 < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_ + 1])) != 0)
      return enumeration();
    if (c == '(') return list(depth);
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) return typed(depth);
    return number();
  }

 private:
  [[noreturn]] static void fail(const std::string& what) { throw std::runtime_error("its text " + what); }
  [[noreturn]] void fail_at_value() const {
    const std::size_t end = text_.find_first_of(",() \t\r\n", at_ + 1);
    constexpr std::size_t longest = 20;
    fail("has '" + std::string(text_.substr(at_, std::min(end - at_, longest))) +
         "' in the place of a value");
  }
  bool at_end() const { return at_ >= text_.size(); }

  void skip_blanks() {
    while (!at_end())
      if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
        ++at_;
      else if (text_.substr(at_, 2) == "/*")
        at_ = std::min(text_.find("*/", at_ + 2), text_.size() - 2) + 2;
      else
        return;
  }

  IfcValue reference() {
    IfcValue value{.kind = IfcValue::Kind::reference};
    const auto [end, error] =
        std::from_chars(text_.data() + at_ + 1, text_.data() + text_.size(), value.reference);
    if (error != std::errc()) fail("has a '#' without a number");
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  IfcValue string() {
    IfcValue value{.kind = IfcValue::Kind::text};
    std::string raw;
    for (++at_; !at_end(); ++at_) {
      if (text_[at_] == '\'') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '\'') break;
        ++at_;
      }
      raw += text_[at_];
    }
    if (at_end()) fail("has a string without an end");
    ++at_;
    value.text = step_decoded(raw);
    return value;
  }

  IfcValue enumeration() {
    const std::size_t end = text_.find('.', at_ + 1);
    if (end == std::string_view::npos) fail("has an enumeration without an end");
    IfcValue value{.kind = IfcValue::Kind::enumeration,
                   .text = std::string(text_.substr(at_ + 1, end - at_ - 1))};
    at_ = end + 1;
    return value;
  }

  IfcValue number() {
    IfcValue value{.kind = IfcValue::Kind::number};
    const bool has_plus = text_[at_] == '+' && text_.substr(at_, 2) != "+-";
    const std::size_t begin = at_ + (has_plus ? 1 : 0);
    const auto [end, error] =
        std::from_chars(text_.data() + begin, text_.data() + text_.size(), value.number);
    if (error != std::errc()) fail_at_value();
    const auto behind = static_cast<std::size_t>(end - text_.data());
    if (behind < text_.size() && std::string_view(",) \t\r\n/").find(text_[behind]) == std::string_view::npos)
      fail_at_value();
    at_ = behind;
    return value;
  }

  IfcValue list(int depth) {
    IfcValue value{.kind = IfcValue::Kind::list};
    ++at_;
    skip_blanks();
    while (!at_end() && text_[at_] != ')') {
      value.items.push_back(this->value(depth + 1));
      skip_blanks();
      if (!at_end() && text_[at_] != ')' && text_[at_] != ',') fail_at_value();
      if (!at_end() && text_[at_] == ',') ++at_;
      skip_blanks();
    }
    if (at_end()) fail("has a list without an end");
    ++at_;
    return value;
  }

  IfcValue typed(int depth) {
    const std::size_t begin = at_;
    while (!at_end() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    std::string keyword(text_.substr(begin, at_ - begin));
    skip_blanks();
    if (at_end() || text_[at_] != '(') fail("has '" + keyword + "' in the place of a value");
    IfcValue value = list(depth);
    value.kind = IfcValue::Kind::typed;
    value.text = std::move(keyword);
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

double IfcValue::as_number() const {
  if (kind == Kind::number) return number;
  if (kind == Kind::typed && items.size() == 1) return items[0].as_number();
  throw std::runtime_error("a value that must be a number is none");
}

const IfcValue& IfcValue::at(std::size_t i) const& {
  static const IfcValue none;
  return i < items.size() ? items[i] : none;
}

IfcValue IfcValue::at(std::size_t i) && { return i < items.size() ? std::move(items[i]) : IfcValue(); }

IfcValue parsed_instance(std::string_view text) {
  IfcValue value = Parser(text).value(0);
  if (value.kind != IfcValue::Kind::typed) throw std::runtime_error("its text is no simple instance");
  return value;
}

}  // namespace nurbeam
