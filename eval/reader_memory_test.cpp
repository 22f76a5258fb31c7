// Memory that readers need for inputs made to need much: at most 16 MB plus 20 bytes per byte of input.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <functional>

#include "ci/build_paths.h"
#include "core/adapters/dds/server/server_log.h"
#include "core/adapters/pictures/picture_files.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/parse_json.h"
#include "core/base/sanitizers.h"
#include "core/calibration/board_views.h"
#include "core/calibration/color_seeds.h"
#include "core/camera/rgbd_calibration.h"
#include "core/hand/hand_file.h"
#include "core/kinect/recording_files.h"
#include "core/robot/command_limits.h"
#include "core/tracker/tracker_config.h"
#include "eval/estimates/estimate_format.h"
#include "eval/frame_formats/ros2_messages.h"
#include "eval/sources/ros_recording.h"
#include "eval/sources/test_message_files.h"
#include "eval/sources/tum_source.h"
#include "eval/suite.h"
#include "reports/comparison/noise_floor.h"
#include "reports/comparison/speed.h"
#include "reports/comparison/stage_times.h"
#include "reports/estimates.h"
#include "reports/example_result.h"
#include "reports/results_json.h"
#include "reports/timings.h"
#include "trajectories/capture/marker_places.h"
#include "trajectories/formats/format.h"
#include "trajectories/generation/motion_script.h"
#include "trajectories/posture_file.h"
#include "trajectories/trajectory.h"

// Sanitizers replace the same functions.
#if !defined(GLOVEBENCH_ADDRESS_SANITIZER) && !defined(GLOVEBENCH_THREAD_SANITIZER)

#include "eval/test_counted_heap.h"

namespace glovebench {
namespace {

using nlohmann::json;
namespace motion = trajectories;

constexpr size_t kHostileBytes = 1'000'000;

struct Reader {
  std::string name;
  std::function<void(const std::string&)> read;
  std::string valid;  ///< accepted text
};

/// Peak memory of a reader beside its input, and whether it accepted the input.
struct Reading {
  int64_t bytes = 0;
  std::string error;
};
Reading reading(const Reader& reader, const std::string& input) {
  Reading result;
  counted_heap::begin();
  try {
    reader.read(input);
  } catch (const Error& error) {
    result.bytes = counted_heap::end();
    result.error = error.what();
    return result;
  }
  result.bytes = counted_heap::end();
  return result;
}

void expect_bounded(const Reader& reader, const std::string& input, const std::string& what) {
  const auto size = static_cast<int64_t>(input.size());
  const Reading read = reading(reader, input);
  EXPECT_LE(read.bytes + size, (16 << 20) + 20 * size) << reader.name << " of " << what << ": " << read.error;
}

std::string repeated(const std::string& part, size_t bytes = kHostileBytes) {
  std::string text;
  while (text.size() < bytes) text += part;
  return text;
}
/// An array that repeats one value.
std::string array_of(const std::string& value, size_t bytes) {
  std::string text = "[" + repeated(value + ",", bytes);
  text.back() = ']';
  return text;
}
/// An object of many keys.
std::string object_of(const std::string& value, size_t bytes) {
  std::string text = "{";
  for (int i = 0; text.size() < bytes; ++i) text += fmt::format("\"{}\":{},", i, value);
  text.back() = '}';
  return text;
}

std::vector<std::pair<std::string, std::string>> hostile_values(size_t bytes) {
  return {{"zeros", array_of("0", bytes)},
          {"empty arrays", array_of("[]", bytes)},
          {"empty objects", array_of("{}", bytes)},
          {"empty texts", array_of("\"\"", bytes)},
          {"objects in objects", array_of(R"({"":{"":{"":{"":{}}}}})", bytes)},
          {"arrays in arrays", array_of("[[[[[[[[]]]]]]]]", bytes)},
          {"keys", object_of("0", bytes)},
          {"keys of objects", object_of("{}", bytes)},
          {"a text", "\"" + repeated("x", bytes) + "\""},
          {"digits", repeated("1", bytes)}};
}

/// Adds the places in a document; of an array only the first item's.
void add_places(const json& value, const json::json_pointer& at, std::vector<json::json_pointer>& places) {
  places.push_back(at);
  if (value.is_array() && !value.empty()) add_places(value[0], at / 0, places);
  if (!value.is_object()) return;
  for (const auto& [key, member] : value.items()) add_places(member, at / key, places);
}

std::string with_value_at(json document, const json::json_pointer& place, const std::string& value) {
  document[place] = "HERE";
  std::string text = document.dump();
  return text.replace(text.find("\"HERE\""), 6, value);
}

PostureSet gestures() { return {.name = "gestures", .posture_names = {"open"}, .postures = {Posture::Zero()}}; }

motion::Trajectory small_trajectory() {
  motion::Trajectory trajectory;
  trajectory.name = "small";
  trajectory.frames = {{0, Posture::Zero(), Eigen::Isometry3d::Identity()}};
  return trajectory;
}

/// An accepted text, kept for fuzzing.
std::string corpus(const std::string& name) { return read_file(build_paths::source("ci/corpora/" + name)); }

constexpr const char* kJoints =
    R"({"format": "glovebench-joints", "version": 1, "order": "webxr", "frame": "camera",
"frames": [{"time_s": 0, "joints_m": {"wrist": [0, 0, 1], "thumb-tip": [0, 1, 1], "index-finger-tip": [1, 1, 1],
"ring-finger-tip": [1, 0, 1]}}]})";

const eval::EstimateFormat& estimate_format(const std::string& name) {
  return *std::ranges::find(eval::estimate_formats(), name, &eval::EstimateFormat::name);
}

/// Units, order, frame and time that files may leave unsaid.
eval::EstimateFlags estimate_flags() { return {eval::load_joint_order("mediapipe"), "mm", "camera", "s"}; }

std::vector<Reader> json_readers() {
  const std::string w = "x.json";
  reports::Timings timings;
  timings.experiments = {{{"Tr1", "D", reports::TruthKind::source, 1, {}}, 1, {{"align", {1, 2, 3}}}}};
  const reports::NoiseFloor floor = {"quick", 16, 2, 0.01, "0", "2026", {{"all", "position_error_mm", 0, 0.1, 0}}};
  reports::RunResult result = reports::full_result();
  result.experiments = reports::small_result().experiments;
  const std::vector<reports::SpeedRatio> ratios = {{"a", 2, 1, 3}};
  return {
      {"configuration", [=](auto& text) { config_from_json(parse_json(text, w), {}, w); },
       to_json(TrackerConfig()).dump()},
      {"limits", [=](auto& text) { command_limits_from_json(parse_json(text, w), w); },
       to_json(CommandLimits()).dump()},
      {"calibration", [=](auto& text) { calibration_from_text(text, w); },
       to_json(nominal_kinect_calibration()).dump()},
      {"hand", [=](auto& text) { parse_hand(text, w); }, to_json(MeasuredHand{.shape = {}, .views = 1}).dump()},
      {"glove colors", [=](auto& text) { calibration::parse_glove_colors(text, w); }, corpus("glove_colors/ten")},
      {"trajectory", [=](auto& text) { motion::parse_trajectory(text, w); }, canonical_text(small_trajectory())},
      {"posture set", [=](auto& text) { motion::parse_postures_json(text, w); },
       motion::canonical_text(gestures())},
      {"marker layout", [=](auto& text) { motion::parse_marker_layout(text, w); },
       R"({"format": "glovebench-marker-layout", "version": 1, "markers": {"a": "wrist"}})"},
      {"webxr", [=](auto& text) { motion::find_marker_format("webxr").markers(text, Side::right, w); },
       corpus("format_webxr/two_frames")},
      {"joints", [=](auto& text) { estimate_format("joints").read(text, {}, w); }, kJoints},
      {"joint map", [=](auto& text) { eval::parse_joint_map(text, w); },
       R"({"format": "glovebench-joint-map", "version": 1, "joints": ["wrist", "thumb-tip", "ring-finger-tip",
"index-finger-tip"]})"},
      {"motion script", [=](auto& text) { motion::parse_motion_script(text, gestures(), w); },
       corpus("motion_script/exit")},
      {"suite", [=](auto& text) { eval::parse_suite(text, w); }, corpus("suite/full_entry")},
      {"results", [=](auto& text) { reports::parse_results(text, w); }, results_json(result)},
      {"timings", [=](auto& text) { reports::parse_stage_times(text, w); }, timings_json(timings)},
      {"noise floor", [=](auto& text) { reports::parse_noise_floor(text, w); }, noise_floor_json(floor)},
      {"speed ratios", [=](auto& text) { reports::parse_speed_ratios(text, w); }, speed_json(ratios)},
  };
}

TEST(ReaderMemoryLong, of_json_is_bounded_whatever_it_holds) {
  const auto values = hostile_values(kHostileBytes);
  for (const Reader& reader : json_readers()) {
    ASSERT_EQ(reading(reader, reader.valid).error, "") << reader.name;
    for (const auto& [what, value] : values) expect_bounded(reader, value, what);
  }
}

TEST(ReaderMemoryLong, of_json_is_bounded_at_each_place) {
  const auto values = hostile_values(kHostileBytes / 3);  // hundreds of places
  for (const Reader& reader : json_readers()) {
    const json document = json::parse(reader.valid);
    std::vector<json::json_pointer> places;
    add_places(document, json::json_pointer(), places);
    for (size_t i = 1; i < places.size(); ++i) {
      const auto& [what, value] = values[i % values.size()];
      expect_bounded(reader, with_value_at(document, places[i], value), what + " at " + places[i].to_string());
    }
  }
}

/// Fills one array of a document with values of `row`, up to some megabytes.
std::string with_rows(const json& document, const json::json_pointer& place,
                      const std::function<std::string(int)>& row) {
  std::string rows = "[";
  for (int i = 0; rows.size() < 4 * kHostileBytes; ++i) rows += row(i) + ",";
  rows.back() = ']';
  return with_value_at(document, place, rows);
}

const Reader& named(const std::vector<Reader>& readers, const std::string& name) {
  return *std::ranges::find(readers, name, &Reader::name);
}

// Many of the shortest accepted values, which are larger in memory than as text.
TEST(ReaderMemoryLong, of_long_documents_of_small_values_is_bounded) {
  const std::vector<Reader> readers = json_readers();
  const auto check = [&](const std::string& name, const std::string& place, const auto& row, const char* refused) {
    const Reader& reader = named(readers, name);
    const std::string text = with_rows(json::parse(reader.valid), json::json_pointer(place), row);
    const std::string error = reading(reader, text).error;
    EXPECT_EQ(error.empty(), *refused == 0) << name << ": " << error;
    EXPECT_NE(error.find(refused), std::string::npos) << name << ": " << error;
    expect_bounded(reader, text, "many " + place);
  };
  const std::string zeros = "0" + repeated(",0", 2 * (kAngleCount - 1));
  const auto frame = [&](int i) {
    return fmt::format(
        R"({{"timestamp_us":{},"position_mm":[0,0,0],"quaternion_wxyz":[1,0,0,0],"angles_deg":[{}]}})", i, zeros);
  };
  check("trajectory", "/frames", frame, "");
  check(
      "posture set", "/postures",
      [&](int i) { return fmt::format(R"({{"name":"{}","angles_deg":[{}]}})", i, zeros); }, "");
  check(
      "webxr", "/frames", [](int i) { return fmt::format(R"({{"timestamp_us":{},"joints_m":{{}}}})", i); },
      "points");
  check(
      "noise floor", "/entries",
      [](int i) {
        return fmt::format(
            R"({{"experiment":"{}","quantity":"rotation_error_deg","spread":0,"minimum_effect":1,"detectable":0}})",
            i);
      },
      "");
  const std::string metrics = repeated(",0", 2 * reports::frame_metrics().size());
  const std::string no_metrics = repeated(",null", 5 * reports::frame_metrics().size());
  check(
      "results", "/experiments/1/runs/0/frames",
      [&](int i) { return fmt::format(R"([{0},{0},"lost",true,true,true,true,true,0{1}])", i, metrics); },
      "found \"lost\"");
  check(
      "results", "/experiments/1/runs/0/frames",
      [&](int i) { return fmt::format(R"([{0},{0},"no_hand",false,false,true,true,true,0{1}])", i, no_metrics); },
      "counts of the frames");  // read to its end first
}

std::vector<Reader> text_readers() {
  const std::string w = "x";
  std::vector<Reader> readers = {
      {"posture table", [=](auto& text) { motion::parse_postures_csv(text, "set", w); }, ""},
      {"estimates", [=](auto& text) { reports::parse_estimates(text, w); }, ""},
      {"recording index", [=](auto& text) { parse_recording_index(text, w); }, ""},
      {"tum list", [=](auto& text) { eval::parse_tum_list(text, w); }, ""},
      {"server log", [=](auto& text) { last_state(text, {"a"}, w); }, ""},
      {"picture", [=](auto& text) { decode_gray(text, w); }, ""}};
  for (const eval::EstimateFormat& format : eval::estimate_formats())
    readers.push_back({fmt::format("{} estimates", format.name),
                       [&format, w](auto& text) { format.read(text, estimate_flags(), w); }, ""});
  for (const motion::Format* format : motion::formats_with(&motion::Format::markers))
    readers.push_back(
        {fmt::format("{} capture", format->name), [=](auto& text) { format->markers(text, Side::right, w); }, ""});
  return readers;
}

TEST(ReaderMemory, of_texts_is_bounded_whatever_they_hold) {
  const std::vector<std::string> parts = {
      "\n", ",", "\t", "x", ",\n", "\t\n", "0,", "0\n", "{\"event\":\"state\",\n"};
  for (const Reader& reader : text_readers())
    for (const std::string& part : parts) expect_bounded(reader, repeated(part), json(part).dump());
}

std::string lines_from(const std::string& heading, const std::function<std::string(int)>& line) {
  std::string text = heading;
  for (int i = 0; text.size() < 4 * kHostileBytes; ++i) text += line(i) + "\n";
  return text;
}

TEST(ReaderMemory, of_long_texts_of_short_lines_is_bounded) {
  const std::vector<Reader> readers = text_readers();
  const auto check = [&](const std::string& name, const std::string& text, const char* refused) {
    const std::string error = reading(named(readers, name), text).error;
    EXPECT_EQ(error.empty(), *refused == 0) << name << ": " << error;
    EXPECT_NE(error.find(refused), std::string::npos) << name << ": " << error;
    expect_bounded(named(readers, name), text, "short lines");
  };
  check("csv capture",
        lines_from("time_s,wrist_x_m,wrist_y_m,wrist_z_m\n", [](int i) { return fmt::format("{},,,", 1e-5 * i); }),
        "");
  check(
      "trc capture",
      [] {
        std::string names = "Frame#\tTime\t", axes = "\t\t";
        for (int m = 1; m <= 200; ++m) {
          names += fmt::format("m{}\t\t\t", m);
          axes += fmt::format("X{0}\tY{0}\tZ{0}\t", m);
        }
        return lines_from(
            "PathFileType\nNumFrames\tNumMarkers\tUnits\n1000000\t200\tmm\n" + names + "\n" + axes + "\n",
            [](int i) { return fmt::format("1\t{}", 1e-5 * i); });
      }(),
      "points");
  check("tum list", lines_from("", [](int) { return "0 a"; }), "");
  check("recording index", lines_from("", [](int i) { return fmt::format("d-0.{:06}-{}.pgm", i % 1'000'000, i); }),
        "");
  const auto commas = std::ranges::count(reports::estimates_csv({}), ',');
  check("estimates",
        lines_from(reports::estimates_csv({}),
                   [&](int i) {
                     return fmt::format("0,{0},{0},no_hand{1}", i,
                                        std::string(static_cast<size_t>(commas) - 3, ','));
                   }),
        "");
  check("tum estimates", lines_from("", [](int i) { return fmt::format("{} 0 0 0 0 0 0 1", i); }), "");
  check("columns estimates",
        lines_from("time,0_x,0_y,0_z,1_x,1_y,1_z,2_x,2_y,2_z,3_x,3_y,3_z\n",
                   [](int i) { return fmt::format("{},,,,,,,,,,,,", i); }),
        "");
  std::string angles = reports::estimates_csv({});
  angles = "name" + angles.substr(angles.find("quaternion_z") + 12);
  while (angles.find("_deg") != std::string::npos) angles.erase(angles.find("_deg"), 4);
  check("posture table",
        lines_from(angles, [](int i) { return fmt::format("{}{}", i, repeated(",0", 2 * kAngleCount)); }), "");
}

/// A file of four chunks that unpack to these records.
std::string packed_mcap(const std::string& records) {
  std::string packed(ZSTD_compressBound(records.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), records.data(), records.size(), 1));
  return eval::mcap_file(repeated(eval::mcap_chunk("zstd", packed, records.size()), 3 * packed.size()));
}

// The file is mapped: what reading takes does not depend on its size.
TEST(ReaderMemory, of_mcap_is_bounded_whatever_it_unpacks_to) {
  const std::string image = eval::ros_depth_image({0, "a"}, DepthImage(1, 1));
  std::string images = eval::mcap_topic(1, "/camera/depth/image_rect_raw", "sensor_msgs/msg/Image"), topics;
  while (images.size() < 11 << 20) images += eval::mcap_message(1, image);
  for (uint16_t i = 0; i < 5000; ++i) topics += eval::mcap_topic(i, std::string(256, 'x'), std::string(256, 'y'));
  const Reader reader = {"mcap", [](const std::string& file) { eval::index_recording(file, {}, "x"); }, ""};
  for (const auto& [records, refused] : {std::pair(images, "over 108000 images"), std::pair(topics, "over 4096")}) {
    const Reading read = reading(reader, packed_mcap(records));
    EXPECT_LE(read.bytes, 40 << 20) << refused;
    EXPECT_NE(read.error.find(refused), std::string::npos) << read.error;
  }
}

/// A header that claims an image of this size, without content.
std::vector<std::string> claiming_pictures() {
  const std::string png(
      "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x75\x30\0\0\x75\x30\x10\0\0\0\0"
      "\x13\xdc\x7b\x25",
      33);
  return {"P5 30000 30000 65535\n", "P6 30000 30000 255\n", png};
}

TEST(ReaderMemory, of_pictures_is_bounded_whatever_they_claim) {
  const std::vector<Reader> readers = text_readers();
  const Reader& reader = named(readers, "picture");
  for (const std::string& picture : claiming_pictures()) {
    expect_bounded(reader, picture, "a large claim");
    EXPECT_NE(reading(reader, picture).error, "");
  }
  for (const auto& [width, height] : {std::pair(1920, 1080), std::pair(2100, 1000)}) {
    const ColorImage image(width, height, Rgb{7, 7, 7});
    const std::string pgm = fmt::format("P5 {} {} 255\n{}", width, height, std::string(image.size(), 7));
    for (const std::string& picture : {encode_png(image), encode_jpeg(image, 80), pgm}) {
      expect_bounded(reader, picture, "a picture");
      EXPECT_EQ(reading(reader, picture).error.empty(), width == 1920) << picture.substr(0, 4);
    }
  }
}

}  // namespace
}  // namespace glovebench

#endif
