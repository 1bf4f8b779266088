#pragma once
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace nurbeam {

/// An entity of an IGES file; its directory entry stands in line 2 i + 1, i counted from 0.
struct IgesEntity {
  int type;
  std::string parameters;
  int form = 0, level = 0, colour = 0;
  std::string label = {};
  int subscript = 0;
  int status = 0;
  int matrix = 0;  // the line of its transformation (124)
};

/// A line of an IGES file: 72 columns of content, the section's letter, the number.
inline std::string iges_line(const std::string& content, char section, int number) {
  std::ostringstream line;
  line << std::left << std::setw(72) << content << section << std::right << std::setw(7) << number << '\n';
  return line.str();
}

/// A file of these entities; the parameters of each fit a line of 64 columns. `unit`: its flag and name.
inline std::string iges_text_of(const std::vector<IgesEntity>& entities, const std::string& unit = "2,2HMM") {
  const auto fields = [](const std::vector<int>& values) {
    std::ostringstream text;
    for (int value : values) text << std::setw(8) << value;
    return text.str();
  };
  const std::string global =
      "1H,,1H;,4Htest,4Htest,4Htest,4Htest,32,38,6,308,15,4Htest,1.0," + unit + ",1,1.0,";
  std::string text = iges_line("test", 'S', 1) + iges_line(global.substr(0, 72), 'G', 1) +
                     iges_line(global.substr(72) + "13H240101.000000,1D-3,10.,4Htest,4Htest,11,0;", 'G', 2);
  int line = 0;
  for (const IgesEntity& e : entities) {
    text += iges_line(fields({e.type, line / 2 + 1, 0, 0, e.level, 0, e.matrix, 0, e.status}), 'D', line + 1);
    std::ostringstream second;
    second << fields({e.type, 0, e.colour, 1, e.form}) << std::string(16, ' ') << std::setw(8) << e.label
           << std::setw(8) << e.subscript;
    text += iges_line(second.str(), 'D', line + 2);
    line += 2;
  }
  for (std::size_t i = 0; i < entities.size(); ++i) {
    std::ostringstream content;
    content << std::left << std::setw(64) << entities[i].parameters << std::right << std::setw(8)
            << 2 * i + 1;
    text += iges_line(content.str(), 'P', int(i) + 1);
  }
  std::ostringstream terminate;
  terminate << "S      1G      2D" << std::setw(7) << line << 'P' << std::setw(7) << entities.size();
  return text + iges_line(terminate.str(), 'T', 1);
}

}  // namespace nurbeam
