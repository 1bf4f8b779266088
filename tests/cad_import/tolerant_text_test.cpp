// What CAD systems read in spite of it: packed files, edition 3, stray commas, marks and bytes.

#include "cad_import/files/tolerant_text.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>

#include "cad_import/import_curves.h"
#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/drawing_text_of.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/imported_text.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_text_of.h"

namespace nurbeam {
namespace {

const std::string circle =
    step_text_of("#100", "#100 = CIRCLE('rim, (1,) /* no comment */ ; DATA;',#11,1.);");

void expect_the_circle(const std::string& text) {
  const ImportReport report = import_text(text);
  EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics[0].message;
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_EQ(report.curves[0].name, "rim, (1,) /* no comment */ ; DATA;");
}

TEST(TolerantText, LeavesWhatNeedsNothingAsItIs) {
  EXPECT_EQ(tolerant_text(circle), circle);
  const std::string iges = iges_text_of({{110, "110,0.,0.,0.,1.,0.,0.;"}});
  EXPECT_EQ(tolerant_text(iges), iges);
  for (const char* name : {"ideas-dm1.stp", "inventor-issue153.stp", "iges-126-bsplines.igs"})
    EXPECT_TRUE(tolerant_text(content_of(corpus_file(name))) == content_of(corpus_file(name))) << name;
}

TEST(TolerantText, AByteOrderMarkAndTrailingCommasAreNoHindrance) {
  expect_the_circle("\xEF\xBB\xBF" + circle);
  expect_the_circle(with(circle, "(#100)", "(#100, )"));
}

TEST(TolerantText, RealsWithoutPointOrWithASmallEAreReals) {
  const auto ends_of = [](const std::string& first, const std::string& last, const std::string& unit) {
    const ImportReport report =
        import_text(step_text_of("#100",
                                 "#100 = POLYLINE('1e3 (2e-3)',(#200,#201));\n#200 = CARTESIAN_POINT('',(" +
                                     first + "));\n#201 = CARTESIAN_POINT('',(" + last + "));\n",
                                 "", with(inches, "25.4", unit)));
    EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics[0].message;
    EXPECT_EQ(report.curves.at(0).name, "1e3 (2e-3)");
    return std::pair(start_of(report.curves[0].curve), end_of(report.curves[0].curve));
  };
  for (const char* unit : {"25.", "25", "2.5e1", "25E0"}) {
    const auto [start, end] = ends_of("1e-1,-2E+1,+.5", "4,-20.0e0,5.E-1", unit);
    EXPECT_LE((start / 0.025 - Eigen::Vector3d(0.1, -20, 0.5)).norm(), 1e-14) << unit;
    EXPECT_LE((end / 0.025 - Eigen::Vector3d(4, -20, 0.5)).norm(), 1e-14) << unit;
  }
  const ImportReport piece = import_text(step_text_of(
      "#100",
      "#100 = TRIMMED_CURVE('',#101,(PARAMETER_VALUE(1)),(PARAMETER_VALUE(3)),.T.,.PARAMETER.);\n"
      "#101 = CIRCLE('',#11,2);\n"));
  ASSERT_EQ(piece.curves.size(), 1U);
  EXPECT_NEAR(length(piece.curves[0].curve), 2 * (3 - 1) * 1e-3, 1e-15);
}

TEST(TolerantText, TheSectionsOfEditionThreeAreRead) {
  expect_the_circle(with(circle, "ENDSEC;\nDATA;",
                         "ENDSEC;\nANCHOR;\n<a> = #100;\nENDSEC;\nREFERENCE;\n#900 = <x.stp#b>;\nENDSEC;\n"
                         "DATA('one',('AUTOMOTIVE_DESIGN'));"));
  expect_the_circle(with(circle, "#100 = CIRCLE", "ENDSEC;\n/* more */\nDATA ;\n#100 = CIRCLE"));
  expect_the_circle(circle + "SIGNATURE;\nTUlJ\nENDSEC;\n");
}

TEST(TolerantText, ComplexInstancesOfSplinesWithoutWeightsAreRead) {
  const std::string points =
      "#200 = CARTESIAN_POINT('',(0.,0.,0.));\n#201 = CARTESIAN_POINT('',(1.,2.,0.));\n"
      "#202 = CARTESIAN_POINT('',(3.,2.,0.));\n#203 = CARTESIAN_POINT('',(4.,0.,0.));\n";
  const auto spline = [](const std::string& leaf) {
    return "( " + leaf +
           " BOUNDED_CURVE() B_SPLINE_CURVE(3,(#200,#201,#202,#203),.UNSPECIFIED.,.F.,.F.) CURVE() "
           "GEOMETRIC_REPRESENTATION_ITEM() REPRESENTATION_ITEM('it''s (odd)') )";
  };
  for (const char* leaf : {"BEZIER_CURVE()", "QUASI_UNIFORM_CURVE()",
                           "B_SPLINE_CURVE_WITH_KNOTS((4,4),(0.,1.),.UNSPECIFIED.)"}) {
    const ImportReport report = import_text(step_text_of("#100", "#100 = " + spline(leaf) + ";\n" + points));
    ASSERT_EQ(report.curves.size(), 1U) << leaf;
    EXPECT_TRUE(report.diagnostics.empty());
    EXPECT_EQ(report.curves[0].name, "it's (odd)");
    EXPECT_LE((report.curves[0].curve.point(0.5) - Eigen::Vector3d(2e-3, 1.5e-3, 0)).norm(), 1e-18) << leaf;
  }
  const std::string unknown = spline("ANY_CURVE()");
  EXPECT_NE(tolerant_text(step_text_of("#100", "#100 = " + unknown + ";\n" + points)).find(unknown),
            std::string::npos);
}

TEST(TolerantText, ThePartsOfComplexInstancesMayStandInAnyOrder) {
  const std::string inch_parts = "( NAMED_UNIT(#33) LENGTH_UNIT() CONVERSION_BASED_UNIT('INCH (''US)',#31) )";
  const std::string text = step_text_of("#100", "#100 = CIRCLE('',#11,1.);", "",
                                        with(inches,
                                             "( CONVERSION_BASED_UNIT('INCH',#31) LENGTH_UNIT() "
                                             "NAMED_UNIT(#33) )",
                                             inch_parts));
  const ImportReport report = import_text(
      with(text,
           "( GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#30))\n"
           "GLOBAL_UNIT_ASSIGNED_CONTEXT((#27,#28,#29)) REPRESENTATION_CONTEXT('','3D') )",
           "( REPRESENTATION_CONTEXT('','3D') GEOMETRIC_REPRESENTATION_CONTEXT(3)\n"
           "GLOBAL_UNIT_ASSIGNED_CONTEXT((#27,#28,#29)) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#30)) )"));
  EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics[0].message;
  EXPECT_EQ(report.unit, "inch");
  EXPECT_DOUBLE_EQ(report.unit_in_metres, 0.0254);
}

TEST(TolerantText, BytesThatAreNoUtf8AreLatin1) {
  EXPECT_EQ(as_utf8("Tr\xE4ger"), "Tr\xC3\xA4ger");
  EXPECT_EQ(as_utf8("Tr\xC3\xA4ger"), "Tr\xC3\xA4ger");
  EXPECT_EQ(import_text(step_text_of("#100", "#100 = CIRCLE('Tr\xE4ger',#11,1.);")).curves.at(0).name,
            "Tr\xC3\xA4ger");
  const std::string labelled =
      iges_text_of({{.type = 110, .parameters = "110,0.,0.,0.,1.,0.,0.;", .label = "Tr\xE4ger"}});
  EXPECT_EQ(import_text(labelled).curves.at(0).name, "Tr\xC3\xA4ger");
}

TEST(TolerantText, IgesWithoutLineEndsIsRead) {
  std::string text = iges_text_of({{110, "110,0.,0.,0.,1.,0.,0.;"}});
  std::erase(text, '\n');
  EXPECT_EQ(import_text(text).curves.size(), 1U);
  EXPECT_EQ(import_text("\xEF\xBB\xBF" + iges_text_of({{110, "110,0.,0.,0.,1.,0.,0.;"}})).curves.size(), 1U);
}

std::string deflated(const std::string& text, int window_bits) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, text.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// An archive of one file, "a.step", without the directory at its end.
std::string zipped(const std::string& text, bool deflate) {
  const std::string data = deflate ? deflated(text, -15) : text;
  const auto little_endian = [](std::size_t value, int count) {
    std::string bytes;
    for (int i = 0; i < count; ++i, value >>= 8) bytes += static_cast<char>(value & 0xFF);
    return bytes;
  };
  return "PK\x03\x04" + little_endian(20, 2) + little_endian(0, 2) + little_endian(deflate ? 8 : 0, 2) +
         little_endian(0, 8) + little_endian(data.size(), 4) + little_endian(text.size(), 4) +
         little_endian(6, 2) + little_endian(0, 2) + "a.step" + data;
}

TEST(TolerantText, PackedFilesAreUnpacked) {
  const std::string packed = deflated(circle, 15 + 16);
  EXPECT_LT(packed.size(), circle.size());
  expect_the_circle(packed);
  expect_the_circle(zipped(circle, true));
  expect_the_circle(zipped(circle, false));
}

/// In UTF-16, the lower byte first or last.
std::string in_utf16(const std::string& text, bool little, bool with_mark) {
  std::string bytes;
  const auto add = [&](unsigned unit) {
    const char low = static_cast<char>(unit & 0xFF), high = static_cast<char>(unit >> 8);
    bytes += little ? low : high;
    bytes += little ? high : low;
  };
  if (with_mark) add(0xFEFF);
  for (const char c : text) add(static_cast<unsigned char>(c));
  return bytes;
}

TEST(TolerantText, Utf16IsRead) {
  for (const bool little : {true, false})
    for (const bool with_mark : {true, false}) expect_the_circle(in_utf16(circle, little, with_mark));
}

TEST(TolerantText, LinesMayEndInCarriageReturnsAlone) {
  std::string step = circle;
  std::replace(step.begin(), step.end(), '\n', '\r');
  expect_the_circle(step);
  std::string drawing =
      drawing_of("0 LINE 8 x 10 0.0 20 0.0 30 0.0 11 3.0 21 4.0 31 0.0", "9 $INSUNITS 70 4");
  std::replace(drawing.begin(), drawing.end(), '\n', '\r');
  const ImportReport report = import_drawing(drawing);
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_NEAR(length(report.curves[0].curve), 0.005, 1e-15);
}

TEST(TolerantText, SmallKeywordsAreRead) {
  std::string text = circle;
  bool quoted = false;
  for (char& c : text) {
    quoted ^= c == '\'';
    if (!quoted) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  expect_the_circle(text);
}

/// An archive of stored files, with a central directory.
std::string archive_of(const std::vector<std::pair<std::string, std::string>>& files) {
  const auto little_endian = [](std::size_t value, int count) {
    std::string bytes;
    for (int i = 0; i < count; ++i, value >>= 8) bytes += static_cast<char>(value & 0xFF);
    return bytes;
  };
  std::string archive, directory;
  for (const auto& [name, content] : files) {
    const std::string sizes = little_endian(content.size(), 4) + little_endian(content.size(), 4);
    const std::string lengths = little_endian(name.size(), 2) + little_endian(0, 2);
    directory += "PK\x01\x02" + little_endian(20, 2) + little_endian(20, 2) + little_endian(0, 12) + sizes +
                 lengths + little_endian(0, 10) + little_endian(archive.size(), 4) + name;
    archive += "PK\x03\x04" + little_endian(20, 2) + little_endian(0, 12) + sizes + lengths + name + content;
  }
  const std::size_t begin = archive.size();
  return archive + directory + "PK\x05\x06" + little_endian(0, 4) + little_endian(files.size(), 2) +
         little_endian(files.size(), 2) + little_endian(directory.size(), 4) + little_endian(begin, 4) +
         little_endian(0, 2);
}

TEST(TolerantText, TheCadFileOfAnArchiveIsReadWhereverItStands) {
  expect_the_circle(archive_of({{"a/", ""}, {"readme.txt", "hello"}, {"a/x.step", circle}}));
  expect_the_circle(archive_of({{"readme.txt", "hello"}, {"drawing", circle}}));
}

TEST(TolerantText, DamagedAndMonstrousPackedFilesAreRefused) {
  const std::string gzip = deflated(circle, 15 + 16), zip = zipped(circle, true);
  for (const std::string& damaged :
       {gzip.substr(0, gzip.size() / 2), zip.substr(0, zip.size() / 2), zip.substr(0, 20),
        gzip.substr(0, 12) + "xxxxxxxxxx" + gzip.substr(22), zipped(circle, false).substr(0, 200)}) {
    const ImportReport report = import_text(damaged);
    EXPECT_FALSE(report.ok());
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_NE(report.diagnostics[0].message.find("unpack it by hand"), std::string::npos)
        << report.diagnostics[0].message;
  }
  std::string bomb = deflated(std::string(std::size_t{600} << 20, ' '), 15 + 16);
  EXPECT_LT(bomb.size(), std::size_t{1} << 20);
  const ScratchDirectory scratch;
  constexpr std::chrono::seconds patience{600};  // of a machine that has much else to do
  const ImportReport report = import_curves(scratch.file("bomb.step", bomb), {.time_limit = patience});
  EXPECT_NE(report.diagnostics.at(0).message.find("more than 512 MiB"), std::string::npos)
      << report.diagnostics[0].message;
}

TEST(TolerantText, AbsurdCoordinatesAreRefusedAtOnce) {
  const ImportReport report =
      import_text(with(circle, "CARTESIAN_POINT('',(0.,0.,0.))", "CARTESIAN_POINT('',(0.,1.E200,0.))"));
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.diagnostics.at(0).message.find("1e+200"), std::string::npos)
      << report.diagnostics[0].message;
}

}  // namespace
}  // namespace nurbeam
