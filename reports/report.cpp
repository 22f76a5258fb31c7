#include "reports/report.h"

#include <memory>

#include "core/base/file.h"
#include "reports/json_text.h"
#include "reports/results_json.h"
#include "reports/summary.h"

namespace glovebench::reports {

std::vector<std::string> write_report(const std::string& folder, const RunResult& result, const Timings& timings,
                                      const std::vector<Picture>& pictures) {
  const PaperNumbers& paper = paper_numbers();
  const NoiseSetting noise = headline_noise(result);
  std::vector<std::string> names;
  std::vector<std::unique_ptr<WholeFile>> files;
  const auto write = [&](const std::string& name, const std::string& content) {
    files.push_back(std::make_unique<WholeFile>(folder + "/" + name));
    files.back()->append(content);
    names.push_back(name);
  };
  write("results.json", results_json(result));
  write("config.json", format_json(result.configuration));
  write("summary.md", summary_markdown(result, paper));
  write("index.html", html_page(result, paper, pictures));
  write("timings.json", timings_json(timings));
  write("tables/figure4.csv", figure4_csv(result, paper, noise));
  const auto write_curve = [&](const std::string& name, const PaperCurve& curve) {
    const ExperimentKey key = {curve.trajectory, curve.database, TruthKind::recorded, 1, noise};
    if (const ExperimentResult* experiment = find_experiment(result, key))
      write(name, curve_csv(*experiment, curve));
  };
  write_curve("tables/figure5.csv", paper.figure_5);
  write_curve("tables/figure6.csv", paper.figure_6);
  for (const ExperimentResult& experiment : result.experiments)
    write("tables/frames_" + to_string(experiment.key) + ".csv", frames_csv(experiment));
  // Only now that there was room for all of them.
  for (const std::unique_ptr<WholeFile>& file : files) file->commit();
  return names;
}

}  // namespace glovebench::reports
