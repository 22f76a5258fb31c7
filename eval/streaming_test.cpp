#include "eval/streaming.h"

#include <gmock/gmock.h>

#include "eval/command_test.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using json = nlohmann::json;

using Frames = std::vector<size_t>;

std::vector<std::optional<size_t>> frames_in_use(const Playback& playback, const std::vector<double>& moments) {
  std::vector<std::optional<size_t>> frames;
  for (const double moment : moments) {
    const std::optional<size_t> place = playback.in_use(moment);
    frames.push_back(place ? std::optional(playback.kept[*place]) : std::nullopt);
  }
  return frames;
}

const std::vector<double> kArrivals = {0, 100, 200, 300, 400, 500};

TEST(Streaming, AFastTrackerIsOneFrameLate) {
  const Playback playback = play(kArrivals, std::vector<double>(6, 5));
  EXPECT_EQ(playback.kept, (Frames{0, 1, 2, 3, 4, 5}));
  EXPECT_THAT(playback.finished_ms, ElementsAre(5, 105, 205, 305, 405, 505));
  EXPECT_THAT(frames_in_use(playback, kArrivals), ElementsAre(std::nullopt, 0, 1, 2, 3, 4));
}

TEST(Streaming, ATrackerThatTakesNoTimeIsNotLate) {
  const Playback playback = play(kArrivals, std::vector<double>(6, 0));
  EXPECT_THAT(frames_in_use(playback, kArrivals), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(Streaming, ASlowTrackerDropsFrames) {
  // 0 to 250; 1 and 2 arrive meanwhile, and 2 is newer: 250 to 500; 3 and 4 arrived, and 5 just now.
  const Playback playback = play(kArrivals, std::vector<double>(6, 250));
  EXPECT_EQ(playback.kept, (Frames{0, 2, 5}));
  EXPECT_THAT(playback.finished_ms, ElementsAre(250, 500, 750));
  EXPECT_THAT(frames_in_use(playback, kArrivals), ElementsAre(std::nullopt, std::nullopt, std::nullopt, 0, 0, 2));
}

TEST(Streaming, OneSlowFrameDelaysTheNext) {
  const Playback playback = play(kArrivals, std::vector<double>{10, 150, 60, 10, 10, 10});
  EXPECT_EQ(playback.kept, (Frames{0, 1, 2, 3, 4, 5}));
  EXPECT_THAT(playback.finished_ms, ElementsAre(10, 250, 310, 320, 410, 510));
  EXPECT_THAT(frames_in_use(playback, kArrivals), ElementsAre(std::nullopt, 0, 0, 1, 3, 4));
}

TEST(Streaming, ATrackerSlowerThanTheMovementNeverAnswers) {
  const Playback playback = play(kArrivals, std::vector<double>(6, 1e6));
  EXPECT_EQ(playback.kept, (Frames{0, 5}));
  EXPECT_FALSE(playback.in_use(500));
}

TEST(Streaming, WithoutFramesThereIsNothing) {
  EXPECT_TRUE(play({}, {}).kept.empty());
  EXPECT_FALSE(Playback().in_use(0));
  EXPECT_THROW(play(kArrivals, std::vector<double>(5, 1)), std::logic_error);
}

class StreamingLong : public CommandTest {};

TEST_F(StreamingLong, LateAnswersAreWorseAndTheUsualErrorsStay) {
  const auto streaming = [](const json& results, const char* column) {
    return cell_of(results, kStreamingStudy, column).get<double>();
  };
  const auto with = [&](const std::string& output, const std::string& ms) {
    return run_trajectory("good.json", output, {"--method", "articulated", "--streaming", "--tracker-ms", ms});
  };
  json usual = run_trajectory("good.json", "usual", {"--method", "articulated"});
  const json none = with("none", "0"), fast = with("fast", "5"), slow = with("slow", "150");
  EXPECT_EQ(fast.at("experiments"), usual.at("experiments"));
  EXPECT_EQ(fast.at("protocol"), usual.at("protocol"));
  // At 25 moments, 8.3 ms apart; frames are 66.7 ms apart. With 5 ms the first moment has no answer, and the
  // moments of the other frames have that of the frame before.
  EXPECT_NEAR(streaming(none, "age_ms"), 700.0 / 25, 0.01);
  EXPECT_NEAR(streaming(fast, "age_ms"), 900.0 / 24, 0.01);
  const json later = with("later", "62");
  EXPECT_GT(streaming(later, "streaming_position_error_mm"), streaming(fast, "streaming_position_error_mm") + 1)
      << "5 and 62 ms differ";
  EXPECT_EQ(streaming(fast, "dropped_percent"), 0);
  // The hand moves by 5 mm a frame, and its estimates are nearly true: only their age counts.
  EXPECT_LT(streaming(fast, "position_error_mm"), 0.3);
  EXPECT_NEAR(streaming(fast, "streaming_position_error_mm"), 5 * 900.0 / 24 / 66.667, 0.3);
  // 0 to 150 ms; 2 (133 ms) is next; 3 arrives before that is finished.
  EXPECT_EQ(streaming(slow, "dropped_percent"), 25);
  EXPECT_GT(streaming(slow, "streaming_position_error_mm"), streaming(fast, "streaming_position_error_mm") + 4);
}

TEST_F(StreamingLong, MeasuredTimesStandApartFromResults) {
  const json results = run_trajectory("good.json", "out", {"--streaming"});
  EXPECT_EQ(results.at("configuration").at("streaming"), "measured");
  EXPECT_THROW(cell_of(results, kStreamingStudy, "streaming_position_error_mm"), std::runtime_error);
  EXPECT_THAT(read_file(path("out/timings.json")), HasSubstr("streaming_position_error_mm"));
  EXPECT_THAT(read_file(path("out/summary.md")), HasSubstr("## Streaming accuracy"));
}

TEST_F(StreamingLong, SettingsStandInOneTable) {
  const ProgramRun run = run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power",
                                         "--method", "schroeder2012", "--method", "articulated", "--streaming",
                                         "--tracker-ms", "80", "-o", path("out")});
  expect_fine(run);
  EXPECT_THAT(run.out, HasSubstr("Streaming accuracy"));
  EXPECT_THAT(read_file(path("out/streaming.csv")), AllOf(HasSubstr("\nschroeder2012,good,DB_open_power"),
                                                          HasSubstr("\narticulated,good,DB_open_power")));
  EXPECT_THAT(refusal(run_glovebench({"run", "fig8", "--streaming"})), HasSubstr("--streaming does not go with"));
  EXPECT_THAT(refusal(run_glovebench({"run", "fig8", "--tracker-ms", "5"})), HasSubstr("--streaming"));
}

}  // namespace
}  // namespace glovebench::eval
