#include "trajectories/posture_file.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/whole_file.h"
#include "core/test_error.h"
#include "core/test_folder.h"
#include "trajectories/formats/format.h"

namespace glovebench::trajectories {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

PostureSet example_postures() {
  Posture bent = Posture::Zero();
  bent[kIndexPipFlexion] = radians_from_degrees(45.125);
  return {.name = "mine", .posture_names = {"flat", "bent"}, .postures = {Posture::Zero(), bent}};
}

std::string headings() {
  std::string line = "name";
  for (const AngleInfo& info : angle_infos()) line.append(",").append(info.name);
  return line + "\n";
}

std::string row(const std::string& name, const std::string& first_cell = "0") {
  std::string line = name + "," + first_cell;
  for (int a = 1; a < kAngleCount; ++a) line.append(",").append(std::to_string(a));
  return line + "\n";
}

std::string json_complaint(const json& document) {
  return thrown_by([&] { parse_postures_json(document.dump(), "my.json"); });
}

std::string csv_complaint(const std::string& text) {
  return thrown_by([&] { parse_postures_csv(text, "my", "my.csv"); });
}

TEST(PostureFile, json_is_a_fixed_point) {
  const std::string text = canonical_text(example_postures());
  const PostureSet parsed = parse_postures_json(text, "memory");
  EXPECT_EQ(parsed.name, "mine");
  EXPECT_THAT(parsed.posture_names, ElementsAre("flat", "bent"));
  EXPECT_EQ(parsed.postures, example_postures().postures);  // 45.125 is a multiple of the file's 0.001
  EXPECT_EQ(canonical_text(parsed), text);
}

TEST(PostureFile, loads_by_ending) {
  const std::string folder = test_folder() + "/";
  write_posture_set(example_postures(), folder + "set.json");
  EXPECT_EQ(load_posture_set(folder + "set.json").postures, example_postures().postures);
  write_file(folder + "hands.csv", headings() + row("a") + row("b"));
  const PostureSet csv = load_posture_set(folder + "hands.csv");
  EXPECT_EQ(csv.name, "hands");
  EXPECT_THAT(csv.posture_names, ElementsAre("a", "b"));
  EXPECT_THROW(load_posture_set(folder + "set.txt"), Error);
  EXPECT_THROW(load_posture_set(folder + "missing.json"), Error);
}

TEST(PostureFile, csv_holds_degrees_in_the_order_of_the_angles) {
  const PostureSet set =
      parse_postures_csv("\xEF\xBB\xBF" + headings() + row("a", " -12.5 ") + "\r\n", "s", "my.csv");
  ASSERT_EQ(set.postures.size(), 1u);
  EXPECT_DOUBLE_EQ(set.postures[0][0], radians_from_degrees(-12.5));
  EXPECT_DOUBLE_EQ(set.postures[0][21], radians_from_degrees(21));
}

TEST(PostureFile, refuses_bad_csv) {
  EXPECT_THAT(csv_complaint(""), HasSubstr("line 1: found 1 columns, expected 23"));
  EXPECT_THAT(csv_complaint(headings()), HasSubstr("postures: found none"));
  std::string wrong = headings();
  wrong.replace(wrong.find("wrist_abduction"), 15, "elbow");
  EXPECT_EQ(csv_complaint(wrong + row("a")),
            "my.csv: line 1, column 3: found \"elbow\", expected \"wrist_abduction\"");
  EXPECT_THAT(csv_complaint(headings() + row("a") + row("a")), HasSubstr("line 3, name: found \"a\" again"));
  EXPECT_THAT(csv_complaint(headings() + "a,1,2\n"), HasSubstr("line 2: found 3 cells, expected 23"));
  EXPECT_THAT(csv_complaint(headings() + row("")), HasSubstr("line 2, name"));
  for (const char* bad : {"nan", "inf", "1e999", "", "1x", "0x10", "90.5"}) {
    EXPECT_THAT(csv_complaint(headings() + row("a", bad)),
                HasSubstr("line 2, wrist_flexion: found \"" + std::string(bad) + "\", expected a number"));
  }
}

TEST(PostureFile, refuses_bad_json) {
  const json good = json::parse(canonical_text(example_postures()));
  EXPECT_EQ(json_complaint(good), "");
  json bad = good;
  bad["postures"][1]["name"] = "flat";
  EXPECT_EQ(json_complaint(bad), "my.json: postures[1].name: found \"flat\" again, expected names that differ");
  bad = good;
  bad["postures"][0]["angles_deg"][2] = -90;
  EXPECT_THAT(json_complaint(bad), HasSubstr("postures[0].angles_deg[2]: found -90"));
  bad = good;
  bad["postures"] = json::array();
  EXPECT_THAT(json_complaint(bad), HasSubstr("postures: found an empty array"));
  bad = good;
  bad["format"] = "glovebench-trajectory";
  EXPECT_THAT(json_complaint(bad), HasSubstr("format: found"));
}

TEST(PostureFile, finds_postures_by_name) {
  EXPECT_EQ(find_posture(example_postures(), "bent"), example_postures().postures[1]);
  EXPECT_THROW(find_posture(example_postures(), "fist"), Error);
}

}  // namespace
}  // namespace glovebench::trajectories
