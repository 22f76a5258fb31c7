#include "eval/sources/ros_recording.h"

#include <gmock/gmock.h>
#include <lz4frame.h>
#include <zstd.h>

#include <limits>

#include "core/base/error.h"
#include "core/test_error.h"
#include "eval/frame_formats/ros2_messages.h"
#include "eval/sources/test_message_files.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr PinholeCamera kSmall = {4, 3, 10, 11, 1.5, 1};
constexpr const char *kImageType = "sensor_msgs/msg/Image", *kInfoType = "sensor_msgs/msg/CameraInfo";

DepthImage small_depth() {
  DepthImage depth(4, 3);
  depth(1, 2) = 0.7f;
  depth(3, 0) = 65.535f;
  return depth;
}
ColorImage small_color() {
  ColorImage color(4, 3, Rgb{1, 2, 3});
  color(2, 1) = {250, 0, 9};
  return color;
}

enum TestTopic : uint16_t { kColorTopic, kColorInfoTopic, kDepthTopic, kDepthInfoTopic, kTransformsTopic };

std::string small_topics(const std::string& image_type = kImageType) {
  return mcap_topic(kColorTopic, "/camera/color/image_raw", image_type) +
         mcap_topic(kColorInfoTopic, "/camera/color/camera_info", kInfoType) +
         mcap_topic(kDepthTopic, "/camera/depth/image_rect_raw", kImageType) +
         mcap_topic(kDepthInfoTopic, "/camera/depth/camera_info", kInfoType) +
         mcap_topic(kTransformsTopic, "/tf_static", "tf2_msgs/msg/TFMessage");
}

std::string small_images() {
  return mcap_message(kColorTopic, ros_image({40'000, "color"}, small_color())) +
         mcap_message(kDepthTopic, ros_depth_image({33'000, "depth"}, small_depth()));
}

std::string camera_infos() {
  return mcap_message(kColorInfoTopic, ros_camera_info({0, "color"}, kSmall)) +
         mcap_message(kDepthInfoTopic, ros_camera_info({0, "depth"}, kSmall));
}

/// The color camera lies 20 mm to the right of the depth camera, both in a frame "link".
std::string transforms() {
  const Eigen::Isometry3d color(Eigen::Translation3d(0.03, 0, 0)), depth(Eigen::Translation3d(0.01, 0, 0));
  return mcap_message(kTransformsTopic, ros_transform({0, "link"}, "color", color)) +
         mcap_message(kTransformsTopic, ros_transform({0, "link"}, "depth", depth));
}

RosIndex index_of(const std::string& records, const ImageTopics& topics = {}) {
  return index_recording(mcap_file(records), topics, "a.mcap");
}
RgbdCalibration calibration_from(const std::string& records) {
  return calibration_of(index_of(records), {}, "a.mcap");
}

/// Reads the only frame back.
void expect_small_frame(const std::string& file) {
  const RosIndex index = index_recording(file, {}, "a.mcap");
  ASSERT_THAT(index.depth.times_us, ElementsAre(33'000));
  ASSERT_THAT(index.color.times_us, ElementsAre(40'000));
  MessageReader reader(file, "a.mcap");
  const auto image = [&](const RosImages& images) {
    return parse_ros_image({reader.at(images.places[0]), images.encoding}, "a");
  };
  EXPECT_EQ(depth_of(image(index.depth), "a"), small_depth());
  EXPECT_EQ(color_of(image(index.color), "a"), small_color());
}

std::string zstd_chunk(const std::string& records, uint64_t claimed) {
  std::string packed(ZSTD_compressBound(records.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), records.data(), records.size(), 1));
  return mcap_chunk("zstd", packed, claimed);
}
std::string lz4_chunk(const std::string& records, uint64_t claimed) {
  std::string packed(LZ4F_compressFrameBound(records.size(), nullptr), '\0');
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), records.data(), records.size(), nullptr));
  return mcap_chunk("lz4", packed, claimed);
}

TEST(RosRecording, ReadsPlainAndCompressedChunks) {
  const std::string images = small_images(), records = small_topics() + images;
  expect_small_frame(mcap_file(records));
  expect_small_frame(mcap_file(mcap_chunk("", records, records.size())));
  expect_small_frame(mcap_file(zstd_chunk(records, records.size())));
  expect_small_frame(mcap_file(lz4_chunk(records, records.size())));
  expect_small_frame(mcap_file(small_topics() + zstd_chunk(images, images.size())));
}

TEST(RosRecording, RefusesChunksThatAreDamagedOrLarge) {
  const std::string records = small_topics() + small_images();
  const auto refusal = [](const std::string& chunk) { return thrown_by([&] { index_of(chunk); }); };
  EXPECT_THAT(refusal(mcap_chunk("", records, records.size(), 77)),
              HasSubstr("chunk at byte 8: found damaged data"));
  EXPECT_THAT(refusal(mcap_chunk("br", records, records.size())), HasSubstr("found \"br\", expected zstd, lz4"));
  EXPECT_THAT(refusal(mcap_chunk("", records, (12 << 20) + 1)), HasSubstr("12582913 bytes unpacked"));
  for (const int more : {-1, 1}) {
    EXPECT_THAT(refusal(mcap_chunk("", records, records.size() + more)), HasSubstr("found damaged data, expected"));
    EXPECT_THAT(refusal(zstd_chunk(records, records.size() + more)),
                HasSubstr("a.mcap: chunk at byte 8: found damaged data, expected"));
    EXPECT_THAT(refusal(lz4_chunk(records, records.size() + more)),
                HasSubstr("a.mcap: chunk at byte 8: found damaged data, expected"));
  }
}

TEST(RosRecording, RefusesEveryFileThatIsCutOffInOneLine) {
  const std::string chunk = small_images();
  const std::string whole =
      mcap_file(small_topics() + camera_infos() + transforms() + zstd_chunk(chunk, chunk.size()));
  ASSERT_NO_THROW(index_recording(whole, {}, "a.mcap"));
  const size_t data_end = whole.size() - 13;
  for (size_t size = 0; size < data_end; ++size) {
    const std::string refused = thrown_by([&] { index_recording(whole.substr(0, size), {}, "a.mcap"); });
    ASSERT_THAT(refused, testing::StartsWith("a.mcap: ")) << size;
    ASSERT_THAT(refused, HasSubstr(", expected ")) << size;
  }
}

TEST(RosRecording, DamagedMessagesAreErrors) {
  const std::string image = ros_depth_image({33'000, "depth"}, small_depth());
  for (size_t size = 0; size < image.size(); ++size)
    ASSERT_THROW(depth_of(parse_ros_image({image.substr(0, size)}, "a"), "a"), Error) << size;
  const std::string info = ros_camera_info({0, "color"}, kSmall);
  for (size_t size = 0; size + 25 < info.size(); ++size)  // binning and region of interest are not read
    ASSERT_THROW(parse_ros_camera({info.substr(0, size)}, "a"), Error) << size;
}

TEST(RosRecording, TellsWhichImagesThereAre) {
  const auto refusal = [](const std::string& records, const ImageTopics& topics = {}) {
    return thrown_by([&] { index_of(records, topics); });
  };
  EXPECT_THAT(refusal(small_topics() + small_images(), {"/a", "/b"}),
              AllOf(HasSubstr("found /camera/color/image_raw, /camera/depth/image_rect_raw, expected /a and /b"),
                    HasSubstr("--topics color=TOPIC,depth=TOPIC")));
  EXPECT_THAT(refusal(""), HasSubstr("images: found none"));
  EXPECT_THAT(refusal(small_topics("sensor_msgs/msg/CompressedImage") + small_images()),
              HasSubstr("/camera/color/image_raw: found sensor_msgs/msg/CompressedImage (cdr), expected "
                        "sensor_msgs/Image (cdr or ros1)"));
  EXPECT_THAT(refusal(small_images()), HasSubstr("a message of channel 0"));
  EXPECT_THAT(refusal(mcap_topic(0, "/two\nlines", kImageType)),
              HasSubstr("found \"/two\\nlines\", expected a name"));
  EXPECT_THAT(thrown_by([] { index_recording("GIF89a", {}, "a.gif"); }),
              HasSubstr("a.gif: content: found neither"));
}

TEST(RosRecording, CalibratesByCameraInfoAndTransforms) {
  const RgbdCalibration found = calibration_from(small_topics() + small_images() + camera_infos() + transforms());
  EXPECT_EQ(found.ir, kSmall);
  EXPECT_EQ(found.rgb, kSmall);
  EXPECT_FALSE(found.has_lens());
  EXPECT_TRUE(found.T_rgb_ir.isApprox(Eigen::Isometry3d(Eigen::Translation3d(-0.02, 0, 0)), 1e-9));
  const std::string registered = mcap_message(kColorTopic, ros_image({0, "color"}, small_color())) +
                                 mcap_message(kDepthTopic, ros_depth_image({0, "color"}, small_depth()));
  EXPECT_TRUE(calibration_from(small_topics() + registered + camera_infos()).T_rgb_ir.matrix().isIdentity(1e-12));
}

TEST(RosRecording, NamesWhatACalibrationLacks) {
  const auto refusal = [](const std::string& more) {
    return thrown_by([&] { calibration_from(small_topics() + small_images() + more); });
  };
  EXPECT_THAT(refusal(""), HasSubstr("/camera/depth/camera_info: found nothing"));
  EXPECT_THAT(refusal(camera_infos()), HasSubstr("/tf_static: found none from \"depth\" to \"color\""));
  const std::string loop =
      mcap_message(kTransformsTopic, ros_transform({0, "depth"}, "depth", Eigen::Isometry3d::Identity()));
  EXPECT_THAT(refusal(camera_infos() + loop), HasSubstr("/tf_static: found none"));
  PinholeCamera bad = kSmall;
  for (const double fx : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    bad.fx = fx;
    EXPECT_THAT(
        refusal(mcap_message(kColorInfoTopic, ros_camera_info({0, "color"}, bad)) + camera_infos() + transforms()),
        HasSubstr("a.mcap: rgb.fx_px"))
        << fx;
  }
}

FieldBytes ros1_head(std::string_view frame) {
  return FieldBytes().put(uint32_t{7}).put(uint32_t{1}).put(uint32_t{500'000}).text(frame);
}
template <typename Pixel>
std::string ros1_image(std::string_view frame, const Image<Pixel>& image, std::string_view encoding) {
  const auto row = static_cast<uint32_t>(image.width() * sizeof(Pixel));
  return ros1_head(frame)
      .put(uint32_t(image.height()))
      .put(uint32_t(image.width()))
      .text(encoding)
      .put(uint8_t{0})
      .put(row)
      .text({reinterpret_cast<const char*>(image.data()), size_t{row} * image.height()})
      .bytes();
}
std::string ros1_camera(double k1) {
  FieldBytes bytes = ros1_head("").put(uint32_t{3}).put(uint32_t{4}).text("plumb_bob").put(uint32_t{5});
  const PinholeCamera& c = kSmall;
  for (const double d : {k1, 0., 0., 0., 0.}) bytes.put(d);
  for (const double k : {c.fx, 0., c.cx, 0., c.fy, c.cy, 0., 0., 1.}) bytes.put(k);
  for (const double r : {1., 0., 0., 0., 1., 0., 0., 0., 1.}) bytes.put(r);
  for (const double p : {c.fx, 0., c.cx, 0., 0., c.fy, c.cy, 0., 0., 0., 1., 0.}) bytes.put(p);
  return bytes.bytes();
}
std::string ros1_transform() {
  FieldBytes bytes = FieldBytes().put(uint32_t{1}).raw(ros1_head("depth").bytes()).text("color");
  for (const double number : {0.02, 0., 0., 0., 0., 0., 1.}) bytes.put(number);
  return bytes.bytes();
}

std::string small_bag_records() {
  Image<uint16_t> mm(4, 3);
  mm(1, 2) = 700;
  return bag_topic(0, "/camera/color/image_raw", "sensor_msgs/Image") +
         bag_topic(1, "/camera/color/camera_info", "sensor_msgs/CameraInfo") +
         bag_topic(2, "/camera/depth/image_rect_raw", "sensor_msgs/Image") +
         bag_topic(3, "/camera/depth/camera_info", "sensor_msgs/CameraInfo") +
         bag_topic(4, "/tf_static", "tf2_msgs/TFMessage") + bag_message(1, ros1_camera(0.1)) +
         bag_message(3, ros1_camera(0.1)) + bag_message(4, ros1_transform()) +
         bag_message(0, ros1_image("color", small_color(), "rgb8")) +
         bag_message(2, ros1_image("depth", mm, "mono16"));
}

TEST(RosRecording, ReadsBagsOfRos1) {
  const std::string records = small_bag_records();
  std::string lz4(LZ4F_compressFrameBound(records.size(), nullptr), '\0');
  lz4.resize(LZ4F_compressFrame(lz4.data(), lz4.size(), records.data(), records.size(), nullptr));
  const auto size = static_cast<uint32_t>(records.size());
  for (const std::string& file :
       {bag_file(records), bag_file(bag_chunk("none", records, size)), bag_file(bag_chunk("lz4", lz4, size))}) {
    const RosIndex index = index_recording(file, {}, "a.bag");
    EXPECT_THAT(index.depth.times_us, ElementsAre(1'000'500));
    MessageReader reader(file, "a.bag");
    const DepthImage depth =
        depth_of(parse_ros_image({reader.at(index.depth.places[0]), RosEncoding::ros1}, "a"), "a");
    EXPECT_FLOAT_EQ(depth(1, 2), 0.7f);
    EXPECT_EQ(std::ranges::count(depth, 0.0f), 11);
    EXPECT_EQ(color_of(parse_ros_image({reader.at(index.color.places[0]), RosEncoding::ros1}, "a"), "a"),
              small_color());
    const RgbdCalibration found = calibration_of(index, {}, "a.bag");
    EXPECT_EQ(found.rgb, kSmall);
    EXPECT_EQ(found.rgb_lens.k1, 0.1);
    EXPECT_TRUE(found.ir_lens.is_none()) << "its images are rectified";
    EXPECT_TRUE(found.T_rgb_ir.isApprox(Eigen::Isometry3d(Eigen::Translation3d(-0.02, 0, 0)), 1e-9));
  }
}

TEST(RosRecording, RefusesBagsThatAreCutOffOrCompressedByBzip2) {
  const std::string records = small_bag_records(), whole = bag_file(records);
  const auto refusal = [](const std::string& file) {
    return thrown_by([&] { index_recording(file, {}, "a.bag"); });
  };
  ASSERT_EQ(refusal(whole), "");
  for (size_t size = 0; size < whole.size(); ++size) {
    ASSERT_THAT(refusal(whole.substr(0, size)), testing::StartsWith("a.bag: ")) << size;
    ASSERT_THAT(refusal(whole.substr(0, size)), HasSubstr(", expected ")) << size;
  }
  EXPECT_THAT(refusal(bag_file(records, false)),
              HasSubstr("a.bag: index: found none, expected a whole bag (`rosbag"));
  EXPECT_THAT(refusal(bag_file(bag_chunk("bz2", records, 10))), HasSubstr("found \"bz2\", expected zstd, lz4"));
  EXPECT_THAT(refusal(bag_file(bag_message(9, ""))), HasSubstr("connection 9"));
  EXPECT_THAT(refusal(bag_file(bag_record(2, "", ""))), HasSubstr("found no conn"));
}

TEST(RosImages, EncodingsAreRead) {
  RosImage image = {.head = {}, .width = 1, .height = 2, .encoding = "bgr8", .step = 4, .bytes = {}};
  image.bytes = "abc.def.";
  EXPECT_EQ(color_of(image, "a")(0, 1), (Rgb{'f', 'e', 'd'}));
  image.encoding = "mono8";
  EXPECT_THAT(thrown_by([&] { color_of(image, "a"); }), HasSubstr("found \"mono8\", expected rgb8 or bgr8"));
  EXPECT_THAT(thrown_by([&] { depth_of(image, "a"); }), HasSubstr("expected 16UC1, mono16 or 32FC1"));
  const std::array<float, 2> meters = {std::numeric_limits<float>::quiet_NaN(), 0.75f};
  image.encoding = "32FC1";
  image.bytes = {reinterpret_cast<const char*>(meters.data()), sizeof meters};
  EXPECT_EQ(depth_of(image, "a")(0, 0), 0.0f);
  EXPECT_EQ(depth_of(image, "a")(0, 1), 0.75f);
  image.step = 3;
  EXPECT_THROW(depth_of(image, "a"), Error);
}

TEST(ImageTopics, AreReadFromText) {
  EXPECT_EQ(parse_image_topics("").color, ImageTopics().color);
  EXPECT_EQ(parse_image_topics("depth=/b,color=/a").color, "/a");
  EXPECT_EQ(parse_image_topics("depth=/b").depth, "/b");
  EXPECT_EQ(parse_image_topics("depth=/b").color, ImageTopics().color);
  for (const char* wrong : {"/a", "color=", "color=/a,,depth=/b", "colour=/a"})
    EXPECT_THROW(parse_image_topics(wrong), Error) << wrong;
}

}  // namespace
}  // namespace glovebench::eval
