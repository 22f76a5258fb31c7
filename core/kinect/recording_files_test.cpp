#include "core/kinect/recording_files.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "core/base/error.h"

namespace glovebench {
namespace {

TEST(RecordedName, HoldsMicrosecondsExactly) {
  // 12.000345 s are 720,020,700 ticks of 60 MHz.
  EXPECT_EQ(recorded_name({RecordedKind::depth, 12'000'345}), "d-12.000345-720020700.pgm");
  for (int64_t timestamp_us : {int64_t{0}, int64_t{999'999}, int64_t{1'000'000}, int64_t{1'700'000'000'123'457}}) {
    const RecordedName parsed =
        parse_recorded_name(recorded_name({RecordedKind::color, timestamp_us}), "INDEX.txt");
    EXPECT_EQ(parsed.timestamp_us, timestamp_us);
    EXPECT_EQ(parsed.kind, RecordedKind::color);
  }
}

TEST(RecordedName, IsParsedStrictly) {
  EXPECT_NO_THROW(parse_recorded_name("a-1299626063.123456-3941023.dump", "INDEX.txt"));
  for (const char* name : {"", "d", "x-1.000000-1.pgm", "d-1.000000-1.ppm", "d-1.000-1.pgm", "d-1.000000-1.pgm ",
                           "d--1.000000-1.pgm", "d-1.000000-.pgm", "../d-1.000000-1.pgm", "d-1.000000-1.pgm\r",
                           "d-999999999999.000000-1.pgm", "d-1.000000-4294967296.pgm"})
    EXPECT_THROW(parse_recorded_name(name, "INDEX.txt"), Error) << name;
}

TEST(RecordedImage, GetsNoRoomBeforeItIsThere) {
  EXPECT_THROW(decode_pgm("P5 1000000 1000000 65535\n..", 1'000'000, 1'000'000, "image"), Error);
  EXPECT_THROW(decode_ppm("P6 1000000 1000000 255\n..", 1'000'000, 1'000'000, "image"), Error);
}

}  // namespace
}  // namespace glovebench
