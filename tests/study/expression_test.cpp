#include "pipelines/study/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nurbeam {
namespace {

double value_of(const std::string& text, double x = 3) {
  const ExpressionScope scope{.value = [x](const std::string& name) -> ExpressionValue {
                                if (name == "x") return x;
                                if (name == "body 1.s") return std::vector<double>{4, 9, 2};
                                if (name == "a.b.c") return std::vector<double>{0, 1, 4};
                                throw std::invalid_argument("unknown " + name);
                              },
                              .event_time =
                                  [](const std::string& kind, const std::string& of) {
                                    return kind == "leaves" && of == "body 1" ? 0.7 : std::nan("");
                                  },
                              .times = {0, 1, 2}};
  return Expression::parse(text).number(scope);
}

TEST(Expression, HasTheUsualPrecedence) {
  EXPECT_EQ(value_of("1 + 2 * x ^ 2"), 19);
  EXPECT_EQ(value_of("-x ^ 2"), -9);
  EXPECT_EQ(value_of("2 ^ 3 ^ 2"), 512);
  EXPECT_EQ(value_of("(1 + 2) * x / 9 - 4"), -3);
  EXPECT_EQ(value_of("2 ^ -1"), 0.5);
  EXPECT_EQ(value_of("x <= 3"), 1);
  EXPECT_EQ(value_of("x < 3"), 0);
  EXPECT_DOUBLE_EQ(value_of("sin(pi / 6) + 1e-3"), 0.501);
  EXPECT_EQ(value_of("max(x, 5) - min(x, 5)"), 2);
  EXPECT_EQ(value_of("hypot(x, 4)"), 5);
  EXPECT_EQ(value_of("or(time(leaves, nobody), 2) + or(x, 7)"), 5);
}

TEST(Expression, TakesNumbersOfHistories) {
  EXPECT_EQ(value_of("max('body 1'.s)"), 9);
  EXPECT_EQ(value_of("min('body 1'.s - x)"), -1);
  EXPECT_EQ(value_of("first(a.b.c) + last(a.b.c)"), 4);
  EXPECT_EQ(value_of("integral(a.b.c)"), 0.5 + 2.5);
  EXPECT_EQ(value_of("mean(a.b.c)"), 1.5);
  EXPECT_DOUBLE_EQ(value_of("rms(a.b.c)"), std::sqrt((0.5 + 8.5) / 2));
  EXPECT_EQ(value_of("at(end, a.b.c)"), 4);
  EXPECT_EQ(value_of("at(start, 'body 1'.s)"), 4);
  EXPECT_EQ(value_of("at(x / 2, a.b.c)"), 2.5);
  EXPECT_TRUE(std::isnan(value_of("at(7, a.b.c)")));
  EXPECT_EQ(value_of("time(leaves, 'body 1')"), 0.7);
}

TEST(Expression, KnowsWhenAHistoryComesToAValue) {
  EXPECT_EQ(value_of("passes('body 1'.s, 6.5)"), 0.5);
  EXPECT_EQ(value_of("passes('body 1'.s, x)"), 1 + 6.0 / 7);
  EXPECT_EQ(value_of("passes(a.b.c, 0)"), 0);
  EXPECT_EQ(value_of("passes(a.b.c, 4)"), 2);
  EXPECT_TRUE(std::isnan(value_of("passes(a.b.c, 5)")));
  EXPECT_EQ(value_of("at(passes('body 1'.s, 6.5), a.b.c)"), 0.5);
}

TEST(Expression, NamesWhatItNeeds) {
  const auto names = Expression::parse("x + max(a.b.c) * x - time(leaves, trolley)").names();
  EXPECT_EQ(names, (std::vector<std::string>{"x", "a.b.c"}));
  EXPECT_EQ(Expression::parse("at(end_z, start_h.s)").names(),
            (std::vector<std::string>{"end_z", "start_h.s"}));
}

TEST(Expression, KnowsTheTimesThatItAsksFor) {
  EXPECT_EQ(Expression::parse("at(2 * 3, a.b) + max(at(0.5, c.d), 1)").times(),
            (std::vector<double>{6, 0.5}));
  EXPECT_TRUE(Expression::parse("at(x, a.b) + at(time(leaves, c), a.b) + at(end, a.b)").times().empty());
}

// What is wrong, with the number of the character.
std::string complaint(const std::string& text) {
  try {
    Expression::parse(text);
  } catch (const ExpressionError& problem) {
    return std::to_string(problem.offset + 1) + ": " + problem.what();
  }
  return {};
}

TEST(Expression, SaysWhereItIsWrong) {
  EXPECT_NE(complaint("1 +").find("4: the expression ends"), std::string::npos);
  EXPECT_NE(complaint("(1 + 2").find("expected \")\""), std::string::npos);
  EXPECT_NE(complaint("2 x").find("3: expected an operator"), std::string::npos);
  EXPECT_NE(complaint("maxx(a.b)").find("1: there is no function \"maxx\"; did you mean \"max\"?"),
            std::string::npos);
  EXPECT_NE(complaint("2 * end(a.b)").find("did you mean \"at(end, ...)\""), std::string::npos);
  EXPECT_NE(complaint("sqrt(1, 2)").find("sqrt takes 1 argument(s), not 2"), std::string::npos);
  EXPECT_NE(complaint("'body").find("never closed"), std::string::npos);
  EXPECT_NE(complaint("1 $ 2").find("3: expected an operator"), std::string::npos);
  EXPECT_NE(complaint(std::string(500, '(')).find("nested more than 100"), std::string::npos);
  EXPECT_NE(complaint("1e999").find("no number that can be held"), std::string::npos);
}

TEST(Expression, OfAHistoryIsNoNumber) {
  EXPECT_THROW(value_of("a.b.c + 1"), std::invalid_argument);
  EXPECT_THROW(value_of("mean(x)"), std::invalid_argument);
  EXPECT_THROW(value_of("y"), std::invalid_argument);
}

// They are evaluated recursively: the stack would end.
TEST(Expression, OfTooManyOperationsIsRefused) {
  std::string sum = "1";
  for (int i = 0; i < 1000; ++i) sum += "+1";
  EXPECT_EQ(Expression::parse(sum).number({}), 1001);
  for (const int more : {1, 60'000, 1'000'000}) {
    std::string longer = sum;
    for (int i = 0; i < more; ++i) longer += i % 2 ? "*1" : "-1";
    try {
      Expression::parse(longer);
      ADD_FAILURE() << more;
    } catch (const ExpressionError& error) {
      EXPECT_NE(std::string(error.what()).find("more than 1000 operations"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace nurbeam
