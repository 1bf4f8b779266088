#include "nurbs/knot_insertion.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

TEST(KnotInsertionTest, LeavesTheCurveAsItIsWhereverTheKnotIs) {
  Generator generator(77);
  for (int i = 0; i < 300; ++i) {
    const NurbsCurve curve = random_nurbs(generator, 1 + i % 5, i % 3 == 0, i % 2 == 0);
    const double a = curve.knots().start(), b = curve.knots().end();
    const double u = uniform(generator, a, b);
    const int times = 1 + i % curve.degree();
    const NurbsCurve finer = with_knot(curve, u, times);
    ASSERT_EQ(finer.knots().multiplicity(u), times);
    ASSERT_EQ(finer.knots().control_point_count(), curve.knots().control_point_count() + times);
    for (int k = 0; k <= 20; ++k) {
      const double at = a + (b - a) * k / 20;
      ASSERT_LE((finer.point(at) - curve.point(at)).norm(), 1e-13);
    }
  }
}

TEST(KnotInsertionTest, AtAKnotThatStandsThereItRaisesItsMultiplicity) {
  const NurbsCurve circle = unit_circle();  // of degree 2, with double knots
  EXPECT_THROW(with_knot(circle, 1), std::invalid_argument);
  EXPECT_THROW(with_knot(circle, circle.knots().start()), std::invalid_argument);
  EXPECT_THROW(with_knot(circle, 0.5, 0), std::invalid_argument);
  const NurbsCurve once = with_knot(circle, 0.5), twice = with_knot(once, 0.5);
  EXPECT_EQ(twice.knots().multiplicity(0.5), 2);
  for (int i = 0; i <= 100; ++i) EXPECT_NEAR(twice.point(4e-2 * i).norm(), 1, 1e-15);
}

}  // namespace
}  // namespace nurbeam
