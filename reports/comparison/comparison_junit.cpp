#include <fmt/format.h>

#include <algorithm>

#include "reports/comparison/comparison_report.h"
#include "reports/comparison/comparison_text.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

/// Outcome of a test: "failure", "skipped", "error", or empty if it passed.
struct TestCase {
  std::string name;
  std::string class_name;
  std::string outcome;
  std::string message;
  std::string output;
};

struct TestSuite {
  std::string name;
  std::vector<TestCase> cases;
};

std::string counts(const std::vector<TestSuite>& suites) {
  const auto count = [&](const std::string& outcome) {
    long total = 0;
    for (const TestSuite& suite : suites)
      total += std::ranges::count_if(suite.cases,
                                     [&](const TestCase& c) { return outcome == "any" || c.outcome == outcome; });
    return total;
  };
  return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"0\"", count("any"),
                     count("failure"), count("error"), count("skipped"));
}

std::string case_xml(const TestCase& test) {
  std::string xml = fmt::format("    <testcase name=\"{}\" classname=\"{}\" time=\"0\">\n", escape_xml(test.name),
                                escape_xml(test.class_name));
  if (!test.outcome.empty())
    xml += fmt::format("      <{} message=\"{}\"/>\n", test.outcome, escape_xml(test.message));
  if (!test.output.empty()) xml += fmt::format("      <system-out>{}</system-out>\n", escape_xml(test.output));
  return xml + "    </testcase>\n";
}

std::string junit(const std::vector<TestSuite>& suites) {
  std::string xml = fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"glovebench\" {}>\n",
                                counts(suites));
  for (const TestSuite& suite : suites) {
    xml += fmt::format("  <testsuite name=\"{}\" {}>\n", escape_xml(suite.name), counts({suite}));
    for (const TestCase& test : suite.cases) xml += case_xml(test);
    xml += "  </testsuite>\n";
  }
  return xml + "</testsuites>\n";
}

TestCase row_case(const ComparisonRow& row) {
  TestCase test;
  test.name = row.metric->key;
  std::string experiment = row.experiment;
  std::ranges::replace(experiment, '.', '_');  // a dot would start another package
  test.class_name = "glovebench." + experiment;
  test.output = row_sentence(row);
  if (stops(row)) {
    test.outcome = "failure";
    test.message = fmt::format("{}: {}", verdict_text(row), row_sentence(row));
  } else if (row.verdict == Verdict::not_enough_data) {
    test.outcome = "skipped";
    test.message = fmt::format("{}: {}", to_string(row.verdict), row_sentence(row));
  }
  return test;
}

TestCase speed_case(const SpeedRow& row) {
  const std::string sentence = speed_sentence(row);
  return {row.name, "glovebench.speed", row.slower ? "failure" : "", row.slower ? "slower: " + sentence : "",
          sentence};
}

}  // namespace

std::string comparison_junit(const ComparisonReport& report) {
  std::vector<TestSuite> suites;
  for (const auto& rows : rows_by_experiment(report.comparison)) {
    suites.push_back({rows.front().experiment, {}});
    for (const ComparisonRow& row : rows) suites.back().cases.push_back(row_case(row));
  }
  if (!report.speed.empty()) suites.push_back({"speed", {}});
  for (const SpeedRow& row : report.speed) suites.back().cases.push_back(speed_case(row));
  return junit(suites);
}

std::string incomparable_junit(const std::string& message) {
  return junit({{"comparison", {{"comparable", "glovebench.comparison", "error", message, ""}}}});
}

}  // namespace glovebench::reports
