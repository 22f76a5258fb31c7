#include <memory>

#include "core/base/file.h"
#include "reports/comparison/comparison_report.h"

namespace glovebench::reports {

std::vector<std::string> write_comparison(const std::string& folder, const ComparisonReport& report) {
  std::vector<std::string> names;
  std::vector<std::unique_ptr<WholeFile>> files;
  const auto write = [&](const std::string& name, const std::string& content) {
    files.push_back(std::make_unique<WholeFile>(folder + "/" + name));
    files.back()->append(content);
    names.push_back(name);
  };
  write("comparison.json", comparison_json(report));
  write("comparison.md", comparison_markdown(report));
  write("comparison.csv", comparison_csv(report));
  write("comparison.tex", comparison_latex(report));
  write("junit.xml", comparison_junit(report));
  write("index.html", comparison_page(report));
  // Only now that there was room for all of them.
  for (const std::unique_ptr<WholeFile>& file : files) file->commit();
  return names;
}

}  // namespace glovebench::reports
