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

std::string table_text(const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  const auto add = [&](const std::vector<std::string>& cells) {
    if (cells.size() != header.size())
      throw std::logic_error("a table's row has other cells than its heading");
    for (const std::string& cell : cells) text += "| " + cell + " ";
    text += "|\n";
  };
  add(header);
  add(std::vector<std::string>(header.size(), "---"));
  for (const auto& cells : rows) add(cells);
  return text;
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
  text_ << '\n' << statement << ".\n\n" << table_text(header, rows);
}

void Page::figure(const std::string& name, const Plot& plot, const std::string& statement) {
  write_file(directory_ / "images" / "papers" / (name + ".svg"), svg(plot));
  text_ << "\n![" << plot.title << "](images/papers/" << name << ".svg)\n\n" << statement << ".\n";
}

void Page::place_status() {
  head_ = text_.str();
  text_.str("");
}

void Page::write() const {
  std::string table;
  if (!statuses_.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const Status& row : statuses_) rows.push_back({row.item, row.where, row.verdict, row.error});
    table = "\n" + table_text({"item", "where", "verdict", "error"}, rows);
  }
  write_file(directory_ / "papers.md", head_ + table + text_.str());
}

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

}  // namespace nurbeam::papers
