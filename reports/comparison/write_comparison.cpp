#include <algorithm>
#include <filesystem>

#include "core/base/excerpt.h"
#include "core/base/file_set.h"
#include "reports/comparison/comparison_report.h"

namespace glovebench::reports {
namespace {

constexpr const char *kJson = "comparison.json", *kMarkdown = "comparison.md", *kCsv = "comparison.csv",
                     *kLatex = "comparison.tex", *kJunit = "junit.xml", *kPage = "index.html";
constexpr const char* kFiles[] = {kJson, kMarkdown, kCsv, kLatex, kJunit, kPage};

}  // namespace

std::vector<std::string> write_comparison(const std::string& folder, const ComparisonReport& report) {
  WholeFiles files(folder, kComparisonSet);
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
  for (const ManifestEntry& file : read_manifest(folder).value_or(Manifest{}).files)
    if (std::ranges::find(kFiles, file.name) == std::end(kFiles))
      throw Error(folder + "/" + kManifest, "files", quoted_excerpt(file.name), "the files of a comparison alone");
  remove_set(folder, kComparisonSet);
  for (const char* name : kFiles) {  // of before there were manifests
    std::error_code ignored;         // what cannot be removed cannot be replaced either, and that is an Error
    std::filesystem::remove(folder + "/" + name, ignored);
  }
}

void write_refusal(const std::string& folder, const std::string& message) {
  WholeFiles files(folder, kComparisonSet);
  files.add(kMarkdown, incomparable_markdown(message));
  files.add(kJunit, incomparable_junit(message));
  files.commit();
}

}  // namespace glovebench::reports
