#include "reports/study.h"

#include <gmock/gmock.h>

#include <functional>

#include "reports/example_studies.h"
#include "reports/test_text.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

StudyResult small_study() {
  Table table = {
      "sizes", "Sizes", "How large.", {{"name", "name", 0}, {"size_mm", "mm", 1}, {"time_ms", "ms", 2, true}},
      1,       {}};
  table.rows = {{"one", 1.5, 10.0}, {"two", Cell(), 20.25}, {"three", int64_t{7}, Cell()}};
  return {"sizes",
          "How large things are",
          {table},
          {{"sizes.mean_mm", "mm", -1.0 / 3, ConfidenceInterval{-2, 1, 0.95, 1, 2, 15, "things"}, false},
           {"sizes.time_ms", "ms", 10, {}, true}}};
}

json written(const StudyResult& study) { return json::parse(format_json(studies_json({study}))); }
std::vector<StudyResult> read(const json& document) {
  const std::string where = "results.json";
  return read_studies(JsonCursor(document, where, "studies"));
}
std::string study_error(const std::function<void(json&)>& change) {
  json document = written(small_study());
  change(document);
  return thrown_by([&] { read(document); });
}
/// True if writers refuse a study after this change.
bool is_refused(const std::function<void(StudyResult&)>& change) {
  std::vector<StudyResult> studies = {small_study()};
  change(studies[0]);
  return thrown_by<std::logic_error>([&] { check_studies(studies); }) != "";
}

TEST(StudyJson, ResultsHoldWhatIsNoTime) {
  const json study = written(small_study())[0];
  const json& table = study["tables"][0];
  EXPECT_EQ(table["columns"], json::parse(R"([{"key": "name", "heading": "name", "digits": 0},
                                              {"key": "size_mm", "heading": "mm", "digits": 1}])"));
  EXPECT_EQ(table["rows"], json::parse(R"([["one", 1.5], ["two", null], ["three", 7]])"));
  ASSERT_EQ(study["measures"].size(), 1u);
  EXPECT_EQ(study["measures"][0]["value"], -0.333333);
  EXPECT_EQ(study["measures"][0]["interval"]["low"], -2);
}

TEST(StudyJson, TimesHaveTheirRowNames) {
  const json study = json::parse(format_json(study_times_json({small_study()})))[0];
  EXPECT_EQ(study["tables"][0]["rows"], json::parse(R"([["one", 10.0], ["two", 20.25], ["three", null]])"));
  ASSERT_EQ(study["measures"].size(), 1u);
  EXPECT_EQ(study["measures"][0]["name"], "sizes.time_ms");
  StudyResult timeless = small_study();
  timeless.tables[0].columns[2].is_time = false;
  timeless.measures.pop_back();
  EXPECT_TRUE(study_times_json({timeless}).empty());
}

TEST(StudyJson, RoundTrip) {
  StudyResult expected = small_study();
  expected.measures.pop_back();
  expected.measures[0].value = -0.333333;
  expected.tables[0].columns.pop_back();
  for (auto& row : expected.tables[0].rows) row.pop_back();
  EXPECT_THAT(read(written(small_study())), ElementsAre(expected));
  const std::string example = format_json(studies_json(example_studies()));
  EXPECT_EQ(format_json(studies_json(read(json::parse(example)))), example);
}

TEST(StudyJson, ErrorsNameTheField) {
  const auto table = [](json& j) -> json& { return j[0]["tables"][0]; };
  EXPECT_EQ(study_error([](json&) {}), "");
  EXPECT_THAT(study_error([](json& j) { j[0]["extra"] = 1; }), HasSubstr("studies[0]: found unknown key"));
  EXPECT_THAT(study_error([](json& j) { j[0]["name"] = "../x"; }), HasSubstr("studies[0].name"));
  EXPECT_THAT(study_error([&](json& j) { table(j)["name"] = "../x"; }), HasSubstr("tables[0].name"));
  EXPECT_THAT(study_error([&](json& j) { table(j)["name"] = "figure4"; }), HasSubstr("tables[0].name"));
  EXPECT_THAT(study_error([&](json& j) { table(j)["extra"] = 1; }), HasSubstr("unknown key"));
  EXPECT_THAT(study_error([&](json& j) { j[0]["tables"].push_back(table(j)); }),
              HasSubstr("studies[0].tables[1].name: found \"sizes\", expected each table name once"));
  EXPECT_THAT(study_error([&](json& j) { table(j)["columns"][0]["unit"] = "mm"; }), HasSubstr("unknown key"));
  EXPECT_THAT(study_error([&](json& j) { table(j)["columns"][0]["digits"] = 7; }), HasSubstr("digits"));
  EXPECT_THAT(study_error([&](json& j) { table(j)["columns"][1]["key"] = "name"; }), HasSubstr("columns[1].key"));
  EXPECT_THAT(study_error([&](json& j) { table(j)["columns"] = json::array(); }), HasSubstr("at least one column"));
  EXPECT_THAT(study_error([&](json& j) { table(j)["name_columns"] = 3; }), HasSubstr("name_columns"));
  EXPECT_THAT(study_error([&](json& j) { table(j)["name_columns"] = 0; }), HasSubstr("name_columns"));
}

TEST(StudyJson, ErrorsInRowsAndMeasures) {
  const auto row = [](json& j) -> json& { return j[0]["tables"][0]["rows"][1]; };
  const auto measure = [](json& j) -> json& { return j[0]["measures"][0]; };
  EXPECT_THAT(study_error([&](json& j) { row(j).push_back(1); }),
              HasSubstr("rows[1]: found an array of 3, expected one cell for each of columns"));
  EXPECT_THAT(study_error([&](json& j) { row(j).erase(1); }), HasSubstr("rows[1]: found an array of 1"));
  EXPECT_THAT(study_error([&](json& j) { row(j)[1] = true; }), HasSubstr("rows[1][1]: found true"));
  EXPECT_THAT(study_error([&](json& j) { row(j)[1] = json::array(); }), HasSubstr("rows[1][1]"));
  EXPECT_THAT(study_error([&](json& j) { row(j)[1] = 1e13; }), HasSubstr("rows[1][1]"));
  EXPECT_THAT(study_error([&](json& j) { row(j)[1] = uint64_t{1} << 63; }), HasSubstr("rows[1][1]"));
  EXPECT_THAT(study_error([&](json& j) { measure(j)["value"] = "3"; }), HasSubstr("measures[0].value"));
  EXPECT_THAT(study_error([&](json& j) { measure(j)["interval"].erase("over"); }), HasSubstr("interval.over"));
  EXPECT_THAT(study_error([&](json& j) { measure(j)["name"] = ""; }), HasSubstr("measures[0].name"));
  EXPECT_THAT(study_error([&](json& j) { j[0]["measures"].push_back(measure(j)); }), HasSubstr("measures[1].name"));
}

TEST(StudyJson, WritersRefuseWhatReadersWould) {
  EXPECT_FALSE(is_refused([](StudyResult&) {}));
  EXPECT_TRUE(is_refused([](StudyResult& s) { s.tables.push_back(s.tables[0]); }));
  EXPECT_TRUE(is_refused([](StudyResult& s) { s.tables[0].name = "frames_of_mine"; }));
  EXPECT_TRUE(is_refused([](StudyResult& s) { s.tables[0].name = "a/b"; }));
  EXPECT_TRUE(is_refused([](StudyResult& s) { s.tables[0].rows[0].pop_back(); }));
  EXPECT_TRUE(is_refused([](StudyResult& s) { s.tables[0].name_columns = 0; }));
  EXPECT_TRUE(is_refused([](StudyResult& s) { s.tables[0].name_columns = 3; })) << "a time would name a row";
  EXPECT_TRUE(is_refused([](StudyResult& s) { s.tables[0].columns[1].digits = 9; }));
  EXPECT_TRUE(is_refused([](StudyResult& s) { s.tables[0].columns[1].key = "name"; }));
  EXPECT_TRUE(is_refused([](StudyResult& s) { s.measures.push_back(s.measures[0]); }));
  StudyResult infinite = small_study();
  infinite.tables[0].rows[0][1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(studies_json({infinite}), std::logic_error);
}

}  // namespace
}  // namespace glovebench::reports
