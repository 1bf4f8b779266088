#include "pipelines/command/text_table.h"

#include <gtest/gtest.h>

#include <sstream>

namespace nurbeam::of_text_table {
namespace {

const std::vector<std::vector<std::string>> rows = {
    {"index", "name", "length", "start"}, {"1", "a", "2.5", "(0, 0, 0)"}, {"2", "ö", "10", "(1, 0, 0)"}};

TEST(TextTable, HasColumnsAsWideAsTheirCells) {
  std::ostringstream out;
  EXPECT_TRUE(print_table(out, rows).empty());
  EXPECT_EQ(out.str(),
            "  index  name  length  start\n"
            "  1      a     2.5     (0, 0, 0)\n"
            "  2      ö     10      (1, 0, 0)\n");
}

TEST(TextTable, LeavesOutWhatANarrowTerminalHasNoPlaceFor) {
  std::ostringstream out, wide, least;
  const std::vector<std::string> order = {"start", "kind", "name"}, none, first = {"start"},
                                 both = {"start", "name"};
  EXPECT_EQ(print_table(wide, rows, 32, order), none);
  EXPECT_EQ(print_table(out, rows, 31, order), first);
  EXPECT_EQ(out.str(), "  index  name  length\n  1      a     2.5\n  2      ö     10\n");
  EXPECT_EQ(print_table(least, rows, 3, order), both);
}

}  // namespace
}  // namespace nurbeam::of_text_table
