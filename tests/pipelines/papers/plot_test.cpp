#include "pipelines/papers/plot.h"

#include <gtest/gtest.h>

#include <limits>

namespace nurbeam {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Plot, DrawsEveryFiniteValueOnceAndNamesItsLines) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string picture =
      svg({"A & B", "t [s]", "y [m]", {{"a < b", {0, 1, 2, 3}, {0, nan, 4, 9}, PlotLine::Style::marks}}});
  EXPECT_EQ(count(picture, "<circle"), 3U + 1U);  // and one in the legend
  EXPECT_EQ(count(picture, "a &lt; b"), 1U);
  EXPECT_EQ(count(picture, "A &amp; B"), 1U);
  EXPECT_EQ(count(picture, "nan"), 0U);
}

TEST(Plot, AGapBreaksALine) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string whole = svg({"", "", "", {{"", {0, 1, 2}, {0, 1, 2}}}});
  const std::string broken = svg({"", "", "", {{"", {0, 1, 2, 3}, {0, 1, nan, 2}}}});
  const auto moves = [](const std::string& picture) {
    const std::size_t at = picture.rfind("<path d=\"M");
    return count(picture.substr(at), "M");
  };
  EXPECT_EQ(moves(whole), 1U);
  EXPECT_EQ(moves(broken), 2U);
}

TEST(Plot, ALogarithmicAxisHasDecadesAndLeavesOutWhatIsNotPositive) {
  Plot plot{"", "", "", {{"", {1, 10, 100}, {1e-3, 0, 1e-5}, PlotLine::Style::marks}}};
  plot.log_x = plot.log_y = true;
  const std::string picture = svg(plot);
  EXPECT_EQ(count(picture, "<circle"), 2U);
  EXPECT_EQ(count(picture, ">1e-4<"), 1U);
}

TEST(Plot, WithNothingToDrawIsRefused) {
  EXPECT_THROW(svg({"", "", "", {}}), std::invalid_argument);
  EXPECT_THROW(svg({"", "", "", {{"", {1, 2}, {1}}}}), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
