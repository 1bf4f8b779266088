#include "pipelines/papers/papers_page.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "cad_import/files/atomic_file.h"

namespace nurbeam::papers {

namespace {

void write_file(const std::filesystem::path& file, const std::string& content) {
  const std::filesystem::path part = temporary_name(file);
  std::ofstream stream(part, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) throw std::runtime_error(part.string() + " cannot be written");
  publish(file);
}

}  // namespace

Page::Page(std::filesystem::path directory) : directory_(std::move(directory)) {
  std::filesystem::create_directories(directory_ / "images" / "papers");
}

void Page::heading(const std::string& words, int level) {
  text_ << (text_.tellp() > 0 ? "\n" : "") << std::string(static_cast<std::size_t>(level), '#') << ' '
        << words << '\n';
}

void Page::paragraph(const std::string& words) { text_ << '\n' << words << '\n'; }

void Page::table(const std::string& statement, const std::vector<std::string>& header,
                 const std::vector<std::vector<std::string>>& rows) {
  const auto row = [&](const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) text_ << "| " << cell << ' ';
    text_ << "|\n";
  };
  text_ << '\n' << statement << ".\n\n";
  row(header);
  row(std::vector<std::string>(header.size(), "---"));
  for (const auto& cells : rows) row(cells);
}

void Page::figure(const std::string& name, const Plot& plot, const std::string& statement) {
  write_file(directory_ / "images" / "papers" / (name + ".svg"), svg(plot));
  text_ << "\n![" << plot.title << "](images/papers/" << name << ".svg)\n\n" << statement << ".\n";
}

void Page::write() const { write_file(directory_ / "papers.md", text_.str()); }

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

}  // namespace nurbeam::papers
