#include "cad_import/program/drawing_text.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "cad_import/dxf/binary_dxf.h"
#include "cad_import/files/tolerant_text.h"
#include "cad_import/import_curves.h"

namespace nurbeam {

Unpacked drawing_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream stream;
  stream << in.rdbuf();
  if (!in || !stream) throw std::runtime_error("the file cannot be read; check its permissions");
  return drawing_text_of(std::move(stream).str());
}

Unpacked drawing_text_of(std::string content) {
  Unpacked drawing = unpacked(std::move(content), ImportOptions{}.size_limit_bytes);
  if (is_binary_dxf(drawing.content)) drawing.content = text_of_binary_dxf(drawing.content);
  drawing.content = tolerant_text(std::move(drawing.content));
  return drawing;
}

}  // namespace nurbeam
