#include <filesystem>
#include <memory>

#include "core/base/file.h"
#include "reports/comparison/comparison_report.h"

namespace glovebench::reports {
namespace {

constexpr const char *kJson = "comparison.json", *kMarkdown = "comparison.md", *kCsv = "comparison.csv",
                     *kLatex = "comparison.tex", *kJunit = "junit.xml", *kPage = "index.html";

}  // namespace

std::vector<std::string> write_comparison(const std::string& folder, const ComparisonReport& report) {
  std::vector<std::string> names;
  std::vector<std::unique_ptr<WholeFile>> files;
  const auto write = [&](const std::string& name, const std::string& content) {
    files.push_back(std::make_unique<WholeFile>(folder + "/" + name));
    files.back()->append(content);
    names.push_back(name);
  };
  write(kJson, comparison_json(report));
  write(kMarkdown, comparison_markdown(report));
  write(kCsv, comparison_csv(report));
  write(kLatex, comparison_latex(report));
  write(kJunit, comparison_junit(report));
  write(kPage, comparison_page(report));
  // Only now that there was room for all of them.
  for (const std::unique_ptr<WholeFile>& file : files) file->commit();
  return names;
}

void remove_comparison(const std::string& folder) {
  for (const char* name : {kJson, kMarkdown, kCsv, kLatex, kJunit, kPage}) {
    std::error_code ignored;  // what cannot be removed cannot be replaced either, and that is an Error
    std::filesystem::remove(folder + "/" + name, ignored);
  }
}

void write_refusal(const std::string& folder, const std::string& message) {
  write_file(folder + "/" + kMarkdown, incomparable_markdown(message));
  write_file(folder + "/" + kJunit, incomparable_junit(message));
}

}  // namespace glovebench::reports
