#include <nlohmann/json.hpp>

#include "reports/page/section.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

/// JSON that no text in it can end the script element of: "<" is written as an escape.
std::string for_script(const Json& json) {
  std::string text;
  const std::string dumped = json.dump(-1, ' ', false, Json::error_handler_t::replace);  // names can hold any bytes
  for (const char c : dumped) text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

}  // namespace

std::string chart_data(const RunResult& result, const PaperNumbers& paper) {
  const NoiseSetting noise = headline_noise(result);
  Json tables = {{"figure4", figure4_csv(result, paper, noise)}};
  const auto add_curve = [&](const std::string& name, const PaperCurve& curve) {
    const ExperimentKey key = {curve.trajectory, curve.database, TruthKind::recorded, 1, noise};
    if (const ExperimentResult* experiment = find_experiment(result, key))
      tables[name] = curve_csv(*experiment, curve);
  };
  add_curve("figure5", paper.figure_5);
  add_curve("figure6", paper.figure_6);
  for (const StudyResult& study : result.studies)
    for (const Table& table : study.tables) tables[table.name] = to_csv(table);
  return "<script type=\"application/json\" id=\"tables\">" + for_script(tables) + "</script>\n";
}

}  // namespace glovebench::reports
