// The readers of captures: what they read, and what they refuse.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <bit>
#include <functional>

#include "core/base/damaged_text.h"
#include "core/base/error.h"
#include "core/test_error.h"
#include "trajectories/capture/marker_places.h"

#include "trajectories/formats/format.h"

namespace glovebench::trajectories {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kCsv =
    "time_s,index_tip_x_mm,index_tip_y_mm,index_tip_z_mm,unlabeled_1_x_mm,unlabeled_1_y_mm,unlabeled_1_z_mm\n"
    "2.5,1.5,-2,3,,,\r\n"
    "2.51,,nan,NaN,4,5,6\n"
    "\n"
    "2.52,7,8,9,1e1,11,12\n";

const std::string kTrc =
    "PathFileType\t4\t(X/Y/Z)\ttwo.trc\n"
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n"
    "100.0\t100.0\t3\t2\tmm\t100.0\t1\t3\n"
    "Frame#\tTime\tindex_tip\t\t\twrist\t\t\n"
    "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n"
    "\n"
    "1\t2.50\t1.5\t-2\t3\t\t\t\n"
    "2\t2.51\t0\t0\t0\t4\t5\t6\n"
    "3\t2.52\t7\t8\t9\n";

const std::string kWebxr = R"({"format": "glovebench-webxr-joints", "version": 1, "frames": [
  {"timestamp_us": 1000, "joints_m": {"wrist": [0.1, 0.2, 0.3], "pinky-finger-tip": [0, -1, 2]}},
  {"timestamp_us": 12000, "joints_m": {}}]})";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

template <typename Parse>
std::string refusal_of(Parse parse) {
  const std::string error = thrown_by(parse);
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  return error;
}

MarkerSequence parsed(std::string_view format, std::string_view bytes, const std::string& where,
                      Side side = Side::right) {
  return find_marker_format(format).markers(bytes, side, where);
}

void expect_three_frames(const MarkerSequence& sequence) {
  ASSERT_EQ(sequence.frames.size(), 3U);
  EXPECT_EQ(sequence.frames[0].timestamp_us, 0) << "times count from the first frame";
  EXPECT_EQ(sequence.frames[2].timestamp_us, 20'000);
  EXPECT_LT((sequence.frames[0].points[0] - Eigen::Vector3d(0.0015, -0.002, 0.003)).norm(), 1e-12);
  EXPECT_FALSE(is_seen(sequence.frames[0].points[1]));
  EXPECT_FALSE(is_seen(sequence.frames[1].points[0]));
  EXPECT_LT((sequence.frames[1].points[1] - Eigen::Vector3d(0.004, 0.005, 0.006)).norm(), 1e-12);
}

TEST(CaptureFiles, an_hour_at_120_hz_is_the_most) {
  const auto refusal_of_frames = [](size_t count) {
    std::string text = "time_s,wrist_x_m,wrist_y_m,wrist_z_m\n";
    for (size_t i = 0; i < count; ++i) text += fmt::format("{},,,\n", i);
    return refusal_of([&] { parsed("csv", text, "c.csv"); });
  };
  EXPECT_EQ(refusal_of_frames(kMaxMarkerFrames), "");
  EXPECT_THAT(refusal_of_frames(kMaxMarkerFrames + 1),
              HasSubstr("c.csv: line 432002, time_s: found more frames, expected 432000 at most"));
}

TEST(CaptureFiles, csv_holds_points_gaps_and_times) {
  const MarkerSequence sequence = parsed("csv", kCsv, "file");
  EXPECT_THAT(sequence.names, testing::ElementsAre("index_tip", "unlabeled_1"));
  EXPECT_FALSE(is_unlabeled(sequence.names[0]));
  EXPECT_TRUE(is_unlabeled(sequence.names[1]));
  expect_three_frames(sequence);
  const std::string written = csv_markers(sequence);
  EXPECT_EQ(csv_markers(parsed("csv", written, "file")), written);
  EXPECT_EQ(parsed("csv", "time_s,*1_x_m,*1_y_m,*1_z_m\n0,1,2,3\n", "file").frames[0].points[0].z(), 3.0);
}

TEST(CaptureFiles, csv_refuses_in_one_line) {
  const auto refused = [](const std::string& text) { return refusal_of([&] { parsed("csv", text, "file"); }); };
  EXPECT_THAT(refused(""), HasSubstr("file: line 1, column 1: found \"\", expected \"time_s\""));
  EXPECT_THAT(refused("time_s\n"), HasSubstr("line 1: found 1 columns"));
  EXPECT_THAT(refused(replaced(kCsv, "index_tip_y_mm", "index_tip_y_m")), HasSubstr("line 1, column 3"));
  EXPECT_THAT(refused(replaced(kCsv, "index_tip_y_mm", "ring_tip_y_mm")),
              AllOf(HasSubstr("ring_tip_y_mm"), HasSubstr("index_tip_y_mm")));
  EXPECT_THAT(refused("time_s,a_x_m,a_y_m,a_z_m,a_x_m,a_y_m,a_z_m\n"), HasSubstr("\"a\" again"));
  EXPECT_THAT(refused(replaced(kCsv, "1.5", "fast")), HasSubstr("line 2, index_tip: found \"fast\""));
  EXPECT_THAT(refused(replaced(kCsv, "1.5", "inf")), HasSubstr("a number from -100000 to 100000"));
  EXPECT_THAT(refused(replaced(kCsv, "1.5", "")), HasSubstr("line 2, index_tip: found a part of a point"));
  EXPECT_THAT(refused(replaced(kCsv, "1.5,", "")), HasSubstr("line 2: found 6 cells, expected 7"));
  EXPECT_THAT(refused(replaced(kCsv, "2.51", "2.5")), HasSubstr("line 3, time_s: found 2.5 s"));
  EXPECT_THAT(refused(kCsv.substr(0, kCsv.find('\n'))), HasSubstr("frames: found none"));
}

TEST(CaptureFiles, trc_holds_points_gaps_and_times) {
  const MarkerSequence sequence = parsed("trc", kTrc, "file");
  EXPECT_THAT(sequence.names, testing::ElementsAre("index_tip", "wrist"));
  expect_three_frames(sequence);
  EXPECT_EQ(parsed("trc", replaced(kTrc, "\tmm\t", "\tm\t"), "file").frames[2].points[0].z(), 9.0);
}

TEST(CaptureFiles, trc_refuses_in_one_line) {
  const auto refused = [](const std::string& text) { return refusal_of([&] { parsed("trc", text, "file"); }); };
  EXPECT_THAT(refused(""), HasSubstr("file: lines: found 1"));
  EXPECT_THAT(refused(replaced(kTrc, "PathFileType", "Path")), HasSubstr("line 1, column 1: found \"Path\""));
  EXPECT_THAT(refused(replaced(kTrc, "\tmm\t", "\tcm\t")),
              HasSubstr("line 3, Units: found \"cm\", expected mm or m"));
  EXPECT_THAT(refused(replaced(kTrc, "Units", "Unit")), HasSubstr("lines 2 and 3, Units"));
  EXPECT_THAT(refused(replaced(kTrc, "\t3\t2\t", "\t4\t2\t")), HasSubstr("frames: found 3, expected 4"));
  EXPECT_THAT(refused(replaced(kTrc, "\t3\t2\t", "\t3\t3\t")), HasSubstr("line 4: found 2 names, expected 3"));
  EXPECT_THAT(refused(replaced(kTrc, "\t3\t2\t", "\t2.5\t2\t")), HasSubstr("line 3, NumFrames: found \"2.5\""));
  EXPECT_THAT(refused(replaced(kTrc, "Y2", "Y3")), HasSubstr("line 5, column 7: found \"Y3\", expected \"Y2\""));
  EXPECT_THAT(refused(replaced(kTrc, "2.51", "soon")), HasSubstr("line 8, Time: found \"soon\""));
  EXPECT_THAT(refused(replaced(kTrc, "\t6\n", "\t6\t7\n")), HasSubstr("line 8: found 9 cells"));
}

TEST(CaptureFiles, webxr_joints_that_a_frame_does_not_name_are_gaps) {
  const MarkerSequence sequence = parsed("webxr", kWebxr, "file");
  ASSERT_EQ(sequence.names.size(), 25U);
  ASSERT_EQ(sequence.frames.size(), 2U);
  EXPECT_EQ(sequence.frames[0].timestamp_us, 0);
  EXPECT_EQ(sequence.frames[1].timestamp_us, 11'000);
  EXPECT_EQ(sequence.frames[0].points[0], Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(sequence.frames[0].points[24], Eigen::Vector3d(0, -1, 2));
  EXPECT_FALSE(is_seen(sequence.frames[0].points[5]));

  const auto refused = [](const std::string& text) { return refusal_of([&] { parsed("webxr", text, "file"); }); };
  EXPECT_THAT(refused(replaced(kWebxr, "\"wrist\"", "\"elbow\"")),
              AllOf(HasSubstr("file: frames[0].joints_m.elbow"), HasSubstr("WebXR hand joint")));
  EXPECT_THAT(refused(replaced(kWebxr, "0.1, ", "")), HasSubstr("frames[0].joints_m.wrist: found"));
  EXPECT_THAT(refused(replaced(kWebxr, "12000", "1000")), HasSubstr("frames[1].timestamp_us"));
  EXPECT_THAT(refused(replaced(kWebxr, "joints_m", "joints")), HasSubstr("frames[0]"));
}

/// A pose file whose joints lie at (index, side, 0) m.
std::string handpose_bytes(float joint_count = 25) {
  std::vector<float> floats = {joint_count};
  for (int side = 0; side < 2; ++side) {
    for (int j = 0; j < 25; ++j) {
      for (int i = 0; i < 16; ++i) {
        floats.push_back(i % 5 == 0 ? 1.0F
                         : i == 12  ? static_cast<float>(j)
                         : i == 13  ? static_cast<float>(side)
                                    : 0);
      }
    }
  }
  floats.resize(floats.size() + 50, 0.5F);
  std::string bytes;
  for (const float value : floats)
    for (int b = 0; b < 4; ++b) bytes += static_cast<char>(std::bit_cast<uint32_t>(value) >> (8 * b));
  return bytes;
}

TEST(CaptureFiles, handposes_hold_both_hands) {
  const std::string bytes = handpose_bytes();
  EXPECT_EQ(parsed("handpose", bytes, "file", Side::left).frames[0].points[7], Eigen::Vector3d(7, 0, 0));
  EXPECT_EQ(parsed("handpose", bytes, "file", Side::right).frames[0].points[24], Eigen::Vector3d(24, 1, 0));
  const auto refused = [](const std::string& text) {
    return refusal_of([&] { parsed("handpose", text, "file", Side::right); });
  };
  EXPECT_THAT(refused(bytes.substr(1)), HasSubstr("file: size: found 3403 bytes, expected 3404"));
  EXPECT_THAT(refused(handpose_bytes(24)), HasSubstr("float 0: found 24, expected 25"));
  std::string nan = bytes;
  nan.replace(4 * (1 + 16 * 25 + 12), 4, "\xff\xff\xff\xff");
  EXPECT_THAT(refused(nan), HasSubstr("float 413: found "));
}

TEST(CaptureFiles, layouts_name_places) {
  const std::string text =
      R"({"format": "glovebench-marker-layout", "version": 1, "markers": {"RIDX3": "index_tip", "a": "wrist_2"}})";
  const MarkerLayout layout = parse_marker_layout(text, "file");
  EXPECT_EQ(layout.at("RIDX3"), "index_tip");
  const auto refused = [](const std::string& bad) { return refusal_of([&] { parse_marker_layout(bad, "file"); }); };
  EXPECT_THAT(refused(replaced(text, "index_tip", "index_toe")),
              AllOf(HasSubstr("file: markers.RIDX3: found \"index_toe\""), HasSubstr("index_knuckle")));
  EXPECT_THAT(refused(replaced(text, "\"version\": 1", "\"version\": 2")), HasSubstr("version"));
}

TEST(CaptureFiles, damage_is_refused_or_gives_a_sequence) {
  struct Reader {
    std::string text;
    std::function<size_t(const std::string&)> frames;
  };
  const std::vector<Reader> readers = {
      {kCsv, [](const std::string& text) { return parsed("csv", text, "damaged").frames.size(); }},
      {kTrc, [](const std::string& text) { return parsed("trc", text, "damaged").frames.size(); }},
      {kWebxr, [](const std::string& text) { return parsed("webxr", text, "damaged").frames.size(); }},
      {handpose_bytes(),
       [](const std::string& text) { return parsed("handpose", text, "damaged", Side::left).frames.size(); }},
      {R"({"format": "glovebench-marker-layout", "version": 1, "markers": {"a": "wrist_2", "b:": "index_tip"}})",
       [](const std::string& text) { return parse_marker_layout(text, "damaged").size() + 1; }},
  };
  for (size_t r = 0; r < readers.size(); ++r) {
    int refused = 0, accepted = 0;
    for (int i = 0; i < 2000; ++i) {
      RandomStream random(r, "capture", i, "damage");
      const std::string text = damaged_text(readers[r].text, random);
      try {
        EXPECT_GT(readers[r].frames(text), 0U);
        ++accepted;
      } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("damaged"));
        ++refused;
      }
    }
    EXPECT_GT(refused, 0) << r;
    EXPECT_GT(accepted, 0) << r;
  }
}

}  // namespace
}  // namespace glovebench::trajectories
