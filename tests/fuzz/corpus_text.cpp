#include "tests/fuzz/corpus_text.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cad_import/files/cad_format.h"
#include "cad_import/import_curves.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string format_name(const std::string& content) {
  if (content.starts_with("AutoCAD Binary DXF")) return "binary";
  if (content.starts_with("PK") || content.starts_with("\x1F\x8B")) return "packed";
  const std::optional<CadFormat> format = format_of(content);
  if (!format) return "";
  switch (*format) {
    case CadFormat::step:
      return "step";
    case CadFormat::iges:
      return "iges";
    case CadFormat::dxf:
      return "dxf";
    case CadFormat::brep:
      return "brep";
    case CadFormat::ifc:
      return "ifc";
    case CadFormat::json:
      return "json";
    case CadFormat::svg:
      return "";
  }
  return "";
}

}  // namespace

std::vector<CorpusText> corpus_of(const std::string& format, const std::string& from) {
  const fs::path tests = test::source_directory() / "tests";
  std::vector<fs::path> directories{tests / "corpus", tests / "corpus/kinds", tests / "fuzz/seeds"};
  if (!from.empty()) directories.emplace_back(from);
  std::vector<CorpusText> corpus;
  for (const fs::path& directory : directories)
    for (const auto& entry : fs::directory_iterator(directory)) {
      if (!entry.is_regular_file()) continue;
      const std::string content = content_of(entry.path());
      if (format_name(content) != format) continue;
      const ImportReport report = import_curves(entry.path(), {.time_limit = patience});
      if (report.ok())
        corpus.push_back({entry.path(), content, report.curves.size(), report.diagnostics.size()});
    }
  std::sort(corpus.begin(), corpus.end(), [](const CorpusText& a, const CorpusText& b) {
    return std::pair(a.content.size(), a.name) < std::pair(b.content.size(), b.name);
  });
  if (corpus.empty()) throw std::runtime_error("there is no file of this format");
  return corpus;
}

const CorpusText& random_text(const std::vector<CorpusText>& corpus, std::mt19937_64& random) {
  const auto share_of = [](const CorpusText& text) {
    return 1 / std::max(3000.0, double(text.content.size()));
  };
  double all = 0;
  for (const CorpusText& text : corpus) all += share_of(text);
  double left = all * (static_cast<double>(random() >> 11) * 0x1p-53);
  for (const CorpusText& text : corpus)
    if ((left -= share_of(text)) <= 0) return text;
  return corpus.back();
}

}  // namespace nurbeam
