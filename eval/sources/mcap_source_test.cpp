#include "eval/sources/mcap_source.h"

#include <gmock/gmock.h>
#include <lz4frame.h>
#include <zstd.h>

#include <limits>

#include "core/base/error.h"
#include "eval/frame_formats/ros2_messages.h"
#include "eval/sources/test_mcap.h"

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

McapIndex index_of(const std::string& records, const ImageTopics& topics = {}) {
  return index_mcap(mcap_file(records), topics, "a.mcap");
}
RgbdCalibration calibration_from(const std::string& records) {
  return calibration_of(index_of(records), {}, "a.mcap");
}

template <typename Read>
std::string mcap_refusal(const Read& read) {
  try {
    read();
  } catch (const Error& e) {
    return e.what();
  }
  return "nothing";
}

/// Reads the only frame back.
void expect_small_frame(const std::string& records) {
  const std::string file = mcap_file(records);
  const McapIndex index = index_mcap(file, {}, "a.mcap");
  ASSERT_THAT(index.depth.times_us, ElementsAre(33'000));
  ASSERT_THAT(index.color.times_us, ElementsAre(40'000));
  McapMessages messages(file, "a.mcap");
  EXPECT_EQ(depth_of(parse_ros_image(messages.at(index.depth.places[0]), "a"), "a"), small_depth());
  EXPECT_EQ(color_of(parse_ros_image(messages.at(index.color.places[0]), "a"), "a"), small_color());
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

TEST(McapSource, ReadsPlainAndCompressedChunks) {
  const std::string images = small_images(), records = small_topics() + images;
  expect_small_frame(records);
  expect_small_frame(mcap_chunk("", records, records.size()));
  expect_small_frame(zstd_chunk(records, records.size()));
  expect_small_frame(lz4_chunk(records, records.size()));
  expect_small_frame(small_topics() + zstd_chunk(images, images.size()));
}

TEST(McapSource, RefusesChunksThatAreDamagedOrLarge) {
  const std::string records = small_topics() + small_images();
  const auto refusal = [](const std::string& chunk) { return mcap_refusal([&] { index_of(chunk); }); };
  EXPECT_THAT(refusal(mcap_chunk("", records, records.size(), 77)),
              HasSubstr("chunk at byte 8: found damaged data"));
  EXPECT_THAT(refusal(mcap_chunk("br", records, records.size())), HasSubstr("found \"br\", expected zstd, lz4"));
  EXPECT_THAT(refusal(mcap_chunk("", records, (12 << 20) + 1)), HasSubstr("12582913 bytes unpacked"));
  for (const int more : {-1, 1}) {
    EXPECT_THAT(refusal(mcap_chunk("", records, records.size() + more)), HasSubstr("bytes, expected"));
    EXPECT_THAT(refusal(zstd_chunk(records, records.size() + more)), HasSubstr("damaged zstd data"));
    EXPECT_THAT(refusal(lz4_chunk(records, records.size() + more)), HasSubstr("a.mcap: chunk at byte 8: found"));
  }
}

TEST(McapSource, RefusesEveryFileThatIsCutOffInOneLine) {
  const std::string chunk = small_images();
  const std::string whole =
      mcap_file(small_topics() + camera_infos() + transforms() + zstd_chunk(chunk, chunk.size()));
  ASSERT_NO_THROW(index_mcap(whole, {}, "a.mcap"));
  const size_t data_end = whole.size() - 13;
  for (size_t size = 0; size < data_end; ++size) {
    const std::string refused = mcap_refusal([&] { index_mcap(whole.substr(0, size), {}, "a.mcap"); });
    ASSERT_THAT(refused, testing::StartsWith("a.mcap: ")) << size;
    ASSERT_THAT(refused, HasSubstr(", expected ")) << size;
  }
}

TEST(McapSource, DamagedMessagesAreErrors) {
  const std::string image = ros_depth_image({33'000, "depth"}, small_depth());
  for (size_t size = 0; size < image.size(); ++size)
    ASSERT_THROW(depth_of(parse_ros_image(image.substr(0, size), "a"), "a"), Error) << size;
  const std::string info = ros_camera_info({0, "color"}, kSmall);
  for (size_t size = 0; size + 25 < info.size(); ++size)  // binning and region of interest are not read
    ASSERT_THROW(parse_ros_camera(info.substr(0, size), "a"), Error) << size;
}

TEST(McapSource, TellsWhichImagesThereAre) {
  const auto refusal = [](const std::string& records, const ImageTopics& topics = {}) {
    return mcap_refusal([&] { index_of(records, topics); });
  };
  EXPECT_THAT(refusal(small_topics() + small_images(), {"/a", "/b"}),
              AllOf(HasSubstr("found /camera/color/image_raw, /camera/depth/image_rect_raw, expected /a and /b"),
                    HasSubstr("--topics color=TOPIC,depth=TOPIC")));
  EXPECT_THAT(refusal(""), HasSubstr("images: found none"));
  EXPECT_THAT(refusal(small_topics("sensor_msgs/msg/CompressedImage") + small_images()),
              HasSubstr("/camera/color/image_raw: found sensor_msgs/msg/CompressedImage (cdr), expected " +
                        std::string(kImageType)));
  EXPECT_THAT(refusal(small_images()), HasSubstr("a message of channel 0"));
  EXPECT_THAT(mcap_refusal([] { index_mcap("GIF89a", {}, "a.gif"); }),
              HasSubstr("a.gif: content: found no MCAP file"));
}

TEST(McapSource, CalibratesByCameraInfoAndTransforms) {
  const RgbdCalibration found = calibration_from(small_topics() + small_images() + camera_infos() + transforms());
  EXPECT_EQ(found.ir, kSmall);
  EXPECT_EQ(found.rgb, kSmall);
  EXPECT_FALSE(found.has_lens());
  EXPECT_TRUE(found.T_rgb_ir.isApprox(Eigen::Isometry3d(Eigen::Translation3d(-0.02, 0, 0)), 1e-9));
  const std::string registered = mcap_message(kColorTopic, ros_image({0, "color"}, small_color())) +
                                 mcap_message(kDepthTopic, ros_depth_image({0, "color"}, small_depth()));
  EXPECT_TRUE(calibration_from(small_topics() + registered + camera_infos()).T_rgb_ir.matrix().isIdentity(1e-12));
}

TEST(McapSource, NamesWhatACalibrationLacks) {
  const auto refusal = [](const std::string& more) {
    return mcap_refusal([&] { calibration_from(small_topics() + small_images() + more); });
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

TEST(RosImages, EncodingsAreRead) {
  RosImage image = {
      .timestamp_us = 0, .frame = "", .width = 1, .height = 2, .encoding = "bgr8", .step = 4, .bytes = {}};
  image.bytes = "abc.def.";
  EXPECT_EQ(color_of(image, "a")(0, 1), (Rgb{'f', 'e', 'd'}));
  image.encoding = "mono8";
  EXPECT_THAT(mcap_refusal([&] { color_of(image, "a"); }), HasSubstr("found \"mono8\", expected rgb8 or bgr8"));
  EXPECT_THAT(mcap_refusal([&] { depth_of(image, "a"); }), HasSubstr("expected 16UC1, mono16 or 32FC1"));
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
