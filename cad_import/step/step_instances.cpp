#include "cad_import/step/step_instances.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>

namespace nurbeam {
namespace {

/// Reads a STEP text past strings and comments.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  bool ended() const { return at_ >= text_.size(); }
  std::size_t at() const { return at_; }
  char here() const { return text_[at_]; }

  /// Past the character here, or past the string or comment that begins here.
  void advance() {
    if (here() == '\'')
      at_ = past(text_.find('\'', at_ + 1), 1);
    else if (text_.substr(at_, 2) == "/*")
      at_ = past(text_.find("*/", at_ + 2), 2);
    else
      ++at_;
  }
  /// To the next of these characters outside strings and comments.
  void seek(char wanted) {
    while (!ended() && here() != wanted) advance();
  }
  /// To the data section, past all statements before it, whose strings and comments may name it too.
  void seek_data() {
    for (skip_blanks(); !ended() && !text_.substr(at_).starts_with("DATA"); skip_blanks()) {
      seek(';');
      if (!ended()) advance();
    }
  }
  /// The number after '#', which is here; -1 if none follows.
  int reference() {
    int number = -1;
    const auto [end, error] = std::from_chars(text_.data() + at_ + 1, text_.data() + text_.size(), number);
    at_ = std::max<std::size_t>(end - text_.data(), at_ + 1);
    return error == std::errc() ? number : -1;
  }
  void skip_blanks() {
    while (!ended() && (std::isspace(static_cast<unsigned char>(here())) || text_.substr(at_, 2) == "/*"))
      advance();
  }

 private:
  std::size_t past(std::size_t found, std::size_t width) const {
    return found == std::string_view::npos ? text_.size() : found + width;
  }
  std::string_view text_;
  std::size_t at_ = 0;
};

std::vector<int> references_in(std::string_view value) {
  std::vector<int> numbers;
  for (Scanner scanner(value); scanner.seek('#'), !scanner.ended();)
    if (const int number = scanner.reference(); number >= 0) numbers.push_back(number);
  return numbers;
}

}  // namespace

StepInstances::StepInstances(std::string content) : content_(std::move(content)) {
  Scanner scanner(content_);
  scanner.seek_data();
  for (scanner.seek(';'); !scanner.ended(); scanner.seek(';')) {
    scanner.advance();
    scanner.skip_blanks();
    if (scanner.ended() || scanner.here() != '#') continue;
    const int number = scanner.reference();
    scanner.skip_blanks();
    if (number < 0 || scanner.ended() || scanner.here() != '=') continue;
    scanner.advance();
    const std::size_t begin = scanner.at();
    scanner.seek(';');
    const Instance instance{begin, scanner.at(), content_.substr(begin, scanner.at() - begin)};
    if (!instances_.emplace(number, instance).second)
      throw std::runtime_error("the instance #" + std::to_string(number) + " stands twice in the STEP file");
  }
  if (instances_.empty()) throw std::runtime_error("the STEP file has no instance");
  for (const auto& [number, instance] : instances_)
    for (const int used : references_in(instance.value)) users_[used].push_back(number);
}

const std::string& StepInstances::value(int number) const {
  const auto found = instances_.find(number);
  if (found == instances_.end())
    throw std::runtime_error("the STEP file has no instance #" + std::to_string(number));
  return found->second.value;
}

void StepInstances::replace(int number, std::string value) {
  std::string& kept = instances_.at(number).value;
  for (const int used : references_in(kept)) std::erase(users_[used], number);
  kept = std::move(value);
  for (const int used : references_in(kept)) users_[used].push_back(number);
}

int StepInstances::add(std::string value) {
  const int number = instances_.rbegin()->first + 1;
  for (const int used : references_in(value)) users_[used].push_back(number);
  instances_[number] = {0, 0, std::move(value)};
  added_.push_back(number);
  return number;
}

std::string StepInstances::keyword(int number) const {
  const std::string& text = value(number);
  Scanner scanner(text);
  scanner.skip_blanks();
  const std::size_t begin = scanner.at();
  std::size_t end = begin;
  while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
    ++end;
  return text.substr(begin, end - begin);
}

std::vector<int> StepInstances::references(int number) const { return references_in(value(number)); }

const std::vector<int>& StepInstances::users(int number) const {
  static const std::vector<int> none;
  const auto found = users_.find(number);
  return found == users_.end() ? none : found->second;
}

std::vector<int> StepInstances::with_keyword(std::string_view keyword_wanted) const {
  std::vector<int> numbers;
  for (const auto& [number, instance] : instances_)
    if (keyword(number) == keyword_wanted) numbers.push_back(number);
  return numbers;
}

std::string StepInstances::encoded_name(int number) const {
  const std::string& text = value(number);
  const std::string item = "REPRESENTATION_ITEM";
  std::size_t from = 0;
  if (keyword(number).empty())  // a complex instance: "( ... REPRESENTATION_ITEM('name') ... )"
    for (from = text.find(item); from != std::string::npos && text[from - 1] == '_';)
      from = text.find(item, from + 1);
  if (from == std::string::npos) return "";
  const std::size_t begin = text.find('\'', from);
  if (begin == std::string::npos) return "";
  std::size_t end = begin + 1;
  while (end < text.size() && (text[end] != '\'' || (end + 1 < text.size() && text[end + 1] == '\'')))
    end += text[end] == '\'' ? 2 : 1;
  return text.substr(begin + 1, end - begin - 1);
}

std::string StepInstances::text() const {
  // By place in the file, which need not be by number.
  std::vector<const Instance*> in_order;
  for (const auto& [number, instance] : instances_)
    if (instance.end > 0) in_order.push_back(&instance);
  std::sort(in_order.begin(), in_order.end(), [](auto* a, auto* b) { return a->begin < b->begin; });
  std::string result;
  std::size_t at = 0;
  for (const Instance* instance : in_order) {
    result.append(content_, at, instance->begin - at);
    result += instance->value;
    at = instance->end;
  }
  const std::size_t after_last = at < content_.size() ? at + 1 : at;  // past its ';'
  result.append(content_, at, after_last - at);
  for (const int number : added_) result += "\n#" + std::to_string(number) + "=" + value(number) + ";";
  return result.append(content_, after_last, std::string::npos);
}

}  // namespace nurbeam
