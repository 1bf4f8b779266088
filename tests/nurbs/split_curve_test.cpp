#include "nurbs/split_curve.h"

#include <gtest/gtest.h>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

TEST(SplitCurve, PiecesAreTheCurveAtTheSameParameters) {
  Generator generator(11);
  for (int i = 0; i < 200; ++i) {
    const NurbsCurve curve = random_nurbs(generator, 1 + i % 6, i % 2 == 0, i % 3 > 0);
    const double start = curve.knots().start(), end = curve.knots().end();
    std::vector<double> cuts{end, start, start - 1, end + 1};
    for (int k = 0; k < 3; ++k) cuts.push_back(uniform(generator, start, end));
    const std::vector<double> breaks = curve.knots().breaks();
    if (breaks.size() > 2) cuts.push_back(breaks[1]);  // where there is a knot already
    const std::vector<NurbsCurve> pieces = split_at(curve, cuts);
    ASSERT_EQ(pieces.size(), breaks.size() > 2 ? 5U : 4U);
    EXPECT_EQ(pieces.front().knots().start(), start);
    EXPECT_EQ(pieces.back().knots().end(), end);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const double a = pieces[k].knots().start(), b = pieces[k].knots().end();
      if (k > 0) EXPECT_EQ(a, pieces[k - 1].knots().end());
      EXPECT_EQ(pieces[k].degree(), curve.degree());
      for (int j = 0; j <= 8; ++j) {
        const double u = std::lerp(a, b, j / 8.0);
        ASSERT_LE((pieces[k].point(u) - curve.point(u)).norm(), 1e-12) << i;
      }
    }
  }
}

TEST(SplitCurve, WithoutParametersInsideItIsWhole) {
  const NurbsCurve circle = unit_circle();
  const std::vector<NurbsCurve> pieces = split_at(circle, {0, 4, 7});
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].control_points(), circle.control_points());
}

TEST(SplitCurve, AtAParameterGivenTwiceIsCutOnce) {
  EXPECT_EQ(split_at(unit_circle(), {1.5, 1.5, 2}).size(), 3U);
}

}  // namespace
}  // namespace nurbeam
