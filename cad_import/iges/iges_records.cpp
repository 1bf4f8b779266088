#include "cad_import/iges/iges_records.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace nurbeam {
namespace {

constexpr std::size_t field_width = 8;       // columns
constexpr std::size_t letter_column = 72;    // column 73, counted from 0
constexpr std::size_t parameter_width = 64;  // columns of parameters in their lines
constexpr std::string_view space = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(space);
  return begin == std::string_view::npos ? std::string_view()
                                         : text.substr(begin, text.find_last_not_of(space) + 1 - begin);
}

std::string field_of(const std::string& line, std::size_t column) {
  return std::string(trimmed(std::string_view(line).substr(column * field_width, field_width)));
}

int integer_field(const std::string& line, std::size_t column) {
  return std::atoi(field_of(line, column).c_str());
}

std::string right(long number, std::size_t width) {
  const std::string digits = std::to_string(number);
  return std::string(width - std::min(width, digits.size()), ' ') + digits;
}

std::string line_of(std::string text, char section, std::size_t number) {
  text.resize(letter_column, ' ');
  return text + section + right(static_cast<long>(number), field_width - 1) + '\n';
}

std::string name_of(const std::string& second_line) {
  const std::string label = field_of(second_line, 7);
  const int subscript = integer_field(second_line, 8);
  return label.empty() || subscript <= 0 ? label : label + "(" + std::to_string(subscript) + ")";
}

/// The length of a Hollerith string, "4Htext", that begins there; 0 where none does.
std::size_t hollerith_length(std::string_view text) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  const std::size_t head = static_cast<std::size_t>(end - text.data()) + 1;
  const bool is_one = error == std::errc() && head <= text.size() && *end == 'H';
  return is_one ? head + std::min(count, text.size() - head) : 0;
}

/// The number of a line in its section; 0 where it has none.
long number_of(std::string_view line) {
  return std::atol(std::string(line.substr(letter_column + 1)).c_str());
}

/// Where the lines of a section belong, from 0: one after another, but for gaps that their numbers tell of:
/// those of two lines that follow each other, or that of the last.
std::vector<std::size_t> places_of(const std::vector<std::string_view>& lines) {
  constexpr long widest_gap = 1000, widest_at_begin = 4;
  std::vector<std::size_t> places;
  long next = 1;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const long number = number_of(lines[i]), gap = number - next;
    const bool is_sure = i + 1 == lines.size() || number_of(lines[i + 1]) == number + 1;
    if (gap > 0 && gap <= (i == 0 ? widest_at_begin : widest_gap) && is_sure) next = number;
    places.push_back(static_cast<std::size_t>(next++) - 1);
  }
  return places;
}

}  // namespace

IgesRecords::IgesRecords(const std::string& content, char parameter_delimiter, char record_delimiter)
    : content_(content), parameter_delimiter_(parameter_delimiter), record_delimiter_(record_delimiter) {
  std::vector<std::string_view> directory, parameters;
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = std::min(content.find_first_of("\r\n", begin), content.size());
    const std::string_view line(content.data() + begin, end - begin);
    const char section = line.size() > letter_column ? line[letter_column] : ' ';
    if (section == 'S' || section == 'G') (head_ += line) += '\n';
    if (section == 'D') directory.push_back(line);
    if (section == 'P') parameters.push_back(line);
    begin = end + 1;
  }
  read_directory(directory);
  for (const std::string_view line : parameters) read_parameter_line(line);
}

void IgesRecords::read_directory(const std::vector<std::string_view>& lines) {
  const std::vector<std::size_t> places = places_of(lines);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines_.resize(places[i] / 2 + 1);
    (places[i] % 2 == 0 ? lines_.back().first : lines_.back().second) = lines[i].substr(0, letter_column);
  }
  for (Lines& entry : lines_) {
    const bool is_torn = entry.first.empty() || entry.second.empty();
    const std::string& known = entry.first.empty() ? entry.second : entry.first;
    const int type = known.empty() ? 0 : integer_field(known, 0);
    for (std::string* text : {&entry.first, &entry.second}) text->resize(letter_column, ' ');
    records_.push_back({.line = static_cast<int>(2 * records_.size() + 1),
                        .type = type,
                        .form = integer_field(entry.second, 4),
                        .matrix = integer_field(entry.first, 6),
                        .name = name_of(entry.second),
                        .is_torn = is_torn});
  }
}

void IgesRecords::read_parameter_line(std::string_view line) {
  const long owner = std::atol(std::string(line.substr(parameter_width, field_width)).c_str());
  if (const std::size_t record = at_line(owner); record != npos)
    lines_[record].parameters += line.substr(0, parameter_width);
}

std::size_t IgesRecords::at_line(long line) const {
  const bool is_one = line > 0 && line % 2 == 1 && static_cast<std::size_t>(line / 2) < records_.size();
  return is_one ? static_cast<std::size_t>(line / 2) : npos;
}

std::vector<std::string> IgesRecords::values(std::size_t record) const {
  const std::string_view text = lines_[record].parameters;
  std::vector<std::string> values;
  for (std::size_t at = 0;;) {
    at = std::min(text.find_first_not_of(space, at), text.size());
    const std::string ends{parameter_delimiter_, record_delimiter_};
    const std::size_t end =
        std::min(text.find_first_of(ends, at + hollerith_length(text.substr(at))), text.size());
    values.emplace_back(trimmed(text.substr(at, end - at)));
    if (end == text.size() || text[end] == record_delimiter_) break;
    at = end + 1;
  }
  values.erase(values.begin());  // the type
  return values;
}

void IgesRecords::set_values(std::size_t record, const std::vector<std::string>& values) {
  std::string text = std::to_string(records_[record].type);
  for (const std::string& value : values) {
    text += parameter_delimiter_;
    // OpenCASCADE loses the digits of a number that go over the end of a line; only a text may.
    const std::size_t end = text.size() % parameter_width + value.size() + 1;
    if (end > parameter_width && value.find('H') == std::string::npos)
      text.resize((text.size() + parameter_width - 1) / parameter_width * parameter_width, ' ');
    text += value;
  }
  lines_[record].parameters = text + record_delimiter_;
  changed_ = true;
}

std::size_t IgesRecords::add_like(std::size_t record, const std::vector<std::string>& values) {
  const std::size_t added = records_.size();
  records_.push_back(IgesRecord(records_[record]));
  records_.back().line = static_cast<int>(2 * added + 1);
  lines_.push_back(Lines(lines_[record]));
  set_values(added, values);
  return added;
}

void IgesRecords::leave_out(std::size_t record) {
  records_[record].type = 0;
  lines_[record].first.replace(0, field_width, right(0, field_width));
  lines_[record].second.replace(0, field_width, right(0, field_width));
  set_values(record, {});
}

void IgesRecords::set_free(std::size_t record, int matrix) {
  constexpr std::size_t status = 8 * field_width, matrix_field = 6 * field_width;
  lines_[record].first.replace(status + 2, 2, "00");
  if (records_[record].matrix == 0) {
    records_[record].matrix = matrix;
    lines_[record].first.replace(matrix_field, field_width, right(matrix, field_width));
  }
  changed_ = true;
}

std::string IgesRecords::text() const {
  if (!changed_) return content_;
  std::string directory, parameters;
  std::size_t count = 0;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const std::size_t first = count + 1;
    const std::string_view text = lines_[i].parameters;
    const std::string owner = right(records_[i].line, field_width);
    for (std::size_t at = 0; at < std::max<std::size_t>(text.size(), 1); at += parameter_width) {
      std::string piece(text.substr(at, parameter_width));
      piece.resize(parameter_width, ' ');
      parameters += line_of(piece + owner, 'P', ++count);
    }
    std::string head = lines_[i].first, tail = lines_[i].second;
    head.replace(field_width, field_width, right(static_cast<long>(first), field_width));
    tail.replace(3 * field_width, field_width, right(static_cast<long>(count + 1 - first), field_width));
    directory += line_of(head, 'D', 2 * i + 1) + line_of(tail, 'D', 2 * i + 2);
  }
  const std::string end = "S      1G      1D" +
                          right(2 * static_cast<long>(records_.size()), field_width - 1) + 'P' +
                          right(static_cast<long>(count), field_width - 1);
  return head_ + directory + parameters + line_of(end, 'T', 1);
}

}  // namespace nurbeam
