#include "cad_import/program/drawing_text.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "cad_import/dxf/binary_dxf.h"
#include "cad_import/files/tolerant_text.h"
#include "cad_import/import_curves.h"
#include "cad_import/program/unpacked.h"

namespace nurbeam {

std::string drawing_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream stream;
  stream << in.rdbuf();
  if (!in || !stream) throw std::runtime_error("the file cannot be read; check its permissions");
  std::string content = unpacked(std::move(stream).str(), ImportOptions{}.size_limit_bytes);
  if (is_binary_dxf(content)) content = text_of_binary_dxf(content);
  return tolerant_text(std::move(content));
}

}  // namespace nurbeam
