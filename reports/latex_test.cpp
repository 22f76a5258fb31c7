#include "reports/latex.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "reports/csv.h"
#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

using testing::HasSubstr;

TEST(Latex, TextIsEscaped) {
  EXPECT_EQ(escape_latex("a_b & 5% $1 #2 {x}"), "a\\_b \\& 5\\% \\$1 \\#2 \\{x\\}");
  EXPECT_EQ(escape_latex("\\~^<>"),
            "\\textbackslash{}\\textasciitilde{}\\textasciicircum{}\\textless{}\\textgreater{}");
  EXPECT_EQ(escape_latex("[*]\n"), "{[}{*}{]} ");
}

TEST(Latex, MinusSignsAndMissingValues) {
  EXPECT_EQ(to_latex({{"name", "x"}, {{"-a", "-1.5"}, {"b", "-"}}, 1}),
            "\\begin{tabular}{lr}\n\\toprule\nname & x \\\\\n\\midrule\n-a & $-$1.5 \\\\\nb & -- \\\\\n"
            "\\bottomrule\n\\end{tabular}\n");
}

TEST(Latex, Figure4HasThePapersNumbers) {
  const std::string latex = figure4_latex(small_result(), paper_numbers(), {});
  EXPECT_THAT(latex, HasSubstr("Tr4 & DB\\_open\\_power & 4.00 & 3.00 & 2.00 & 75.0 & -- & -- & -- & -- & "
                               "-- & -- & -- & 0.0 & 3.88 & 2.60 & 2.70 \\\\\n"));
  EXPECT_THAT(latex, HasSubstr("\\multicolumn{4}{c}{source, second subject} & \\multicolumn{3}{c}{paper} \\\\\n"
                               "\\cmidrule(lr){3-6}\\cmidrule(lr){7-10}\\cmidrule(lr){11-14}"
                               "\\cmidrule(lr){15-17}\n"));
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

}  // namespace
}  // namespace glovebench::reports
