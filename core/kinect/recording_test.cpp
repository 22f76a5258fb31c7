#include "core/kinect/recording.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/random.h"
#include "core/base/whole_file.h"
#include "core/kinect/recording_files.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, and a small camera: corruption is tried hundreds of times.
class Recording : public testing::Test {
 protected:
  void SetUp() override {
    calibration_.ir.width = calibration_.rgb.width = 32;
    calibration_.ir.height = calibration_.rgb.height = 24;
  }
  void TearDown() override { fs::remove_all(folder_); }

  DeviceFrame frame(int64_t depth_us, int64_t color_us) const {
    DeviceFrame frame{Image<uint16_t>(32, 24), ColorImage(32, 24), depth_us, color_us};
    RandomStream random(1, "recording", depth_us, "pixels");
    for (uint16_t& raw : frame.raw_disparity) raw = static_cast<uint16_t>(random.index(2048));
    for (Rgb& rgb : frame.color)
      for (uint8_t& channel : rgb) channel = static_cast<uint8_t>(random.index(256));
    return frame;
  }
  void record(const std::vector<DeviceFrame>& frames) const {
    RecordingWriter writer(folder_, calibration_);
    for (const DeviceFrame& f : frames) writer.write(f);
    writer.finish();
  }
  std::string path(const std::string& name) const { return (fs::path(folder_) / name).string(); }
  /// The message of the first Error on the way through the whole recording, "" if there is none.
  std::string play_error() const {
    return thrown_by([&] {
      RecordingDevice device(folder_);
      while (device.next_frame()) {
      }
    });
  }

  const std::string folder_ = test_folder();
  RgbdCalibration calibration_ = synthetic_calibration();
};

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Recording, PlaysWhatWasWritten) {
  const std::vector<DeviceFrame> frames = {frame(1'000'001, 1'004'000), frame(1'066'667, 1'070'123),
                                           frame(1'133'334, 1'131'000)};
  record(frames);
  RecordingDevice device(folder_);
  EXPECT_EQ(device.frame_count(), 3);
  EXPECT_EQ(device.unpaired_depth_count(), 0);
  EXPECT_EQ(device.calibration().T_rgb_ir.matrix(), calibration_.T_rgb_ir.matrix());
  EXPECT_EQ(device.calibration().rgb, calibration_.rgb);
  for (const DeviceFrame& expected : frames) {
    const std::optional<DeviceFrame> found = device.next_frame();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->raw_disparity, expected.raw_disparity);
    EXPECT_EQ(found->color, expected.color);
    EXPECT_EQ(found->depth_timestamp_us, expected.depth_timestamp_us);
    EXPECT_EQ(found->color_timestamp_us, expected.color_timestamp_us);
  }
  EXPECT_FALSE(device.next_frame());
  EXPECT_FALSE(device.next_frame());
}

TEST_F(Recording, ListsItsFilesInOrderOfTime) {
  record({frame(1'000'001, 1'004'000), frame(1'066'667, 1'060'000)});
  EXPECT_EQ(read_file(path("INDEX.txt")),
            "d-1.000001-60000060.pgm\nr-1.004000-60240000.ppm\nr-1.060000-63600000.ppm\nd-1.066667-64000020.pgm\n");
}

TEST_F(Recording, KeepsAColorImageThatTwoDepthImagesShareOnce) {
  DeviceFrame first = frame(1'000'000, 1'010'000), second = frame(1'033'000, 1'010'000);
  second.color = first.color;
  record({first, second});
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2 + 1 + 3);
  RecordingDevice device(folder_);
  EXPECT_EQ(device.next_frame()->color, first.color);
  EXPECT_EQ(device.next_frame()->color, first.color);
}

TEST_F(Recording, PairsTheNearestInTime) {
  record({frame(1'000'000, 1'001'000), frame(1'100'000, 1'101'000)});
  // As fakenect dumps are: depth alone at first, unsorted, with accelerometer lines; and one depth between.
  const std::string depth = read_file(path("d-1.000000-60000000.pgm"));
  write_file(path("d-0.500000-30000000.pgm"), depth);
  write_file(path("d-1.051000-63060000.pgm"), depth);  // as near to 1.001 as to 1.101: the earlier
  write_file(path("INDEX.txt"), "d-0.500000-30000000.pgm\na-0.6000000-5.dump\n");
  EXPECT_TRUE(mentions(play_error(), "INDEX.txt, line 2: file name"));  // seven digits
  write_file(path("INDEX.txt"),
             "d-1.100000-66000000.pgm\nd-0.500000-30000000.pgm\na-0.600000-5.dump\nr-1.101000-66060000.ppm\n"
             "d-1.051000-63060000.pgm\nd-1.000000-60000000.pgm\nr-1.001000-60060000.ppm\n");
  RecordingDevice device(folder_);
  EXPECT_EQ(device.unpaired_depth_count(), 1);
  for (const auto& [depth_us, color_us] :
       {std::pair{1'000'000, 1'001'000}, {1'051'000, 1'001'000}, {1'100'000, 1'101'000}}) {
    const std::optional<DeviceFrame> found = device.next_frame();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->depth_timestamp_us, depth_us);
    EXPECT_EQ(found->color_timestamp_us, color_us);
  }
}

TEST_F(Recording, GoesByTheClockOfTheDevice) {
  record({frame(1'000'000, 1'001'000), frame(1'033'000, 1'034'000)});
  // The first color image was taken beside the first depth image and arrived beside the second.
  fs::rename(path("r-1.001000-60060000.ppm"), path("r-1.033000-60060000.ppm"));
  fs::rename(path("r-1.034000-62040000.ppm"), path("r-1.066000-62040000.ppm"));
  write_file(
      path("INDEX.txt"),
      "d-1.000000-60000000.pgm\nr-1.033000-60060000.ppm\nd-1.033000-61980000.pgm\nr-1.066000-62040000.ppm\n");
  RecordingDevice device(folder_);
  for (const auto& [depth_us, color_us] : {std::pair{1'000'000, 1'001'000}, {1'033'000, 1'034'000}}) {
    const std::optional<DeviceFrame> found = device.next_frame();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->depth_timestamp_us, depth_us);
    EXPECT_EQ(found->color_timestamp_us, color_us);
  }
}

TEST_F(Recording, KeepsItsTimeWhereTheClockOfTheDeviceComesAround) {
  const int64_t start_us = 1'700'000'000'123'457;  // many rounds of 71.6 s
  const std::vector<int64_t> times = {start_us, start_us + 30'000'000, start_us + 60'000'000,
                                      start_us + 90'000'000};
  std::vector<DeviceFrame> frames;
  for (int64_t time_us : times) frames.push_back(frame(time_us, time_us + 1));
  record(frames);
  RecordingDevice device(folder_);
  for (int64_t time_us : times) EXPECT_EQ(device.next_frame()->depth_timestamp_us, time_us);
}

TEST_F(Recording, KeepsItsTimeAcrossLongPauses) {
  const std::vector<int64_t> times = {1'000'000, 41'000'000, 141'000'000, 141'033'333};
  for (const int64_t late_us : {0, 30'000'000}) {  // how far the arrival is behind the device's clock
    std::string index;
    for (int64_t time_us : times) {
      const std::string ticks = std::to_string(static_cast<uint32_t>(time_us * 60));
      for (const char* form : {"d-{}.{:06}-{}.pgm", "r-{}.{:06}-{}.ppm"})
        index +=
            fmt::format(fmt::runtime(form), (time_us + late_us) / 1'000'000, time_us % 1'000'000, ticks) + "\n";
    }
    const std::vector<RecordingEntry> entries = parse_recording_index(index, folder_);
    ASSERT_EQ(entries.size(), 2 * times.size());
    const int64_t first_us = entries[0].timestamp_us;
    for (size_t i = 0; i < entries.size(); ++i)
      EXPECT_EQ(entries[i].timestamp_us - first_us, times[i / 2] - times[0]) << entries[i].name;
  }
}

TEST_F(Recording, CountsImagesWhoseTicksAreThoseOfTheOneBefore) {
  record({frame(1'000'000, 1'001'000), frame(1'033'000, 1'034'000)});
  fs::copy(path("d-1.000000-60000000.pgm"), path("d-1.010000-60000000.pgm"));
  write_file(path("INDEX.txt"), read_file(path("INDEX.txt")) + "d-1.010000-60000000.pgm\n");
  RecordingDevice device(folder_);
  EXPECT_EQ(device.frame_count(), 2);
  EXPECT_EQ(device.repeated_count(), 1);
  EXPECT_EQ(device.unpaired_depth_count(), 0);
}

TEST_F(Recording, GoesOnAfterAFrameThatIsDamaged) {
  record({frame(1'000'000, 1'001'000), frame(1'033'000, 1'034'000), frame(1'066'000, 1'067'000)});
  write_file(path("d-1.033000-61980000.pgm"), "P5");
  RecordingDevice device(folder_);
  EXPECT_TRUE(device.next_frame());
  EXPECT_THROW(device.next_frame(), FrameError);
  EXPECT_EQ(device.next_frame()->depth_timestamp_us, 1'066'000);
}

TEST_F(Recording, NoticesAnImageThatIsAnother) {
  record({frame(1'000'000, 1'001'000)});
  std::string color = read_file(path("r-1.001000-60060000.ppm"));
  color.back() = static_cast<char>(color.back() ^ 1);
  write_file(path("r-1.001000-60060000.ppm"), color);
  EXPECT_TRUE(mentions(play_error(), "r-1.001000-60060000.ppm: content: found a missing, changed or damaged file"));
  fs::remove(path("manifest.json"));
  EXPECT_EQ(play_error(), "") << "a recording of fakenect's own";
}

TEST_F(Recording, RefusesAPipeInsteadOfWaitingForItsWriter) {
  record({frame(1'000'000, 1'001'000)});
  for (const std::string name :
       {"INDEX.txt", "calibration.json", "manifest.json", "d-1.000000-60000000.pgm", "r-1.001000-60060000.ppm"}) {
    fs::rename(path(name), path("away"));
    ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
    EXPECT_TRUE(mentions(play_error(), name + ": file: found a pipe")) << play_error();
    fs::remove(path(name));
    fs::rename(path("away"), path(name));
  }
}

TEST_F(Recording, TakesACalibrationFromElsewhere) {
  record({frame(1'000'000, 1'001'000)});
  fs::remove(path("calibration.json"));
  EXPECT_TRUE(mentions(play_error(), "calibration.json: file"));
  RecordingDevice device(folder_, calibration_);
  EXPECT_EQ(device.next_frame()->raw_disparity, frame(1'000'000, 1'001'000).raw_disparity);
}

TEST_F(Recording, NamesTheFileThatIsMissingOrDamaged) {
  record({frame(1'000'000, 1'001'000)});
  const std::string depth = "d-1.000000-60000000.pgm", color = "r-1.001000-60060000.ppm";
  const auto error_with = [&](const std::string& name, const std::string& content) {
    const std::string good = read_file(path(name));
    write_file(path(name), content);
    const std::string error = play_error();
    write_file(path(name), good);
    return error;
  };
  ASSERT_EQ(play_error(), "");
  const std::string depth_content = read_file(path(depth)), color_content = read_file(path(color));
  EXPECT_TRUE(mentions(error_with(depth, ""), depth + ": header: found an empty file"));
  EXPECT_TRUE(mentions(error_with(depth, "P5 32 24 255\n" + std::string(1536, 0)), depth + ": header"));
  EXPECT_TRUE(mentions(error_with(depth, depth_content + "x"), depth + ": size: found 1537 bytes of pixels"));
  EXPECT_TRUE(mentions(error_with(color, color_content.substr(0, 1000)), color + ": size"));
  std::string twelve_bits = depth_content;
  twelve_bits.back() = 8;  // the high byte of the last pixel
  EXPECT_TRUE(mentions(error_with(depth, twelve_bits), depth + ": pixel (31, 23)"));
  EXPECT_TRUE(mentions(error_with("INDEX.txt", ""), "INDEX.txt: frames: found 0 depth and 0 color images"));
  EXPECT_TRUE(mentions(error_with("INDEX.txt", depth + "\n" + depth + "\n" + color + "\n"), depth + " twice"));
  EXPECT_TRUE(mentions(error_with("calibration.json", "{}"), "calibration.json: version: found nothing"));
  for (const std::string& name : {depth, color, std::string("INDEX.txt"), std::string("calibration.json")}) {
    fs::rename(path(name), path("away"));
    EXPECT_TRUE(mentions(play_error(), name + ": file")) << name;
    fs::rename(path("away"), path(name));
  }
}

TEST_F(Recording, SurvivesTruncationsAndByteFlips) {
  record({frame(1'000'000, 1'001'000), frame(1'033'000, 1'034'000)});
  const std::vector<std::string> names = {"INDEX.txt", "calibration.json", "d-1.000000-60000000.pgm",
                                          "r-1.034000-62040000.ppm"};
  RandomStream random(2, "recording", 0, "damage");
  int truncations_noticed = 0;
  for (int i = 0; i < 200; ++i) {
    const std::string& name = names[random.index(names.size())];
    const std::string good = read_file(path(name));
    std::string bad = good;
    const bool truncate = i % 2 == 0;
    if (truncate) {
      // Not the last byte alone: a text without its final line feed means the same.
      bad.resize(random.index(bad.size() - 1));
    } else {
      // The first bytes hold the header; flips there matter most.
      const size_t at = random.index(i % 4 == 1 ? 16 : bad.size());
      bad[at] = static_cast<char>(bad[at] ^ (1 << random.index(8)));
    }
    write_file(path(name), bad);
    const std::string error = play_error();  // anything but an Error would end the test
    EXPECT_FALSE(mentions(error, "\n")) << error;
    // An index cut between two lines is a shorter recording; all other truncations must be told.
    if (truncate && name != "INDEX.txt") {
      EXPECT_TRUE(mentions(error, name)) << name << " cut to " << bad.size();
      ++truncations_noticed;
    }
    write_file(path(name), good);
  }
  EXPECT_GT(truncations_noticed, 50);
  EXPECT_EQ(play_error(), "");
}

TEST_F(Recording, SaysWhatWasChangedSinceAndPlaysOn) {
  record({frame(1'000'000, 1'001'000), frame(1'033'000, 1'034'000)});
  EXPECT_EQ(RecordingDevice(folder_).changed(), std::vector<std::string>());
  write_file(path("calibration.json"), read_file(path("calibration.json")) + " ");
  EXPECT_EQ(RecordingDevice(folder_).changed(), std::vector<std::string>{"calibration.json"});
  write_file(path("INDEX.txt"), "d-1.000000-60000000.pgm\nr-1.001000-60060000.ppm\n");
  const RecordingDevice device(folder_);
  EXPECT_EQ(device.changed(), (std::vector<std::string>{"calibration.json", "INDEX.txt"}));
  EXPECT_EQ(device.frame_count(), 1);
  EXPECT_EQ(play_error(), "");
  EXPECT_EQ(RecordingDevice(folder_, calibration_).changed(), std::vector<std::string>{"INDEX.txt"}) << "not read";
  fs::remove(path("manifest.json"));
  EXPECT_EQ(RecordingDevice(folder_).changed(), std::vector<std::string>());
}

TEST_F(Recording, WriterLeavesNothingWithoutFinish) {
  {
    RecordingWriter writer(folder_, calibration_);
    writer.write(frame(1'000'000, 1'001'000));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Recording, PlaysWhatAKillLeftUnmoved) {
  record({frame(1'000'000, 1'001'000)});
  fs::create_directories(path(".staged"));
  for (const char* name : {"INDEX.txt", "calibration.json", "d-1.000000-60000000.pgm"})
    fs::rename(path(name), path(".staged/") + name);
  EXPECT_EQ(play_error(), "");
}

TEST_F(Recording, WriterRefusesWhatNoKinectGives) {
  record({frame(1'000'000, 1'001'000)});
  EXPECT_THROW(RecordingWriter(folder_, calibration_), Error);  // would overwrite
  fs::remove_all(folder_);

  RecordingWriter writer(folder_, calibration_);
  EXPECT_THROW(writer.finish(), Error);
  EXPECT_THROW(writer.write(frame(-1, 0)), Error);
  writer.write(frame(1'000'000, 1'001'000));
  EXPECT_THROW(writer.write(frame(1'000'000, 1'034'000)), Error);
  EXPECT_THROW(writer.write(frame(1'033'000, 1'000'999)), Error);
  DeviceFrame twelve_bits = frame(1'033'000, 1'034'000);
  twelve_bits.raw_disparity(3, 3) = 2048;
  EXPECT_THROW(writer.write(twelve_bits), Error);
  DeviceFrame small = frame(1'033'000, 1'034'000);
  small.color = ColorImage(8, 8);
  EXPECT_THROW(writer.write(small), Error);
}

}  // namespace
}  // namespace glovebench
