#include "cad_import/iges/iges_global.h"

#include <gtest/gtest.h>

#include "tests/cad_import/scratch_directory.h"

namespace nurbeam {
namespace {

// The text in lines of 72 columns of a Global section.
std::string global_section(std::string text) {
  text.resize((text.size() + 71) / 72 * 72, ' ');
  std::string lines;
  for (std::size_t at = 0; at < text.size(); at += 72) lines += text.substr(at, 72) + "G      1\n";
  return lines;
}

std::string with_unit(const std::string& unit) {
  return global_section("1H,,1H;,1Hp,1Hf,1Hs,1Hv,32,38,6,308,15,1Hr,1.," + unit +
                        ",1,0.01,15H20240101.000000,1E-6,0.,,,11,0,,;");
}

std::string failure_of(const std::string& content) {
  try {
    parse_iges_global(content);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(IgesGlobal, UnitFlagsHaveTheLengthsOfTheStandard) {
  EXPECT_EQ(parse_iges_global(with_unit("1,4HINCH")).unit_in_metres, 0.0254);
  EXPECT_EQ(parse_iges_global(with_unit("2,2HMM")).unit_in_metres, 1e-3);
  EXPECT_EQ(parse_iges_global(with_unit("4,2HFT")).unit_in_metres, 0.3048);
  EXPECT_EQ(parse_iges_global(with_unit("6,1HM")).unit_in_metres, 1);
  EXPECT_EQ(parse_iges_global(with_unit("10,2HCM")).unit_in_metres, 1e-2);
}

TEST(IgesGlobal, FlagThreeTakesTheUnitFromItsName) {
  EXPECT_EQ(parse_iges_global(with_unit("3,2HCM")).unit_in_metres, 1e-2);
  EXPECT_NE(failure_of(with_unit("3,5HCUBIT")).find("CUBIT"), std::string::npos);
}

TEST(IgesGlobal, AFlagAndANameThatDisagreeAreAnError) {
  const std::string message = failure_of(with_unit("2,4HINCH"));
  EXPECT_NE(message.find("parameter 15"), std::string::npos) << message;
  EXPECT_NE(message.find("MM"), std::string::npos) << message;
  EXPECT_NE(message.find("INCH"), std::string::npos) << message;
  EXPECT_EQ(parse_iges_global(with_unit("2,10HMILLIMETRE")).unit_in_metres, 1e-3);  // a name of no standard
  EXPECT_EQ(parse_iges_global(with_unit("1,2HIN")).unit_in_metres, 0.0254);
}

TEST(IgesGlobal, AMissingUnitIsTheInchOfTheStandard) {
  EXPECT_EQ(parse_iges_global(with_unit(",")).unit_in_metres, 0.0254);
}

TEST(IgesGlobal, DefaultAndUnusualDelimitersAreUnderstood) {
  const std::string defaults = ",,1Hp,1Hf,1Hs,1Hv,32,38,6,308,15,1Hr,2.,2,2HMM,;";
  EXPECT_EQ(parse_iges_global(global_section(defaults)).unit_flag, 2);
  EXPECT_EQ(parse_iges_global(global_section(defaults)).scale, 2);
  const std::string unusual = "1H/1H/1H#/1Hp/1Hf/1Hs/1Hv/32/38/6/308/15/1Hr/1.D0/2/2HMM/#";
  EXPECT_EQ(parse_iges_global(global_section(with(unusual, "1H/1H/1H#", "1H//1H#"))).unit_flag, 2);
}

TEST(IgesGlobal, HollerithStringsMayHoldDelimitersAndCrossLines) {
  const std::string name = "a,b;c" + std::string(80, 'x');
  const std::string text = "1H,,1H;,1Hp," + std::to_string(name.size()) + "H" + name +
                           ",1Hs,1Hv,32,38,6,308,15,1Hr,1.,6,1HM,1,0.01;";
  EXPECT_EQ(parse_iges_global(global_section(text)).unit_in_metres, 1);
}

TEST(IgesGlobal, AWrongHollerithCountIsNamedWithItsParameter) {
  const std::string message = failure_of(with(with_unit("2,2HMM"), "1Hs", "2Hs"));
  EXPECT_NE(message.find("parameter 5"), std::string::npos) << message;
  EXPECT_NE(message.find("Hollerith"), std::string::npos) << message;
}

TEST(IgesGlobal, AFileWithoutAGlobalSectionIsRefused) {
  EXPECT_NE(failure_of("nothing").find("Global section"), std::string::npos);
}

}  // namespace
}  // namespace nurbeam
