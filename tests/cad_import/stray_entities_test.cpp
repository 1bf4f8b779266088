// DXF: what stands where nothing reads it is told.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cad_import/imported_text.h"

namespace nurbeam::stray_entities {
namespace {

// A lost or changed line can take an entity out of its section.
TEST(StrayEntities, AreTold) {
  const std::string line = "0 LINE 8 0 10 0 11 3 ", header = "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC ";
  const auto expect_told = [](const std::string& pairs, const std::string& words) {
    std::string text = pairs;
    std::replace(text.begin(), text.end(), ' ', '\n');
    const ImportReport report = import_text(text);
    ASSERT_EQ(report.curves.size(), 1U) << words;
    ASSERT_EQ(report.diagnostics.size(), 1U) << words;
    EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
    EXPECT_NE((report.diagnostics[0].where + report.diagnostics[0].message).find(words), std::string::npos)
        << report.diagnostics[0].message;
  };
  expect_told(header + "0 SECTION 2 ENTITIES " + line + "0 ENDSEC " + line + "0 EOF ",
              "LINE outside of sections");
  expect_told(header + "0 SECTION 2 ENTITIES " + line + "0 SECTION 8 0 10 1 0 ENDSEC 0 EOF ",
              "SECTION in section ENTITIES");
  expect_told(header + "0 SECTION 2 ENTITIES 4 LINE 8 0 10 0 11 5 " + line + "0 ENDSEC 0 EOF ",
              "values before the first entity of section ENTITIES");
  expect_told(
      header + "0 SECTION 2 ENTITLES " + line + "0 ENDSEC 0 SECTION 2 ENTITIES " + line + "0 ENDSEC 0 EOF ",
      "LINE in section ENTITLES");
  expect_told(
      header + "0 SECTION 2 BLOCKS " + line + "0 ENDSEC 0 SECTION 2 ENTITIES " + line + "0 ENDSEC 0 EOF ",
      "LINE outside of blocks");
  expect_told(
      header + "0 SECTION 2 ENTITIES " + line + "0 VERTEX 10 0 0 VERTEX 10 1 0 SEQEND 0 ENDSEC 0 EOF ",
      "no POLYLINE stands before it");
}

}  // namespace
}  // namespace nurbeam::stray_entities
