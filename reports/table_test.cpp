#include "reports/table.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/input_file.h"
#include "core/test_folder.h"
#include "reports/example_result.h"
#include "reports/report.h"
#include "reports/summary.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  size_t begin = 0;
  for (size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + separator.size())
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

/// Cells of a CSV line; quoted cells may contain commas.
std::vector<std::string> csv_cells(const std::string& line) {
  std::vector<std::string> cells = {""};
  bool is_quoted = false;
  for (const char c : line)
    if (c == '"')
      is_quoted = !is_quoted;
    else if (c == ',' && !is_quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

/// A written study, read without the code that wrote it.
struct Written {
  std::vector<std::vector<std::string>> csv;       ///< with the heading
  std::vector<std::vector<std::string>> markdown;  ///< without it
};

Written read_written(const std::string& folder, const Table& table, const std::string& summary) {
  Written written;
  std::istringstream lines(read_file(folder + "/tables/" + table.name + ".csv"));
  for (std::string line; std::getline(lines, line);) written.csv.push_back(csv_cells(line));
  const size_t explanation = summary.find(table.explanation + "\n\n| ");
  EXPECT_NE(explanation, std::string::npos) << table.name;
  std::istringstream rest(summary.substr(explanation + table.explanation.size() + 2));
  std::string line;
  for (int skipped = 0; skipped < 2; ++skipped) std::getline(rest, line);
  while (std::getline(rest, line) && line.starts_with("| "))
    written.markdown.push_back(split(line.substr(2, line.size() - 4), " | "));
  return written;
}

/// The table in results.json or timings.json; null if there is none.
json find_table(const json& document, const std::string& name) {
  for (const json& study : document["studies"])
    for (const json& table : study["tables"])
      if (table["name"] == name) return table;
  return nullptr;
}

/// Cell of a JSON file by row and column key.
json find_cell(const json& table, size_t row, const std::string& key) {
  for (size_t c = 0; c < table["columns"].size(); ++c)
    if (table["columns"][c]["key"] == key) return table["rows"][row][c];
  return "no such column";
}

/// A CSV cell as a table for people shows it.
std::string as_shown(const std::string& csv, const Column& column, const Cell& cell) {
  if (csv.empty()) return "-";
  if (!std::holds_alternative<double>(cell)) return csv;
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", column.digits, std::stod(csv));
  return text;
}

TEST(Table, ColumnsOfLongNamesWrapOnThePageAndAreNotForTheTerminal) {
  Table table = table_of({"name", "words", "count"}, 2);
  table.rows = {{"a", std::string(61, 'x'), int64_t{1}}, {"b", "short", {}}};
  EXPECT_EQ(to_text(without_long_names(table)), "name  count\na         1\nb         -\n");
  EXPECT_THAT(to_html(table), testing::HasSubstr("<td class=\"name long\">xxx"));
  EXPECT_THAT(to_html(table), testing::HasSubstr("<td class=\"name long\">short"));
  table.rows.erase(table.rows.begin());
  EXPECT_EQ(without_long_names(table), table);
}

TEST(Table, EveryCellIsTheSameInEveryFile) {
  const std::string folder = test_folder();
  const RunResult result = full_result();
  write_report(folder, result, {});
  const std::string summary = read_file(folder + "/summary.md");
  const json results = json::parse(read_file(folder + "/results.json"));
  const json timings = json::parse(read_file(folder + "/timings.json"));
  int cells = 0;
  for (const StudyResult& study : result.studies) {
    for (const Table& table : study.tables) {
      const Written written = read_written(folder, table, summary);
      const json in_results = find_table(results, table.name), in_timings = find_table(timings, table.name);
      ASSERT_EQ(written.csv.size(), table.rows.size() + 1);
      ASSERT_EQ(written.csv[0].size(), table.columns.size() + 2);
      EXPECT_EQ(written.csv[0][0] + "," + written.csv[0][1], "run,experiment");
      ASSERT_EQ(written.markdown.size(), table.rows.size());
      for (size_t r = 0; r < table.rows.size(); ++r) {
        for (size_t c = 0; c < table.columns.size(); ++c, ++cells) {
          const Column& column = table.columns[c];
          const std::string& csv = written.csv[r + 1][c + 2];
          SCOPED_TRACE(table.name + " " + std::to_string(r) + " " + column.key);
          EXPECT_EQ(written.csv[0][c + 2], column.key);
          const json stored = find_cell(column.is_time ? in_timings : in_results, r, column.key);
          EXPECT_EQ(csv, stored.is_null() ? "" : stored.is_string() ? stored.get<std::string>() : stored.dump());
          EXPECT_EQ(written.markdown[r][c], as_shown(csv, column, table.rows[r][c]));
          EXPECT_EQ(find_cell(column.is_time ? in_results : in_timings, r, column.key) == "no such column",
                    std::cmp_greater_equal(c, table.name_columns))
              << "times and results stand apart, names beside both";
        }
      }
    }
  }
  EXPECT_EQ(cells, 8 * 11 + 16 * 19);
}

TEST(Table, CellsAreRoundedOnce) {
  const Column column = {"x", "x", 2};
  EXPECT_EQ(cell_text(2.0 / 3, column), "0.67");
  EXPECT_EQ(cell_text(-0.001, column), "0.00") << "no minus zero";
  EXPECT_EQ(cell_text(-0.012, column), "-0.01");
  EXPECT_EQ(cell_text(int64_t{12}, column), "12");
  EXPECT_EQ(cell_text("a", column), "a");
  EXPECT_EQ(cell_text({}, column), "-");
}

TEST(Table, BarsInTextsEndNoCell) {
  const Table table = {"t", "T", "", {{"a", "a|b", 0}}, 1, {{"c|d"}}};
  EXPECT_EQ(study_markdown({"s", "S", {table}, {}}), "## S\n\n### T\n\n| a\\|b |\n| --- |\n| c\\|d |\n\n");
  EXPECT_THAT(to_csv(table), HasSubstr("c|d"));
}

/// Names and numbers.
Table small_table(const std::vector<Row>& rows) {
  Table table = table_of({"name", "x"});
  table.rows = rows;
  return table;
}

TEST(Table, TextInHtmlIsEscaped) {
  Table table = small_table({{"x&y", int64_t{1}}});
  table.columns[0].heading = "a<b";
  EXPECT_THAT(to_html(table), HasSubstr("<th class=\"name\">a&lt;b</th><th>x</th></tr></thead>\n<tbody>\n"
                                        "<tr><td class=\"name\">x&amp;y</td><td>1</td></tr>"));
}

TEST(Table, PlotsStandBehindTheNames) {
  EXPECT_THAT(to_html(small_table({{"a", 1.0}}), {"<svg/>"}),
              HasSubstr("<th class=\"name\">name</th><th></th><th>x</th></tr></thead>\n<tbody>\n"
                        "<tr><td class=\"name\">a</td><td><svg/></td><td>1.00</td></tr>"));
}

TEST(Table, VerdictsStandOut) {
  Table table = small_table({{"a", Judgment{"worse", Tone::worse}}, {"b", Judgment{"same", Tone::same}}});
  EXPECT_THAT(to_markdown(table), HasSubstr("| a | **worse** |\n| b | same |\n"));
  EXPECT_THAT(to_html(table), HasSubstr("<td><span class=\"verdict worse\">worse</span></td>"));
  EXPECT_EQ(to_text(table), "name  x\na     worse\nb     same\n");
  table.columns = {{"name", ""}, {"verdict", ""}};
  EXPECT_EQ(to_csv(table), "name,verdict\na,worse\nb,same\n");
}

TEST(Table, TextIsAligned) {
  EXPECT_EQ(to_text(small_table({{"a", 1.5}, {"b\u00e9cd", -10.25}, {"c", Cell()}})),
            "name       x\na       1.50\nb\u00e9cd  -10.25\nc          -\n");
  Table grouped = table_of({"group", "name", "x"}, 2);
  grouped.rows = {{"one", "a", 1.0}, {"one", "b", 2.0}, {"two", "a", 3.0}};
  EXPECT_EQ(to_text(grouped, true), "  name     x\none\n  a     1.00\n  b     2.00\ntwo\n  a     3.00\n");
}

TEST(Table, TextFitsATerminal) {
  std::istringstream lines(
      to_text(small_table({{std::string(200, 'a') + "z", std::string(200, 'b')}, {"c", 1.0}})));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  EXPECT_THAT(line, StartsWith("aaa"));
  EXPECT_THAT(line, HasSubstr("...aaa"));
  EXPECT_THAT(line, HasSubstr("z bbb"));
  EXPECT_LE(line.size(), kTerminalColumns);
  EXPECT_GE(line.size(), kTerminalColumns - 3);
}

TEST(Table, MinusSignsAndMissingValuesInLatex) {
  EXPECT_EQ(to_latex(small_table({{"-a", -1.5}, {"b", Cell()}})),
            "\\begin{tabular}{lr}\n\\toprule\nname & x \\\\\n\\midrule\n-a & $-$1.50 \\\\\nb & -- \\\\\n"
            "\\bottomrule\n\\end{tabular}\n");
}

TEST(Csv, TextsThatWouldBreakALineAreQuoted) {
  EXPECT_EQ(csv_line({"a", 1, nullptr, true, "b,c", "d\"e", "f\ng"}), "a,1,,true,\"b,c\",\"d\"\"e\",\"f\ng\"\n");
}

TEST(Csv, TextsAreNoFormulas) {
  for (const std::string text : {"=1+1", "+1+1", "-1+1", "@SUM(A1)", "-", "=", "--", "-nan", "+inf", "- 5"})
    EXPECT_EQ(csv_line({text}), "'" + text + "\n");
  EXPECT_EQ(csv_line({"=HYPERLINK(\"a\",1)"}), "\"'=HYPERLINK(\"\"a\"\",1)\"\n");
  EXPECT_EQ(csv_line({"\t=1"}), "'\t=1\n");
  EXPECT_EQ(csv_line({"\r=1"}), "\"'\r=1\"\n");
  EXPECT_EQ(csv_line({"\n=1"}), "\"'\n=1\"\n");
  EXPECT_EQ(csv_line({-1.5, -3, "-1.5", "-2e-3", "a=b", "", " -"}), "-1.5,-3,-1.5,-2e-3,a=b,, -\n")
      << "numbers and others";
}

TEST(Text, ForLatexIsEscaped) {
  EXPECT_EQ(escape_latex("a_b & 5% $1 #2 {x}"), "a\\_b \\& 5\\% \\$1 \\#2 \\{x\\}");
  EXPECT_EQ(escape_latex("\\~^<>"),
            "\\textbackslash{}\\textasciitilde{}\\textasciicircum{}\\textless{}\\textgreater{}");
  EXPECT_EQ(escape_latex("[*]\n"), "{[}{*}{]} ");
}

TEST(Text, ForMarkdownIsEscaped) {
  EXPECT_EQ(escape_markdown("a|b `c` *d* <e> & \\\n"), "a\\|b \\`c\\` \\*d\\* &lt;e> &amp; \\\\ ");
  EXPECT_EQ(escape_markdown("[-0.5, +0.5]"), "[-0.5, +0.5]");
  EXPECT_EQ(escape_markdown("[a](b) [a][b] [a]:"), "[a\\](b) [a\\][b] [a\\]:");
}

TEST(Text, IsWrappedAtSpaces) {
  const std::string word(70, 'a');
  EXPECT_EQ(wrapped(word + " " + word + " b"), word + "\n" + word + " b\n");
  EXPECT_EQ(wrapped(std::string(300, 'x')).size(), kTerminalColumns + 1);
  EXPECT_EQ(wrapped("one two three", 9, 2), "one two\n  three\n") << "begins behind 2 columns";
}

}  // namespace
}  // namespace glovebench::reports
