#include "fem/element/moving_basis.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

// The series of ElementBasis, carried through every product, are the witness of all derivatives.
void expect_same(const std::array<Jet, 4>& row, const std::array<Jet, 4>& exact, int degree,
                 const char* what) {
  double size = 0;
  for (const Jet& x : exact)
    for (int i = 0; i < 2; ++i) size = std::max({size, std::abs(x.value()), std::abs(x.d(i))});
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(row[k].value(), exact[k].value(), 1e-12 * size) << what << k;
    for (int i = 0; i < 2 && degree > 0; ++i) {
      EXPECT_NEAR(row[k].d(i), exact[k].d(i), 1e-11 * size) << what << k;
      for (int j = 0; j < 2 && degree > 1; ++j) {
        const double second = std::abs(exact[k].d(i, j)) + size;
        EXPECT_NEAR(row[k].d(i, j), exact[k].d(i, j), 1e-10 * second) << what << k << i << j;
        for (int m = 0; m < 2 && degree > 2; ++m)
          EXPECT_NEAR(row[k].d(i, j, m), exact[k].d(i, j, m), 1e-9 * (std::abs(exact[k].d(i, j, m)) + second))
              << what << k << i << j << m;
      }
    }
  }
}

void expect_rows(const MovingRows& rows, const ShapeFunctions<Jet>& y, Derivatives wanted) {
  const bool two = wanted == Derivatives::two;
  const auto jets = [](const MovingRows::Series& series, const std::array<MovingRows::Row, 4>& third,
                       int degree) {
    std::array<Jet, 4> row;
    for (int k = 0; k < 4; ++k) {
      Jet::Coefficients c{series.value[k], series.first[0][k], series.first[1][k]};
      if (degree > 1)
        c[3] = series.second[0][k] / 2, c[4] = series.second[1][k], c[5] = series.second[2][k] / 2;
      if (degree > 2)
        c[6] = third[0][k] / 6, c[7] = third[1][k] / 2, c[8] = third[2][k] / 2, c[9] = third[3][k] / 6;
      row[k] = Jet(c);
    }
    return row;
  };
  expect_same(jets(rows.r, rows.r_third, two ? 3 : 2), y.value, two ? 3 : 2, "row of r ");
  expect_same(jets(rows.rs, {}, two ? 2 : 1), y.d1, two ? 2 : 1, "row of r_s ");
  expect_same(jets(rows.rss, {}, two ? 2 : 1), y.d2, two ? 2 : 1, "row of r_ss ");
  expect_same(jets({rows.rsss, rows.rsss_first, {}}, {}, two ? 1 : 0), y.d3, two ? 1 : 0, "row of r_sss ");
  Jet::Coefficients c{rows.kappa0, rows.kappa0_first[0], rows.kappa0_first[1]};
  if (two) c[3] = rows.kappa0_second[0] / 2, c[4] = rows.kappa0_second[1], c[5] = rows.kappa0_second[2] / 2;
  expect_same({Jet(c), {}, {}, {}}, {y.kappa0, {}, {}, {}}, two ? 2 : 1, "row of kappa0 ");
}

void compare(const ReferenceCurve& curve, const Chart& chart, double s_a, double s_b) {
  const Jet a = Jet::variable(s_a, 0), b = Jet::variable(s_b, 1);
  const MovingBasis fast(curve, chart, a, b);
  const ElementBasis<Jet> series(curve, chart, a, b);
  for (const Jet& s :
       {a, b, a + 0.3 * (b - a), a + 0.8 * (b - a), Jet(0.4 * s_a + 0.6 * s_b), 0.5 * (a + Jet(s_b))}) {
    const ShapeFunctions<Jet> x = fast.at(s), y = series.at(s);
    expect_same(x.value, y.value, 3, "value ");
    expect_same(x.d1, y.d1, 2, "d1 ");
    expect_same(x.d2, y.d2, 2, "d2 ");
    expect_same(x.d3, y.d3, 1, "d3 ");
    const std::array<Jet, 4> drawn{x.kappa0, {}, {}, {}}, exact{y.kappa0, {}, {}, {}};
    expect_same(drawn, exact, 2, "kappa0 ");
    for (const Derivatives wanted : {Derivatives::one, Derivatives::two})
      expect_rows(MovingBasis(curve, chart, a, b, wanted).rows_at(s), y, wanted);
  }
  const double still = 0.4 * s_a + 0.6 * s_b;
  MovingRows::Series r = fast.positions_at(still);
  std::array<Jet, 4> row;
  for (int k = 0; k < 4; ++k) row[k] = Jet(Jet::Coefficients{r.value[k], r.first[0][k], r.first[1][k]});
  expect_same(row, series.at(Jet(still)).value, 1, "row of r at a place that stays ");
}

TEST(MovingBasis, IsTheSeriesOfTheElement) {
  std::mt19937 random(5);
  for (int sample = 0; sample < 20; ++sample)
    for (const int dimension : {2, 3}) {
      const ReferenceCurve curve(testing::uneven_axis(random, dimension), dimension);
      const auto& breaks = curve.breaks();
      for (int j = 0; j < curve.segment_count(); ++j) {
        const double h = breaks[j + 1] - breaks[j];
        compare(curve, {.segment = j}, breaks[j] + 0.1 * h, breaks[j] + 0.45 * h);
        compare(curve, {.segment = -1}, breaks[j] + 0.1 * h, breaks[j] + 0.45 * h);
      }
    }
}

TEST(MovingBasis, IsTheSeriesOnAStraightLineAtConstantSpeed) {
  Eigen::Matrix4d line, uneven;
  for (int i = 0; i < 4; ++i) {
    line.col(i) << 2 + 0.5 * i, -1 + 0.25 * i, 0, 1;
    uneven.col(i) << 2 + 0.5 * i * i, -1 + 0.25 * i * i, 0, 1;
  }
  const ReferenceCurve curve({RationalCubic(line), RationalCubic(2 * line), RationalCubic(uneven)}, 2);
  EXPECT_TRUE(curve.is_uniform_line(0));
  EXPECT_TRUE(curve.is_uniform_line(1));
  EXPECT_FALSE(curve.is_uniform_line(2));
  for (int j = 0; j < 3; ++j) {
    const double s = curve.breaks()[j], h = curve.breaks()[j + 1] - s;
    compare(curve, {.segment = j}, s + 0.1 * h, s + 0.45 * h);
  }
}

TEST(MovingBasis, IsTheSeriesOfConstantWeights) {
  std::mt19937 random(6);
  for (int sample = 0; sample < 10; ++sample)
    for (const int dimension : {2, 3}) {
      const ReferenceCurve curve(testing::uneven_axis(random, dimension), dimension);
      const auto& breaks = curve.breaks();
      for (int j = 0; j < curve.segment_count(); ++j) {
        const double h = breaks[j + 1] - breaks[j];
        for (const int segment : {j, -1})
          compare(curve, {.segment = segment, .constant_weights = std::array{1.0, 0.8, 0.9, 1.1}},
                  breaks[j] + 0.1 * h, breaks[j] + 0.45 * h);
      }
      // over a break of the drawing
      compare(curve, {.segment = -1, .constant_weights = std::array{1.0, 1.3, 0.7, 1.0}}, 0.7 * breaks[1],
              breaks[1] + 0.4 * (breaks[2] - breaks[1]));
    }
}

}  // namespace
}  // namespace nurbeam
