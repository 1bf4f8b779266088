#include "pipelines/case/quantity.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numbers>
#include <sstream>

#include "tests/support/places.h"

namespace nurbeam {
namespace {

double value(const std::string& text, Dimension dimension) {
  const ParsedQuantity quantity = parse_quantity(text, dimension);
  EXPECT_EQ(quantity.error, "");
  return quantity.value.value_or(-1);
}

TEST(Quantity, UnitsAreConvertedToSi) {
  EXPECT_DOUBLE_EQ(value("5 mm", Dimension::length), 0.005);
  EXPECT_DOUBLE_EQ(value("5cm", Dimension::length), 0.05);
  EXPECT_DOUBLE_EQ(value("2 in", Dimension::length), 0.0508);
  EXPECT_DOUBLE_EQ(value("-1.5e1 ft", Dimension::length), -4.572);
  EXPECT_DOUBLE_EQ(value("20 MPa", Dimension::pressure), 20e6);
  EXPECT_DOUBLE_EQ(value("3 N/mm^2", Dimension::pressure), 3e6);
  EXPECT_DOUBLE_EQ(value("7200 kg/m^3", Dimension::density), 7200);
  EXPECT_DOUBLE_EQ(value("7.2 g/cm3", Dimension::density), 7200);
  EXPECT_DOUBLE_EQ(value("0.8 kg", Dimension::mass), 0.8);
  EXPECT_DOUBLE_EQ(value("10 ms", Dimension::time), 0.01);
  EXPECT_DOUBLE_EQ(value("3 kN", Dimension::force), 3000);
  EXPECT_DOUBLE_EQ(value("2 N m", Dimension::moment), 2);
  EXPECT_DOUBLE_EQ(value("2 N*mm", Dimension::moment), 2e-3);
  EXPECT_DOUBLE_EQ(value("2 N·m", Dimension::moment), 2);
  EXPECT_DOUBLE_EQ(value("5 N/m", Dimension::force_per_length), 5);
  EXPECT_DOUBLE_EQ(value("72 km/h", Dimension::speed), 20);
  EXPECT_DOUBLE_EQ(value("9.81 m/s²", Dimension::acceleration), 9.81);
  EXPECT_DOUBLE_EQ(value("9.81 m s^-2", Dimension::acceleration), 9.81);
  EXPECT_DOUBLE_EQ(value("100 mm^4", Dimension::second_moment), 1e-10);
  EXPECT_DOUBLE_EQ(value("+3 µm", Dimension::length), 3e-6);
  EXPECT_DOUBLE_EQ(value("5 Nm", Dimension::moment), 5);
  EXPECT_DOUBLE_EQ(value("2 yd", Dimension::length), 1.8288);
  EXPECT_DOUBLE_EQ(value("100 kgf", Dimension::force), 980.665);
  EXPECT_DOUBLE_EQ(value("60 mph", Dimension::speed), 26.8224);
  EXPECT_DOUBLE_EQ(value("9 kn", Dimension::speed), 4.63);
  EXPECT_DOUBLE_EQ(value("12e-6 1/K", Dimension::thermal_expansion), 12e-6);
  EXPECT_DOUBLE_EQ(value("3 1/min", Dimension::rate), 0.05);
  EXPECT_NEAR(value("2 slug ft/s^2", Dimension::force), value("2 lbf", Dimension::force), 1e-14);
}

TEST(Quantity, AnAngleIsInDegreesUnlessItSaysOtherwise) {
  EXPECT_EQ(value("15 deg", Dimension::angle), 15);
  EXPECT_EQ(value("15°", Dimension::angle), 15);
  EXPECT_EQ(value("0.25 rev", Dimension::angle), 90);
  EXPECT_DOUBLE_EQ(value("0.5 rad", Dimension::angle), 90 / std::numbers::pi);
  EXPECT_EQ(default_unit(Dimension::angle), "degrees");
  EXPECT_NE(parse_quantity("1 grad", Dimension::angle).error.find("valid units: deg, rad, mrad, rev"),
            std::string::npos);
}

TEST(Quantity, TurnsPerTimeAreInRadiansPerSecond) {
  EXPECT_DOUBLE_EQ(value("30 rpm", Dimension::angular_speed), std::numbers::pi);
  EXPECT_DOUBLE_EQ(value("30 rev/min", Dimension::angular_speed), std::numbers::pi);
  EXPECT_DOUBLE_EQ(value("180 deg/s", Dimension::angular_speed), std::numbers::pi);
  EXPECT_DOUBLE_EQ(value("180 °/s", Dimension::angular_speed), std::numbers::pi);
}

TEST(Quantity, TheUnitsOfTheExamplesAreUnitsOfTheDimension) {
  for (int i = 1; i <= static_cast<int>(Dimension::angle); ++i) {
    const auto dimension = static_cast<Dimension>(i);
    std::stringstream examples(unit_examples(dimension));
    for (std::string unit; std::getline(examples >> std::ws, unit, ',');) value("2 " + unit, dimension);
  }
}

TEST(Quantity, TheUnitsAreThoseOfTheDocumentedTable) {
  std::ifstream page(test::source_directory() / "docs" / "case-file.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  for (int i = 1; i <= static_cast<int>(Dimension::angle); ++i) {
    const auto dimension = static_cast<Dimension>(i);
    const std::string row = "| " + dimension_name(dimension) + " | " + unit_examples(dimension) + " |";
    EXPECT_NE(text.find(row), std::string::npos) << row;
  }
}

TEST(Quantity, PoundsPerSquareInchAgreeWithTheirDefinition) {
  EXPECT_NEAR(value("1 psi", Dimension::pressure), 6894.757293168, 1e-8);  // NIST SP 811, B.8
  EXPECT_NEAR(value("1 lbf", Dimension::force), 4.4482216152605, 1e-13);
}

TEST(Quantity, AWrongDimensionNamesTheValidUnits) {
  const ParsedQuantity quantity = parse_quantity("5 kg", Dimension::length);
  EXPECT_FALSE(quantity.value);
  EXPECT_NE(quantity.error.find("m, mm, cm, km, um, in, ft"), std::string::npos) << quantity.error;
}

TEST(Quantity, AnUnknownUnitNamesTheClosestOne) {
  EXPECT_NE(parse_quantity("5 Mpa", Dimension::pressure).error.find("did you mean \"MPa\""),
            std::string::npos);
}

TEST(Quantity, AUnitIsNotTakenForOneOfSomethingElse) {
  const std::string plain = parse_quantity("15 deg", Dimension::number).error,
                    time = parse_quantity("15 dm", Dimension::time).error,
                    length = parse_quantity("15 deg", Dimension::length).error;
  EXPECT_NE(plain.find("has a unit; expected a plain number"), std::string::npos) << plain;
  EXPECT_EQ(length.find("did you mean"), std::string::npos) << length;
  EXPECT_NE(time.find("does not measure time"), std::string::npos) << time;
}

TEST(Quantity, TextsThatAreNoQuantityAreRefused) {
  for (const char* text : {"", "mm", "5", "nan mm", "inf mm", "1e999 mm", "5 mm/", "5 mm^0", "5 mm^",
                           "5 mm mm", "5 / / mm", "5 m-m", "five mm", "1e308 km", "1e-323 nm",
                           "1e200 km^100 m^-99", "5 mm, 3 mm", "0x5 m", "5 mm^99999999999"}) {
    const ParsedQuantity quantity = parse_quantity(text, Dimension::length);
    EXPECT_FALSE(quantity.value) << text;
    EXPECT_NE(quantity.error, "") << text;
  }
}

TEST(Quantity, AValueThatIsNotFiniteInSiUnitsSaysSo) {
  EXPECT_NE(parse_quantity("1e308 t", Dimension::mass).error.find("too large for a number in kg"),
            std::string::npos);
}

TEST(Quantity, WithAWrongUnitNamesTheNearestAndTheListOnce) {
  const std::string wrong = parse_quantity("6 mn", Dimension::length).error;
  EXPECT_NE(wrong.find("did you mean \"mm\"?"), std::string::npos) << wrong;
  EXPECT_EQ(wrong.find("km"), wrong.rfind("km")) << wrong;
}

TEST(Quantity, OfADifferenceOfTemperaturesIsNoTemperature) {
  for (const char* text : {"40 C", "40 degC", "40 °C", "104 degF"}) {
    const std::string wrong = parse_quantity(text, Dimension::temperature).error;
    EXPECT_NE(wrong.find("\"20 K\" of a beam that was made at 20 degrees and is at 40"), std::string::npos)
        << wrong;
  }
}

}  // namespace
}  // namespace nurbeam
