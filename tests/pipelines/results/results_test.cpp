#include "pipelines/results/results.h"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <algorithm>
#include <span>
#include <sstream>
#include <utility>

#include "tests/pipelines/case_text.h"
#include "tests/pipelines/frames.h"

namespace nurbeam {
namespace {

using test::expect_equal;
using test::TemporaryDirectory;

/// A frame of two beams, one probe and one body; all numbers differ and depend on `time`.
Snapshot make_frame(double time, int elements, bool body_has_left = false) {
  double next = time + 1.0 / 3;
  const auto number = [&] { return next += 0.1; };
  const auto vector = [&] { return Eigen::Vector3d(number(), number(), number()); };
  const auto point = [&] { return PointRecord{vector(), vector()}; };
  const auto beam = [&](int count) {
    BeamRecord record;
    for (int i = 0; i < count; ++i) {
      const auto four = [&] { return Eigen::Vector4d::NullaryExpr([&] { return number(); }).eval(); };
      ElementRecord element;
      element.control_points = Eigen::Matrix4d::NullaryExpr([&] { return number(); });
      element.s_start = number();
      element.s_end = number();
      element.strain = four();
      element.curvature = four();
      element.axial_force = four();
      element.axial_mismatch = four()[0];
      element.bending_moment = four();
      element.torque = four();
      element.shear_force = four();
      element.stress = four();
      element.velocity = Eigen::Matrix<double, 3, 4>::NullaryExpr([&] { return number(); });
      record.elements.push_back(element);
    }
    for (int i = 0; i <= count; ++i) {
      record.node_positions.push_back(vector());
      record.node_slopes.push_back(vector());
      record.node_s.push_back(number());
    }
    record.length = number();
    record.sag = number();
    for (Extreme* extreme : {&record.axial_force_min, &record.axial_force_max, &record.moment_max,
                             &record.shear_force_max, &record.stress_max, &record.displacement_max})
      *extreme = {number(), number()};
    return record;
  };
  Snapshot frame{};
  frame.time = time;
  frame.step = 1e-3;
  frame.newton_iterations = 7;
  for (int i = 0; i < elements; ++i) frame.steps.push_back({number(), number(), i, 2 * i});
  ProbeRecord probe;
  static_cast<PointRecord&>(probe) = point();
  probe.displacement = vector();
  probe.section = {0, 0, number(), number(), number(), number(), number()};
  frame.probes = {probe};
  frame.bodies = {{point(), number(), vector(), number()}};
  if (body_has_left) frame.bodies[0].s.reset();
  frame.beams = {beam(elements), beam(2)};
  frame.beams[1].stress_max = {};  // its section does not say
  frame.reactions = {{vector(), vector(), vector()}, {vector(), vector(), vector()}};
  frame.energy = {number(), number(), number(), number(), number(), number()};
  return frame;
}

const SnapshotNames names = {.probes = {"tip"},
                             .bodies = {"trolley"},
                             .beams = {"cable", "arch"},
                             .reactions = {"mast", "reaction.arch.end"}};

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(Results, HistoriesHaveTheColumnsOfTheContract) {
  const TemporaryDirectory directory;
  ResultsWriter writer(directory.path(), names, "title");
  writer.finish();
  EXPECT_EQ(
      lines_of(directory.path() / "histories.csv"),
      std::vector<std::string>{
          "time [s],tip.x [m],tip.y [m],tip.z [m],tip.vx [m/s],tip.vy [m/s],tip.vz [m/s],trolley.x [m],"
          "trolley.y [m],trolley.z [m],trolley.vx [m/s],trolley.vy [m/s],trolley.vz [m/s],trolley.s [m],"
          "cable.length [m],arch.length [m],energy.kinetic [J],energy.gravity [J],energy.axial [J],"
          "energy.bending [J],energy.dissipated [J],energy.total [J],energy.input [J],"
          "tip.ux [m],tip.uy [m],tip.uz [m],tip.axial_force [N],tip.moment [N m],tip.torque [N m],"
          "tip.shear_force [N],tip.stress [Pa],trolley.joint_force.x [N],trolley.joint_force.y [N],trolley.joint_force.z [N],"
          "trolley.holding_force [N],cable.axial_force.min [N],cable.axial_force.max [N],"
          "cable.moment.max [N m],cable.shear_force.max [N],cable.stress.max [Pa],"
          "cable.displacement.max [m],arch.axial_force.min [N],arch.axial_force.max [N],"
          "arch.moment.max [N m],arch.shear_force.max [N],arch.stress.max [Pa],arch.displacement.max [m],"
          "mast.fx [N],mast.fy [N],mast.fz [N],mast.mx [N m],mast.my [N m],mast.mz [N m],"
          "reaction.arch.end.fx [N],reaction.arch.end.fy [N],reaction.arch.end.fz [N],"
          "reaction.arch.end.mx [N m],reaction.arch.end.my [N m],reaction.arch.end.mz [N m],"
          "tip.speed [m/s],trolley.speed [m/s],cable.sag [m],arch.sag [m]"});
}

TEST(Results, HistoriesGiveEveryNumberBackExactly) {
  const TemporaryDirectory directory;
  ResultsWriter writer(directory.path(), names, "title");
  const Snapshot held = make_frame(0, 3), left = make_frame(0.1, 3, true);
  writer.write(held);
  writer.write(left);
  writer.finish();
  const auto lines = lines_of(directory.path() / "histories.csv");
  ASSERT_EQ(lines.size(), 3u);
  const auto first = cells_of(lines[1]), second = cells_of(lines[2]);
  ASSERT_EQ(first.size(), cells_of(lines[0]).size());
  ASSERT_EQ(second.size(), first.size());
  EXPECT_EQ(std::stod(second[0]), 0.1);
  EXPECT_EQ(std::stod(first[1]), held.probes[0].position.x());
  EXPECT_EQ(std::stod(first[12]), held.bodies[0].point.velocity.z());
  EXPECT_EQ(std::stod(first[13]), *held.bodies[0].s);
  EXPECT_EQ(second[13], "");
  EXPECT_EQ(std::stod(second[14]), left.beams[0].length);
  EXPECT_EQ(std::stod(first[21]), held.energy.total);
  EXPECT_EQ(std::stod(first[26]), held.probes[0].section.axial_force);
  EXPECT_EQ(std::stod(first[30]), held.probes[0].section.stress);
  EXPECT_EQ(first[45], "");  // arch.stress.max
  const auto last_reaction =
      first.end() - 5;  // speeds of the probe and the body, sags of two beams behind it
  EXPECT_EQ(std::stod(*last_reaction), held.reactions[1].couple.z());
  EXPECT_EQ(std::stod(*(last_reaction + 2)), held.bodies[0].point.velocity.norm());
  EXPECT_EQ(std::stod(first.back()), held.beams[1].sag);
}

TEST(Results, SectionsOfBeamsWithTorsionComeBackExactlyBehindAllOtherColumns) {
  const TemporaryDirectory directory;
  SnapshotNames with_sections = names;
  with_sections.sections = true;
  double next = 5;
  const auto number = [&] { return next += 0.1; };
  const auto vector = [&] { return Eigen::Vector3d(number(), number(), number()); };
  Snapshot frame = make_frame(0, 3);
  frame.probes[0].section.moment_1 = number();
  frame.probes[0].section.von_mises = number();  // moment_2 and twist stay unknown
  frame.beams[0].torque_max = frame.beams[0].von_mises_max = {number(), number()};
  for (ElementRecord& e : frame.beams[0].elements)
    for (int k = 0; k < 4; ++k) {
      e.moment_1[k] = number();
      e.twist[k] = number();
      e.d1.col(k) = vector();
      e.d2.col(k) = vector();
    }
  ResultsWriter writer(directory.path(), with_sections, "title");
  writer.write(frame);
  writer.finish();
  const StoredResults stored = read_results(directory.path());
  EXPECT_TRUE(stored.names.sections);
  expect_equal(stored.frames.at(0), frame);
  const std::string header = lines_of(directory.path() / "histories.csv").at(0);
  const std::string end =
      "reaction.arch.end.mz [N m],tip.moment_1 [N m],tip.moment_2 [N m],tip.twist [rad],tip.von_mises [Pa],"
      "cable.torque.max [N m],cable.twist.max [rad],cable.von_mises.max [Pa],"
      "arch.torque.max [N m],arch.twist.max [rad],arch.von_mises.max [Pa],"
      "tip.speed [m/s],trolley.speed [m/s],cable.sag [m],arch.sag [m]";
  EXPECT_TRUE(header.ends_with(end)) << header;
}

TEST(Results, StoredBeamsComeBackExactlyWhileTheirElementsChangeInNumber) {
  const TemporaryDirectory directory;
  ResultsWriter writer(directory.path() / "new" / "directory", names, "title");
  const std::vector<Snapshot> frames = {make_frame(0, 3), make_frame(0.5, 5), make_frame(1, 1)};
  for (const Snapshot& frame : frames) writer.write(frame);
  writer.finish();
  for (const Snapshot& frame : frames) {
    const auto [time, beams] =
        read_stored_beams(directory.path() / "new" / "directory", frame.time + 0.1 * (1 - frame.time));
    EXPECT_EQ(time, frame.time);
    ASSERT_EQ(beams.size(), 2u);
    for (int b = 0; b < 2; ++b) {
      EXPECT_EQ(beams[b].name, names.beams[b]);
      ASSERT_EQ(beams[b].elements.size(), frame.beams[b].elements.size());
      for (std::size_t i = 0; i < beams[b].elements.size(); ++i) {
        EXPECT_EQ(beams[b].elements[i].control_points, frame.beams[b].elements[i].control_points);
        EXPECT_EQ(beams[b].elements[i].s_start, frame.beams[b].elements[i].s_start);
        EXPECT_EQ(beams[b].elements[i].s_end, frame.beams[b].elements[i].s_end);
      }
    }
  }
}

TEST(Results, ATimeOutsideTheStoredRangeNamesTheRange) {
  const TemporaryDirectory directory;
  ResultsWriter writer(directory.path(), names, "title");
  writer.write(make_frame(0.25, 1));
  writer.write(make_frame(0.75, 1));
  writer.finish();
  for (const double time : {0.2, 0.8, std::nan("")}) {
    try {
      read_stored_beams(directory.path(), time);
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("from 0.25 s to 0.75 s"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("results.nc"), std::string::npos);
    }
  }
}

const std::vector<Snapshot> five_frames = {make_frame(0, 3), make_frame(0.25, 5), make_frame(0.5, 1),
                                           make_frame(0.75, 0, true), make_frame(1, 2, true)};

std::vector<std::string> files_in(const std::filesystem::path& directory) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    files.push_back(entry.path().filename().string());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Results, FramesComeBackWholeFromChunksThatWereMerged) {
  const TemporaryDirectory directory;
  ResultsWriter writer(directory.path(), names, "title");
  for (std::size_t i = 0; i < five_frames.size(); ++i) {
    writer.write(five_frames[i]);
    if (i % 2 == 0) writer.close_chunk();
  }
  writer.finish();
  EXPECT_EQ(files_in(directory.path()), (std::vector<std::string>{"histories.csv", "results.nc"}));
  const StoredResults stored = read_results(directory.path());
  EXPECT_EQ(stored.title, "title");
  EXPECT_EQ(stored.names.bodies, names.bodies);
  ASSERT_EQ(stored.frames.size(), five_frames.size());
  for (std::size_t i = 0; i < five_frames.size(); ++i) expect_equal(stored.frames[i], five_frames[i]);
}

// Hands the elements of a frame to a writer before it, two at a time.
Snapshot written_ahead(ResultsWriter& writer, Snapshot frame) {
  for (BeamRecord& beam : frame.beams) {
    const std::vector<ElementRecord> elements = std::exchange(beam.elements, {});
    for (std::size_t i = 0; i < elements.size(); i += 2)
      writer.write_ahead(std::span(elements).subspan(i, std::min<std::size_t>(2, elements.size() - i)));
    beam.handed_over = elements.size();
  }
  return frame;
}

TEST(Results, FramesComeBackWholeWhoseElementsWereWrittenAhead) {
  const TemporaryDirectory directory;
  ResultsWriter writer(directory.path(), names, "title");
  writer.write(five_frames[0]);
  for (std::size_t i = 1; i < five_frames.size(); ++i) writer.write(written_ahead(writer, five_frames[i]));
  EXPECT_EQ(writer.frame_count(), five_frames.size());
  writer.finish();
  EXPECT_EQ(files_in(directory.path()), (std::vector<std::string>{"histories.csv", "results.nc"}));
  const StoredResults stored = read_results(directory.path());
  ASSERT_EQ(stored.frames.size(), five_frames.size());
  for (std::size_t i = 0; i < five_frames.size(); ++i) expect_equal(stored.frames[i], five_frames[i]);
}

TEST(Results, ElementsWhoseFrameIsNotWrittenLeaveNoFile) {
  const TemporaryDirectory directory;
  {
    ResultsWriter writer(directory.path(), names, "title");
    writer.write_ahead(five_frames[0].beams[0].elements);
  }
  EXPECT_EQ(files_in(directory.path()), (std::vector<std::string>{"histories.csv.part"}));
}

TEST(Results, ConnectorsComeBackWithTheirEnds) {
  const TemporaryDirectory directory;
  SnapshotNames with_connectors = names;
  with_connectors.connectors = {"dropper", "rod"};
  std::vector<Snapshot> frames(five_frames.begin(), five_frames.begin() + 2);
  for (Snapshot& frame : frames)
    frame.connectors = {{.length = 1 + frame.time, .force = 5, .from = {1, 2, 3}, .to = {4, 5, frame.time}},
                        {.length = 2, .force = -7, .from = {0.1, 0, 0}, .to = {0, 0.2, 0}}};
  ResultsWriter writer(directory.path(), with_connectors, "title");
  for (const Snapshot& frame : frames) writer.write(frame);
  writer.finish();
  const StoredResults stored = read_results(directory.path());
  EXPECT_EQ(stored.names.connectors, with_connectors.connectors);
  ASSERT_EQ(stored.frames.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) expect_equal(stored.frames[i], frames[i]);
}

// As those of a run that an earlier version has begun.
TEST(Results, ConnectorsMayHaveNoEnds) {
  const TemporaryDirectory directory;
  SnapshotNames with_connectors = names;
  with_connectors.connectors = {"dropper"};
  Snapshot frame = five_frames[0];
  frame.connectors = {{.length = 1, .force = 5}};
  ResultsWriter writer(directory.path(), with_connectors, "title");
  writer.write(frame);
  writer.finish();
  const StoredResults stored = read_results(directory.path());
  EXPECT_EQ(stored.frames.at(0).connectors.at(0).force, 5);
  EXPECT_TRUE(stored.frames.at(0).connectors.at(0).from.array().isNaN().all());
  EXPECT_TRUE(stored.frames.at(0).connectors.at(0).to.array().isNaN().all());
}

TEST(Results, AnUnfinishedRunLeavesItsClosedChunksAndNoFileUnderAFinalName) {
  const TemporaryDirectory directory;
  {
    ResultsWriter writer(directory.path(), names, "title");
    writer.write(five_frames[0]);
    writer.write(five_frames[1]);
    writer.close_chunk();
    writer.write(five_frames[2]);
  }
  EXPECT_EQ(files_in(directory.path()),
            (std::vector<std::string>{"histories.csv.part", "results.chunk0001.nc"}));
  EXPECT_EQ(lines_of(directory.path() / "histories.csv.part").size(), 4u);
  const StoredResults stored = read_results(directory.path());
  ASSERT_EQ(stored.frames.size(), 2u);
  expect_equal(stored.frames[1], five_frames[1]);
}

TEST(Results, ADirectoryWithoutResultsIsNamed) {
  const TemporaryDirectory directory;
  for (const auto& path : {directory.path(), directory.path() / "none"}) {
    try {
      read_results(path);
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find((path / "results.nc").string()), std::string::npos);
    }
  }
}

class ResumedResults : public ::testing::TestWithParam<bool> {};

TEST_P(ResumedResults, AreThoseOfARunWithoutABreakWhereverItWasCut) {
  const bool finished = GetParam();
  const TemporaryDirectory whole;
  ResultsWriter uninterrupted(whole.path(), names, "title");
  for (const Snapshot& frame : five_frames) uninterrupted.write(frame);
  uninterrupted.finish();
  for (std::size_t kept = 0; kept <= 4; ++kept) {
    const TemporaryDirectory directory;
    {
      ResultsWriter first(directory.path(), names, "title");
      for (std::size_t i = 0; i < 4; ++i) {
        first.write(make_frame(five_frames[i].time,
                               i < kept ? static_cast<int>(five_frames[i].steps.size()) : 7, i == 3));
        if (i % 2 == 1) first.close_chunk();
      }
      if (finished) first.finish();
    }
    ResultsWriter second = ResultsWriter::resume(directory.path(), names, "title", kept);
    for (std::size_t i = kept; i < five_frames.size(); ++i) second.write(five_frames[i]);
    second.finish();
    EXPECT_EQ(lines_of(directory.path() / "histories.csv"), lines_of(whole.path() / "histories.csv"));
    const StoredResults stored = read_results(directory.path());
    ASSERT_EQ(stored.frames.size(), five_frames.size()) << kept;
    for (std::size_t i = 0; i < five_frames.size(); ++i) expect_equal(stored.frames[i], five_frames[i]);
    EXPECT_EQ(files_in(directory.path()), (std::vector<std::string>{"histories.csv", "results.nc"}));
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ResumedResults, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "AFinishedRun" : "AKilledRun"; });

TEST(Results, MoreFramesThanAreStoredCannotBeResumed) {
  const TemporaryDirectory directory;
  {
    ResultsWriter writer(directory.path(), names, "title");
    writer.write(five_frames[0]);
    writer.finish();
  }
  EXPECT_THROW(ResultsWriter::resume(directory.path(), names, "title", 2), std::runtime_error);
}

TEST(Results, EveryVariableHasALongNameAndOneOfNumbersAUnit) {
  const TemporaryDirectory directory;
  ResultsWriter writer(directory.path(), names, "title");
  writer.write(make_frame(0, 2, true));
  writer.finish();
  int file = -1, variables = 0;
  ASSERT_EQ(nc_open((directory.path() / "results.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
  ASSERT_EQ(nc_inq_nvars(file, &variables), NC_NOERR);
  EXPECT_GT(variables, 20);
  for (int v = 0; v < variables; ++v) {
    char name[NC_MAX_NAME + 1];
    nc_type type;
    ASSERT_EQ(nc_inq_var(file, v, name, &type, nullptr, nullptr, nullptr), NC_NOERR);
    if (type != NC_STRING) EXPECT_EQ(nc_inq_attid(file, v, "units", nullptr), NC_NOERR) << name;
    EXPECT_EQ(nc_inq_attid(file, v, "long_name", nullptr), NC_NOERR) << name;
  }
  nc_close(file);
}

TEST(Results, ProbesAndBodiesMayBeMissing) {
  const TemporaryDirectory directory;
  ResultsWriter writer(directory.path(), {{}, {}, {"cable"}}, "");
  Snapshot frame = make_frame(0, 1);
  frame.probes.clear();
  frame.bodies.clear();
  frame.beams.resize(1);
  writer.write(frame);
  writer.finish();
  EXPECT_EQ(read_stored_beams(directory.path(), 0).second.size(), 1u);
}

TEST(Results, AFrameThatDoesNotFitTheNamesIsRefused) {
  const TemporaryDirectory directory;
  ResultsWriter writer(directory.path(), names, "title");
  Snapshot frame = make_frame(0, 1);
  frame.probes.clear();
  EXPECT_THROW(writer.write(frame), std::invalid_argument);
}

TEST(Results, ADirectoryThatCannotBeMadeIsNamed) {
  const TemporaryDirectory directory;
  const auto in_the_way = directory.write("file", "");
  try {
    ResultsWriter(in_the_way, names, "title");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(in_the_way.string()), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace nurbeam
