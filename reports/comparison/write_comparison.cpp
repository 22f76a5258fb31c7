#include <filesystem>

#include "core/base/file_set.h"
#include "reports/comparison/comparison_report.h"

namespace glovebench::reports {
namespace {

constexpr const char *kJson = "comparison.json", *kMarkdown = "comparison.md", *kCsv = "comparison.csv",
                     *kLatex = "comparison.tex", *kJunit = "junit.xml", *kPage = "index.html";
constexpr const char* kFiles[] = {kJson, kMarkdown, kCsv, kLatex, kJunit, kPage};

}  // namespace

void require_own_folder(const std::string& folder) {
  if (std::filesystem::exists(folder + "/results.json"))
    throw Error("--output", "folder", folder + ", which holds a run or a baseline",
                "another: both have an index.html");
}

std::vector<std::string> write_comparison(const std::string& folder, const ComparisonReport& report) {
  require_own_folder(folder);
  WholeFiles files(folder);
  files.add(kJson, comparison_json(report));
  files.add(kMarkdown, comparison_markdown(report));
  files.add(kCsv, comparison_csv(report));
  files.add(kLatex, comparison_latex(report));
  files.add(kJunit, comparison_junit(report));
  files.add(kPage, comparison_page(report));
  files.commit();
  return files.names();
}

void remove_comparison(const std::string& folder) {
  if (!std::filesystem::exists(folder)) return;
  require_own_folder(folder);
  WholeFiles files(folder);
  for (const char* name : kFiles) files.remove(name);
  files.commit();
}

void write_refusal(const std::string& folder, const std::string& message) {
  require_own_folder(folder);
  WholeFiles files(folder);
  for (const char* name : kFiles) files.remove(name);
  files.add(kMarkdown, incomparable_markdown(message));
  files.add(kJunit, incomparable_junit(message));
  files.commit();
}

}  // namespace glovebench::reports
