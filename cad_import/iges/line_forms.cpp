#include "cad_import/iges/line_forms.h"

#include <IGESData_IGESModel.hxx>
#include <IGESGeom_Line.hxx>
#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace nurbeam {
namespace {

constexpr std::size_t field = 8;  // columns

/// Of each entity of the directory: the second of its two lines.
std::vector<std::string> second_lines(const std::string& content) {
  constexpr std::size_t section_column = 72;
  std::vector<std::string> lines;
  bool is_second = false;
  for (std::size_t begin = 0; begin < content.size();) {
    const std::size_t end = std::min(content.find_first_of("\r\n", begin), content.size());
    if (end - begin > section_column && content[begin + section_column] == 'D') {
      if (is_second) lines.push_back(content.substr(begin, section_column));
      is_second = !is_second;
    }
    begin = end + 1;
  }
  return lines;
}

int number_in(const std::string& line, std::size_t column) {
  return std::atoi(line.substr(column * field, field).c_str());
}

}  // namespace

void restore_line_forms(const std::string& content, const IGESData_IGESModel& model) {
  constexpr int line_type = 110;
  const std::vector<std::string> directory = second_lines(content);
  for (int i = 1; i <= model.NbEntities() && i <= static_cast<int>(directory.size()); ++i) {
    const auto line = Handle(IGESGeom_Line)::DownCast(model.Value(i));
    const std::string& entry = directory[static_cast<std::size_t>(i - 1)];
    if (!line.IsNull() && number_in(entry, 0) == line_type) line->SetInfinite(number_in(entry, 4));
  }
}

void check_bounded(const IGESGeom_Line& line) {
  const int form = line.Infinite();
  if (form == 0) return;
  throw std::runtime_error(std::string("it is ") +
                           (form == 1 ? "a ray (form 1)" : "an infinite line (form 2)") +
                           ", which has no length; draw it from end to end, as form 0");
}

}  // namespace nurbeam
