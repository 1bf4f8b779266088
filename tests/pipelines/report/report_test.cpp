#include "pipelines/report/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "pipelines/command/command_line.h"
#include "pipelines/report/report_template.h"
#include "pipelines/results/results.h"
#include "tests/pipelines/case_text.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

using test::TemporaryDirectory;

/// Written beside pipelines/report/report.cpp's encoder and not from it: RFC 4648 read backwards.
template <class Number>
std::vector<Number> decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<unsigned char>(bits >> count & 0xff));
    }
  }
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

std::string between(const std::string& text, const std::string& start, const std::string& end) {
  const std::size_t from = text.find(start);
  if (from == std::string::npos) return {};
  return text.substr(from + start.size(), text.find(end, from) - from - start.size());
}

struct Page {
  std::string text;

  nlohmann::json data() const {
    return nlohmann::json::parse(between(text, R"(<script type="application/json" id="data">)", "</script>"));
  }
  std::string shapes() const {
    return between(text, R"(<script type="text/plain" id="shapes">)", "</script>");
  }
  std::vector<double> column(const std::string& of, const std::string& name) const {
    const nlohmann::json all = data();
    for (std::size_t i = 0; i < all["columns"].size(); ++i)
      if (all["columns"][i]["of"] == of && all["columns"][i]["name"] == name)
        return decoded<double>(all["values"][i]);
    return {};
  }
};

/// Snapshot i of a beam of i + 1 elements about (1e6, 0, 0) and a body that has left it in the last frame.
Snapshot frame_of(std::size_t i, std::size_t count) {
  Snapshot frame;
  frame.time = 0.1 * static_cast<double>(i);
  frame.energy.total = 1.0 / 3 + frame.time;
  frame.bodies = {{{Eigen::Vector3d(1e6, frame.time, 0), Eigen::Vector3d::Zero()},
                   i + 1 < count ? std::optional(std::sqrt(2) + frame.time) : std::nullopt,
                   Eigen::Vector3d(1, 2, 3)}};
  BeamRecord beam;
  beam.length = std::numbers::pi;
  for (std::size_t e = 0; e <= i; ++e) {
    const double x = 1e6 + static_cast<double>(e);
    ElementRecord element;
    element.control_points << x, x + 0.25, x + 0.5, x + 1, Eigen::RowVector4d(0, 1, 2, 3),
        Eigen::RowVector4d::Zero(), Eigen::RowVector4d::Ones();
    element.strain = Eigen::Vector4d(-1, 0, 0, frame.time);
    element.curvature = element.axial_force = element.bending_moment = Eigen::Vector4d::Zero();
    element.velocity = Eigen::Matrix<double, 3, 4>::Constant(2);
    beam.elements.push_back(element);
  }
  frame.beams = {beam};
  return frame;
}

ReportFrames frames_of(std::size_t count, const std::string& title = "title") {
  ReportFrames frames{title, {{}, {"bead"}, {"beam"}}, {}, {}};
  for (std::size_t i = 0; i < count; ++i) frames.times.push_back(0.1 * static_cast<double>(i));
  frames.read = [count](std::size_t first, std::size_t piece) {
    std::vector<Snapshot> read;
    for (std::size_t i = first; i < first + piece; ++i) read.push_back(frame_of(i, count));
    return read;
  };
  return frames;
}

Page page_of(const ReportFrames& frames, const std::string& run_json = "{}",
             std::size_t most_bytes = 1'000'000) {
  std::ostringstream stream;
  write_report_page(stream, frames, run_json, most_bytes);
  return {stream.str()};
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Of the file's data, as the page shows them; in results of earlier versions the ends are not known.
TEST(Report, HoldsTheEndsOfConnectors) {
  for (const bool known : {true, false}) {
    ReportFrames frames = frames_of(3);
    frames.names.connectors = {"dropper"};
    frames.read = [known](std::size_t first, std::size_t piece) {
      std::vector<Snapshot> read;
      for (std::size_t i = first; i < first + piece; ++i) {
        read.push_back(frame_of(i, 3));
        read.back().connectors = {{.length = 1, .force = 2}};
        if (known) {
          read.back().connectors[0].from = {1e6, 0, 7};
          read.back().connectors[0].to = {1e6, 0, 8 + read.back().time};
        }
      }
      return read;
    };
    const Page page = page_of(frames);
    const std::vector<double> top = page.column("connector", "to_position.z");
    ASSERT_EQ(top.size(), 3);
    for (std::size_t i = 0; i < 3; ++i)
      if (known)
        EXPECT_EQ(top[i], 8 + frame_of(i, 3).time);
      else
        EXPECT_TRUE(std::isnan(top[i]));
    EXPECT_EQ(page.data()["box"][1][2],
              known ? nlohmann::json(8 + frame_of(2, 3).time) : nlohmann::json(0.0));
    EXPECT_EQ(page.data()["names"]["connectors"][0], "dropper");
  }
}

TEST(Report, LeavesOutWhatIsNothingAlongARigidGuide) {
  const auto has = [](const char* name, bool rigid) {
    ReportFrames frames = frames_of(1);
    frames.read = [](std::size_t, std::size_t) {
      std::vector<Snapshot> read = {frame_of(0, 1)};
      read[0].beams[0].elements[0].strain.setZero();
      return read;
    };
    const nlohmann::json run = {{"model", {{"beams", {{{"rigid", rigid}}}}}}};
    const nlohmann::json fields = page_of(frames, run.dump()).data()["shapes"]["fields"];
    return std::any_of(fields.begin(), fields.end(),
                       [&](const nlohmann::json& f) { return f["name"] == name; });
  };
  EXPECT_TRUE(has("strain", false));
  EXPECT_FALSE(has("strain", true));
  EXPECT_TRUE(has("curvature", true));  // there is always one to colour by
}

TEST(Report, HoldsHistoriesToTheLastBit) {
  const Page page = page_of(frames_of(40));
  const std::vector<double> total = page.column("energy", "total"), s = page.column("body", "s");
  ASSERT_EQ(total.size(), 40);
  EXPECT_EQ(total[39], frame_of(39, 40).energy.total);
  EXPECT_EQ(s[38], *frame_of(38, 40).bodies[0].s);
  EXPECT_TRUE(std::isnan(s[39]));
  EXPECT_EQ(page.column("body", "joint_force.z"), std::vector<double>(40, 3.0));
  EXPECT_EQ(page.column("beam", "length")[7], std::numbers::pi);
}

TEST(Report, HoldsShapesFarFromTheOriginToAFloatOfTheirOwnSize) {
  const Page page = page_of(frames_of(2));
  const nlohmann::json shapes = page.data()["shapes"];
  EXPECT_FALSE(shapes["rational"]);
  EXPECT_EQ(decoded<std::uint32_t>(shapes["element_counts"]), (std::vector<std::uint32_t>{1, 2}));
  // Box 1e6 <= x <= 1e6 + 2, 0 <= y <= 3. The first frame: four points, two places s, then eight
  // fields: their ranges, and four bytes each.
  EXPECT_EQ(shapes["origin"], nlohmann::json({1e6 + 1, 1.5, 0.0}));
  const std::size_t first_frame = (4 * 3 * 4 + 2 * 4 + 8 * (8 + 4) + 2) / 3 * 4;
  const std::vector<float> points = decoded<float>(page.shapes().substr(0, first_frame));
  EXPECT_EQ(std::vector<float>(points.begin(), points.begin() + 12),
            (std::vector<float>{-1, -1.5, 0, -0.75, -0.5, 0, -0.5, 0.5, 0, 0, 1.5, 0}));
  // The second has seven: neighbours share one.
  const std::string second = page.shapes().substr(first_frame);
  EXPECT_EQ(second.size(), (7 * 3 * 4 + 3 * 4 + 8 * (8 + 2 * 4) + 2) / 3 * 4);
  const std::vector<unsigned char> bytes = decoded<unsigned char>(second);
  // Strain goes from -1 to 0.1 in the second frame: -1, 0, 0 and 0.1 of each element as parts of 255.
  float range[2];
  std::memcpy(range, bytes.data() + 96, sizeof range);
  EXPECT_EQ(range[0], -1.0F);
  EXPECT_EQ(range[1], 0.1F);
  const std::vector<unsigned char> strain(bytes.begin() + 160, bytes.begin() + 168);
  EXPECT_EQ(strain, (std::vector<unsigned char>{0, 232, 232, 255, 0, 232, 232, 255}));
  EXPECT_EQ(shapes["fields"][0]["min"], -1);
  EXPECT_EQ(shapes["fields"][0]["max"], 0.1);
  EXPECT_NEAR(shapes["fields"][6]["max"].get<double>(), std::sqrt(12), 1e-15);
}

TEST(Report, HoldsFewerFramesWhereTheyWouldBeTooMuchAndAlwaysTheLast) {
  const ReportFrames frames = frames_of(40);
  const std::size_t all = page_of(frames).shapes().size();
  const Page page = page_of(frames, "{}", 20000);
  EXPECT_EQ(page.data()["stored_frames"], 40);
  const std::vector<double> times = page.column("run", "time");
  ASSERT_GT(times.size(), 5);
  EXPECT_LT(times.size(), 30);
  EXPECT_EQ(times.front(), 0);
  EXPECT_EQ(times.back(), frames.times.back());
  for (std::size_t i = 2; i + 1 < times.size(); ++i)
    EXPECT_NEAR(times[i] - times[i - 1], times[1] - times[0], 1e-12);
  EXPECT_LT(page.shapes().size(), all / 2);
}

TEST(Report, KeepsTheWeightsOfRationalSegments) {
  ReportFrames frames = frames_of(1);
  frames.read = [](std::size_t, std::size_t) {
    Snapshot frame = frame_of(0, 2);
    frame.beams[0].elements[0].control_points.col(1) *= 0.5;  // the same points
    return std::vector<Snapshot>{frame};
  };
  const Page page = page_of(frames);
  EXPECT_TRUE(page.data()["shapes"]["rational"]);
  const std::vector<float> numbers = decoded<float>(page.shapes());
  EXPECT_EQ(std::vector<float>(numbers.begin() + 12, numbers.begin() + 16),
            (std::vector<float>{1, 0.5, 1, 1}));
  EXPECT_EQ(numbers[3], -0.25);
}

TEST(Report, TextOfTheUserEndsNoElement) {
  const std::string hostile = "</title></script><script>alert(1)</script>&amp;<!--";
  ReportFrames frames = frames_of(1, hostile);
  frames.names.beams = {hostile};
  const Page page = page_of(frames, nlohmann::json({{"status", hostile}}).dump());
  EXPECT_EQ(page.data()["title"], hostile);
  EXPECT_EQ(page.data()["names"]["beams"][0], hostile);
  EXPECT_EQ(page.data()["run"]["status"], hostile);
  EXPECT_EQ(page.text.find("<script>alert"), std::string::npos);
  EXPECT_EQ(between(page.text, "<title>", "</title>"),
            "&lt;/title>&lt;/script>&lt;script>alert(1)&lt;/script>&amp;amp;&lt;!--");
}

TEST(Report, RefusesASummaryThatIsNoObjectAndARunWithoutFrames) {
  EXPECT_THROW(page_of(frames_of(1), "[]"), std::invalid_argument);
  EXPECT_THROW(page_of(frames_of(1), "{"), std::invalid_argument);
  EXPECT_THROW(page_of(frames_of(0)), std::invalid_argument);
}

TEST(Report, TheProgramHoldsTheCommittedPage) {
  const std::string committed = text_of(test::source_directory() / "pipelines/report/dist/report.html");
  EXPECT_FALSE(committed.empty());
  EXPECT_TRUE(report_template == committed);
  for (const std::string marker : {"{{title}}", "{{data}}"}) {
    const std::size_t at = committed.find(marker);
    EXPECT_NE(at, std::string::npos);
    EXPECT_EQ(committed.find(marker, at + 1), std::string::npos);
  }
}

struct ReportOutcome {
  int code;
  std::string err;
};

ReportOutcome report(const std::filesystem::path& directory) {
  std::ostringstream out, err;
  const int code = run_command_line({"report", directory.string()}, out, err);
  return {code, err.str()};
}

TEST(ReportCommand, ADirectoryWithoutResultsEndsWithTwoAndTheNameOfWhatIsMissing) {
  const TemporaryDirectory directory;
  const ReportOutcome empty = report(directory.path());
  EXPECT_EQ(empty.code, 2);
  EXPECT_NE(empty.err.find((directory.path() / "run.json").string()), std::string::npos) << empty.err;
  EXPECT_NE(empty.err.find("nurbeam run"), std::string::npos) << empty.err;
  directory.write("run.json", "{}");
  const ReportOutcome half = report(directory.path());
  EXPECT_EQ(half.code, 2);
  EXPECT_NE(half.err.find("results.nc"), std::string::npos) << half.err;
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "report.html"));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "report.html.part"));
  EXPECT_EQ(report(directory.path() / "absent").code, 2);
}

TEST(ReportCommand, ABadSummaryEndsWithTwoAndLeavesTheFormerReport) {
  const TemporaryDirectory directory;
  ResultsWriter results(directory.path(), {{}, {"bead"}, {"beam"}}, "title");
  results.write(frame_of(0, 1));
  results.finish();
  directory.write("report.html", "former");
  directory.write("run.json", "no JSON");
  const ReportOutcome outcome = report(directory.path());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("run.json"), std::string::npos) << outcome.err;
  EXPECT_EQ(text_of(directory.path() / "report.html"), "former");
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "report.html.part"));
}

TEST(ReportCommand, SaysWhyAPageCannotBeWritten) {
  const TemporaryDirectory directory;
  ResultsWriter results(directory.path(), {{}, {"bead"}, {"beam"}}, "title");
  results.write(frame_of(0, 1));
  results.finish();
  directory.write("run.json", "{}");
  std::filesystem::create_directories(directory.path() / "report.html.part");
  const ReportOutcome outcome = report(directory.path());
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("report.html: cannot be written: Is a directory"), std::string::npos)
      << outcome.err;
}

TEST(ReportCommand, WritesAgainWhatTheRunHasWritten) {
  const TemporaryDirectory directory;
  const auto file = directory.write("case.json", test::smallest_case);
  const auto results = directory.path() / "results";
  std::ostringstream out, err;
  const std::vector<std::string> run = {
      "run", file.string(), "--quiet", "--out", results.string(), "--set", "analysis.end_time=0.01"};
  ASSERT_EQ(run_command_line(run, out, err), 0) << err.str();
  const std::string first = text_of(results / "report.html");
  ASSERT_FALSE(first.empty());
  std::filesystem::remove(results / "report.html");
  EXPECT_EQ(report(results).code, 0);
  EXPECT_TRUE(text_of(results / "report.html") == first);

  std::vector<std::string> without = run;
  without.insert(without.end(), {"--set", "output.report=false"});
  ASSERT_EQ(run_command_line(without, out, err), 0) << err.str();
  EXPECT_FALSE(std::filesystem::exists(results / "report.html"));
}

TEST(ModelSummary, TellsWhereTheModelStandsInTheWorld) {
  // A planar cantilever in the plane y = 7, far from the origin, with its own local frame.
  const TemporaryDirectory directory;
  const auto file = directory.write("case.json", R"({
    "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "beam", "axis": { "polyline": [[1000, 7, 3], [1000, 7, 5]] },
                "section": { "area": 1e-4, "second_moment": 1e-9 },
                "material": { "density": 1000, "youngs_modulus": 1e9 }, "elements": { "count": 3 } }],
    "bodies": [{ "name": "bead", "mass": 2 }],
    "supports": [{ "beam": "beam", "at": "start", "type": "clamped" },
                 { "beam": "beam", "at": "end", "type": "pinned" }],
    "sliding_joints": [{ "body": "bead", "beam": "beam", "at": { "length": 0.5 }, "at_beam_end": "stop" }],
    "loads": [{ "beam": "beam", "at": "end", "force": [1, 0, 0] }],
    "analysis": { "end_time": 0.01, "step": 0.01 } })");
  const auto results = directory.path() / "results";
  std::ostringstream out, err;
  ASSERT_EQ(run_command_line({"run", file.string(), "--quiet", "--out", results.string()}, out, err), 0)
      << err.str();
  const nlohmann::json model = nlohmann::json::parse(text_of(results / "run.json"))["model"];
  const auto expect_vector = [](const nlohmann::json& found, const Eigen::Vector3d& expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i].get<double>(), expected[i], 1e-12);
  };
  EXPECT_EQ(model["dimension"], 2);
  EXPECT_NEAR(std::abs(model["plane_normal"][1].get<double>()), 1, 1e-12);
  expect_vector(model["gravity [m/s^2]"], {0, 0, -9.81});
  const nlohmann::json& beam = model["beams"][0];
  EXPECT_NEAR(beam["length [m]"].get<double>(), 2, 1e-12);
  EXPECT_NEAR(beam["mass [kg]"].get<double>(), 0.2, 1e-12);
  EXPECT_EQ(beam["elements"], 3);
  EXPECT_NEAR(beam["EA [N]"].get<double>(), 1e5, 1e-6);
  EXPECT_NEAR(beam["EI [N m^2]"].get<double>(), 1, 1e-12);
  EXPECT_EQ(model["bodies"][0]["mass [kg]"], 2);
  EXPECT_EQ(model["supports"][0]["type"], "clamped");
  expect_vector(model["supports"][0]["position [m]"], {1000, 7, 3});
  expect_vector(model["supports"][0]["outward"], {0, 0, -1});
  EXPECT_EQ(model["supports"][1]["type"], "pinned");
  expect_vector(model["supports"][1]["position [m]"], {1000, 7, 5});
  expect_vector(model["supports"][1]["outward"], {0, 0, 1});
  EXPECT_EQ(beam["curve"], "beam");
  EXPECT_EQ(model["joints"][0]["at beam end"], "stops");
  EXPECT_EQ(model["joints"][0]["s at start [m]"], 0.5);
  expect_vector(model["loads"][0]["value"], {1, 0, 0});
}

}  // namespace
}  // namespace nurbeam
