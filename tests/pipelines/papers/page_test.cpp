#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "pipelines/papers/papers_page.h"
#include "tests/support/places.h"

namespace nurbeam::papers {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Bars of a row that are no part of its cells.
std::size_t bars(const std::string& row) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < row.size(); ++i) count += row[i] == '|' && (i == 0 || row[i - 1] != '\\');
  return count;
}

TEST(PapersPage, RefusesARowThatHasOtherCellsThanItsHeading) {
  Page page(std::filesystem::path(testing::TempDir()) / "papers_page");
  EXPECT_THROW(page.table("how", {"a", "b"}, {{"1", "2"}, {"1", "2", "3"}}), std::logic_error);
}

TEST(PapersPage, HasTheTableOfItemsAtItsHead) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "papers_page";
  Page page(folder);
  page.heading("Page", 1);
  page.place_status();
  page.paragraph("A section.");
  page.status({"Fig. 1", "here", "reproduced", "1 m"});
  page.write();
  EXPECT_EQ(content(folder / "papers.md"),
            "# Page\n\n| item | where | verdict | error |\n| --- | --- | --- | --- |\n"
            "| Fig. 1 | here | reproduced | 1 m |\n\nA section.\n");
}

TEST(PapersPage, AsGeneratedHasInEachRowAsManyCellsAsInItsHeading) {
  std::ifstream page(std::filesystem::path(test::source_directory()) / "docs/papers.md");
  std::size_t columns = 0, rows = 0, line_number = 0;
  for (std::string line; std::getline(page, line);) {
    ++line_number;
    const std::size_t now = line.starts_with("|") ? bars(line) : 0;
    if (columns > 0 && now > 0) EXPECT_EQ(now, columns) << "line " << line_number;
    columns = now;
    rows += now > 0;
  }
  EXPECT_GT(rows, 100U);
}

}  // namespace
}  // namespace nurbeam::papers
