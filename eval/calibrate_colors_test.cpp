// Color tables from recordings, from the command line to the files.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/segmentation/color_table.h"
#include "eval/command_test.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class CalibrateColorsLong : public CommandTest {
 protected:
  ProgramRun calibrate(const std::string& recording, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"calibrate", "colors",         "--source", "fakenect:" + path(recording),
                                          "-o",        path("own.table")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  }
  std::string tracked_states(const std::vector<std::string>& more) const {
    expect_fine(track("dump", "DB_open_power", "estimates.jsonl", more));
    return read_file(path("estimates.jsonl"));
  }
};

TEST_F(CalibrateColorsLong, makes_a_table_that_tracks) {
  render_recording("good.json", "dump");
  const ProgramRun run = calibrate("dump", {"--report", path("report.json"), "--picture", path("picture.png")});
  expect_fine(run);
  EXPECT_THAT(run.out, AllOf(HasSubstr("own.table: a color table of 4 frames"), HasSubstr("| not glove |")));
  EXPECT_EQ(ColorTable::load(path("own.table")).space(), ColorSpace::yuv);
  const json report = json::parse(read_file(path("report.json")));
  EXPECT_EQ(report.at("frames"), kFrames);
  for (const json& color : report.at("colors")) EXPECT_GE(color.at("pixels").get<int>(), 200) << color;
  EXPECT_EQ(read_file(path("picture.png")).substr(1, 3), "PNG");

  const std::string own = tracked_states({"--colors", path("own.table")}), standard = tracked_states({});
  EXPECT_NE(own, standard) << "the table is used";
  EXPECT_EQ(std::count(own.begin(), own.end(), '\n'), kFrames);
  EXPECT_THAT(run_glovebench({"track", "--source", "fakenect:" + path("dump"), "--database", "DB_open_power", "-o",
                              path("x.jsonl"), "--colors", path("own.table")})
                  .out,
              HasSubstr("4 of 4 frames tracked"));

  // Again, from its own table and over RGB.
  expect_fine(calibrate("dump", {"--seeds", path("own.table"), "--space", "rgb", "--frames", "2"}));
  EXPECT_EQ(ColorTable::load(path("own.table")).space(), ColorSpace::rgb);
}

TEST_F(CalibrateColorsLong, refuses_what_shows_no_glove) {
  render_recording("good.json", "dump");
  write_file(path("near.json"), R"({"volume": {"z_min_m": 0.41, "z_max_m": 0.45}})");
  EXPECT_THAT(refusal(calibrate("dump", {"--config", path("near.json")})),
              AllOf(HasSubstr("dump: pixels in the working volume: found 0"), HasSubstr("0.41 to 0.45 m")));
  // In a gray picture the hand wears no glove.
  for (const auto& entry : fs::directory_iterator(path("dump"))) {
    if (entry.path().extension() != ".ppm") continue;
    std::string image = read_file(entry.path().string());
    const size_t header = image.size() - size_t{640} * 480 * 3;
    for (size_t i = header; i + 2 < image.size(); i += 3) image[i] = image[i + 2] = image[i + 1];
    write_file(entry.path().string(), image);
  }
  fs::remove(path("dump/manifest.json"));  // contains the hashes of the color images
  EXPECT_THAT(refusal(calibrate("dump")), HasSubstr("dump: glove: found no 1 ("));
  EXPECT_FALSE(fs::exists(path("own.table")));
}

TEST_F(CalibrateColorsLong, refuses_what_cannot_be_read_or_written) {
  EXPECT_THAT(refusal(calibrate("nothing")), HasSubstr("nothing"));
  EXPECT_THAT(refusal(run_glovebench({"calibrate"})), HasSubstr("A command is required"));
  EXPECT_THAT(refusal(run_glovebench({"calibrate", "colors", "-o", path("x")})), HasSubstr("--source"));
  EXPECT_THAT(refusal(calibrate("nothing", {"--report", path("report.txt")})), HasSubstr("the ending .json"));
  EXPECT_THAT(refusal(calibrate("nothing", {"--picture", path("picture.jpg")})), HasSubstr("the ending .png"));
  EXPECT_THAT(refusal(calibrate("nothing", {"--frames", "0"})), HasSubstr("--frames"));
  EXPECT_THAT(refusal(calibrate("nothing", {"--space", "hsv"})), HasSubstr("--space"));
  EXPECT_THAT(refusal(calibrate("nothing", {"--seeds", path("good.json")})),
              HasSubstr("good.json: top level: found unknown key"));

  write_file(path("damaged.table"), "glovebench color table, version 2, yuv\n");
  EXPECT_THAT(refusal(calibrate("nothing", {"--seeds", path("damaged.table")})), HasSubstr("damaged.table: size"));
  EXPECT_THAT(refusal(track("nothing", "DB_open_power", "x.jsonl", {"--colors", path("damaged.table")})),
              HasSubstr("damaged.table: size: found 39 bytes"));
  EXPECT_THAT(refusal(track("nothing", "DB_open_power", "x.jsonl", {"--colors", path("none.table")})),
              HasSubstr("none.table"));
}

}  // namespace
}  // namespace glovebench::eval
