#include "reports/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>

#include "reports/results_json.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

struct Headline {
  std::string_view metric;
  double PaperErrors::*paper;  ///< null: not in the paper
};
constexpr std::array<Headline, 5> kHeadlines = {{{"position_error_mm", &PaperErrors::position_mm},
                                                 {"posture_rms_deg", &PaperErrors::posture_deg},
                                                 {"rotation_error_deg", &PaperErrors::rotation_deg},
                                                 {"fingertip_error_mm", nullptr},
                                                 {"vertex_error_mm", nullptr}}};
/// The errors of Figure 4.
constexpr auto kPaperHeadlines = std::span(kHeadlines).first<3>();

std::string short_name(const std::string& database) {
  return database.starts_with("DB_") ? database.substr(3) : database;
}

/// At most six columns wide, for errors up to a kilometer.
std::string narrow(const std::optional<double>& value) {
  return fixed(value, !value || *value < 99.995 ? 2 : *value < 9999.95 ? 1 : 0);
}

bool is_variant(const ExperimentKey& key, const Variant& variant) {
  return variant.truth == key.truth && variant.subject == key.subject && key.appearance == Appearance::glove;
}

std::string variant_cells(const ExperimentResult* experiment) {
  if (!experiment) return fmt::format("{:>6} {:>6} {:>6} {:>5}", "-", "-", "-", "-");
  return fmt::format("{:>6} {:>6} {:>6} {:>5}", narrow(experiment->aggregate_of("position_error_mm").mean),
                     narrow(experiment->aggregate_of("posture_rms_deg").mean),
                     narrow(experiment->aggregate_of("rotation_error_deg").mean),
                     fixed(covered_percent(*experiment), 1));
}

std::string paper_cells(const PaperErrors* paper) {
  if (!paper) return fmt::format("{:>5} {:>5} {:>5}", "-", "-", "-");
  return fmt::format("{:>5.2f} {:>5.2f} {:>5.2f}", paper->position_mm, paper->posture_deg, paper->rotation_deg);
}

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

/// Columns of Figure 4 that stay together on a terminal.
struct Block {
  std::string title, units;
  std::function<std::string(const Figure4Row&)> cells;
  size_t width = 0;
};

std::vector<Block> figure4_blocks() {
  std::vector<Block> blocks;
  const std::string units = fmt::format("{:>6} {:>6} {:>6} {:>5}", "mm", "post.", "rot.", "cov.");
  for (size_t v = 0; v < figure4_variants().size(); ++v)
    blocks.push_back({figure4_variants()[v].title, units,
                      [v](const Figure4Row& row) { return variant_cells(row.variants[v]); }, 25});
  blocks.push_back({"paper", fmt::format("{:>5} {:>5} {:>5}", "mm", "post.", "rot."),
                    [](const Figure4Row& row) { return paper_cells(row.paper); }, 18});
  return blocks;
}

constexpr size_t kNameWidth = 21;  // of trajectory and database

std::string blocks_text(std::span<const Block> blocks, const std::vector<Figure4Row>& rows) {
  const auto line = [&](std::string_view trajectory, std::string_view database, const auto& cells) {
    std::string text = fmt::format("{:<4} {:<16}", trajectory, database);
    for (const Block& block : blocks) text += fmt::format("|{:^{}}", cells(block), block.width);
    return trimmed(text);
  };
  std::string rule(kNameWidth, '-');
  for (const Block& block : blocks) rule.append("+").append(block.width, '-');
  std::string text = line("", "", [](const Block& block) { return block.title; }) +
                     line("", "database DB_", [](const Block& block) { return block.units; });
  std::string previous;
  for (const Figure4Row& row : rows) {
    if (row.trajectory != previous) text += rule + "\n";
    text += line(row.trajectory == previous ? "" : row.trajectory, short_name(row.database),
                 [&](const Block& block) { return block.cells(row); });
    previous = row.trajectory;
  }
  return text;
}

std::string means_heading(bool with_paper) {
  Json heading = experiment_columns();
  for (const char* column : {"seeds", "frames", "coverage", "visible_frames", "found", "usable"})
    heading.push_back(column);
  for (const Headline& headline : kHeadlines) {
    for (const char* part : {"mean", "interval_low", "interval_high"})
      heading.push_back(fmt::format("{}_{}", headline.metric, part));
    if (with_paper && headline.paper) heading.push_back(fmt::format("{}_paper", headline.metric));
  }
  return csv_line(heading);
}

/// `paper`: null where the paper has only a bar.
std::string means_line(const std::string& run, const ExperimentResult& experiment, bool with_paper,
                       const PaperErrors* paper) {
  Json cells = experiment_cells(run, experiment.key);
  cells.push_back(experiment.runs.size());
  cells.push_back(experiment.coverage.frames);
  const Coverage& coverage = experiment.coverage;
  for (const auto& share : {coverage.share(), coverage.found_share(), coverage.usable_share()})
    cells.push_back(rounded_or_null(share));
  cells.insert(cells.end() - 2, coverage.visible);
  for (const Headline& headline : kHeadlines) {
    const auto& interval = experiment.interval_of(headline.metric);
    cells.push_back(rounded_or_null(experiment.aggregate_of(headline.metric).mean));
    cells.push_back(interval ? Json(rounded(interval->low)) : nullptr);
    cells.push_back(interval ? Json(rounded(interval->high)) : nullptr);
    if (with_paper && headline.paper) cells.push_back(paper ? Json(paper->*headline.paper) : nullptr);
  }
  return csv_line(cells);
}

/// All errors of one variant or of the paper in one cell.
std::string errors_cell(const ExperimentResult* experiment) {
  if (!experiment || experiment->coverage.frames == 0) return "-";
  return fmt::format("{} / {} / {}, {}%", fixed(experiment->aggregate_of("position_error_mm").mean, 2),
                     fixed(experiment->aggregate_of("posture_rms_deg").mean, 2),
                     fixed(experiment->aggregate_of("rotation_error_deg").mean, 2),
                     fixed(covered_percent(*experiment), 1));
}

std::string errors_cell(const PaperErrors* paper) {
  if (!paper) return "-";
  return fmt::format("{:.2f} / {:.2f} / {:.2f}", paper->position_mm, paper->posture_deg, paper->rotation_deg);
}

/// A LaTeX row whose titles span each variant's columns.
std::string variant_heading() {
  std::string titles = " & ", rules;
  int column = 3;
  const auto span = [&](const std::string& title, int columns) {
    titles += fmt::format(" & \\multicolumn{{{}}}{{c}}{{{}}}", columns, escape_latex(title));
    rules += fmt::format("\\cmidrule(lr){{{}-{}}}", column, column + columns - 1);
    column += columns;
  };
  for (const Variant& variant : figure4_variants()) span(variant.title, 4);
  span("paper", 3);
  return titles + " \\\\\n" + rules + "\n";
}

}  // namespace

const std::array<Variant, 3>& figure4_variants() {
  static const std::array<Variant, 3> variants = {{{"recorded truth", TruthKind::recorded, 1},
                                                   {"source truth", TruthKind::source, 1},
                                                   {"source, second subject", TruthKind::source, 2}}};
  return variants;
}

std::array<std::string, 3> figure4_databases(std::string_view trajectory) {
  // Tr1 and Tr2 are pinches, the others power grasps (section IV).
  const bool is_pinch = trajectory == "Tr1" || trajectory == "Tr2";
  const bool is_power = trajectory == "Tr3" || trajectory == "Tr4" || trajectory == "Tr5";
  if (!is_pinch && !is_power) return {};
  return {is_pinch ? "DB_open_pinch" : "DB_open_power", "DB_open_pinch_power", "DB_20_postures"};
}

bool is_figure4(const RunResult& result) {
  const auto is_of_it = [](const ExperimentResult& experiment) {
    const ExperimentKey& key = experiment.key;
    return std::ranges::count(figure4_databases(key.trajectory), key.database) > 0 &&
           std::ranges::any_of(figure4_variants(),
                               [&](const Variant& variant) { return is_variant(key, variant); });
  };
  return !result.experiments.empty() && std::ranges::all_of(result.experiments, is_of_it);
}

std::vector<Figure4Row> figure4_rows(const RunResult& result, const PaperNumbers& paper,
                                     const NoiseSetting& noise) {
  std::vector<Figure4Row> rows;
  for (const ExperimentResult& experiment : result.experiments) {
    const ExperimentKey& key = experiment.key;
    if (key.noise != noise) continue;
    auto row = std::ranges::find_if(
        rows, [&](const Figure4Row& r) { return r.trajectory == key.trajectory && r.database == key.database; });
    if (row == rows.end())
      row = rows.insert(row, {key.trajectory, key.database, {}, paper.mean_of(key.trajectory, key.database)});
    for (size_t v = 0; v < figure4_variants().size(); ++v)
      if (is_variant(key, figure4_variants()[v])) row->variants[v] = &experiment;
  }
  return rows;
}

std::string figure4_table(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise,
                          size_t columns) {
  const std::vector<Figure4Row> rows = figure4_rows(result, paper, noise);
  const std::vector<Block> blocks = figure4_blocks();
  std::string text = wrapped(
      fmt::format("Mean errors: position (mm), posture (RMS of 22 angles, deg), rotation (deg); coverage (%). "
                  "Noise: {} x {}",
                  noise.model, noise.factor),
      columns);
  for (size_t first = 0, count = 0; first < blocks.size(); first += count) {
    size_t width = kNameWidth;
    for (count = 0; first + count < blocks.size(); ++count) {
      width += 1 + blocks[first + count].width;
      if (count > 0 && width > columns) break;
    }
    if (first > 0) text += "\n";
    text += blocks_text(std::span(blocks).subspan(first, count), rows);
  }
  return text;
}

Table figure4_summary(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise) {
  Table table = table_of({"trajectory", "database"}, 2);
  for (const Variant& variant : figure4_variants()) table.columns.push_back({"", variant.title});
  table.columns.push_back({"", "paper"});
  for (const Figure4Row& row : figure4_rows(result, paper, noise)) {
    table.rows.push_back({row.trajectory, row.database});
    for (const ExperimentResult* experiment : row.variants) table.rows.back().push_back(errors_cell(experiment));
    table.rows.back().push_back(errors_cell(row.paper));
  }
  return table;
}

std::string figure4_latex(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise) {
  const std::vector<std::string> errors = {"mm", "post. deg", "rot. deg"};
  Table table = table_of({"trajectory", "database"}, 2);
  const auto add_columns = [&](const std::vector<std::string>& headings) {
    for (const std::string& heading : headings) table.columns.push_back({"", heading});
  };
  for (size_t v = 0; v < figure4_variants().size(); ++v) {
    add_columns(errors);
    add_columns({"cov. %"});
  }
  add_columns(errors);
  for (const Figure4Row& row : figure4_rows(result, paper, noise)) {
    Row& cells = table.rows.emplace_back(Row{row.trajectory, row.database});
    for (const ExperimentResult* experiment : row.variants) {
      for (const Headline& headline : kPaperHeadlines)
        cells.push_back(experiment ? fixed(experiment->aggregate_of(headline.metric).mean, 2) : "-");
      cells.push_back(experiment ? fixed(covered_percent(*experiment), 1) : "-");
    }
    for (const Headline& headline : kPaperHeadlines)
      cells.push_back(row.paper ? fixed(row.paper->*headline.paper, 2) : "-");
  }
  return latex_comment(fmt::format("glovebench run {}: Figure 4, depth noise {} x {}", run_name(result),
                                   noise.model, noise.factor)) +
         to_latex(table, variant_heading());
}

std::string figure4_csv(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise) {
  const std::string run = run_name(result);
  std::string csv = means_heading(true);
  for (const Figure4Row& row : figure4_rows(result, paper, noise))
    for (const ExperimentResult* experiment : row.variants)
      if (experiment) csv += means_line(run, *experiment, true, row.paper);
  return csv;
}

std::string errors_csv(const RunResult& result) {
  const std::string run = run_name(result);
  std::string csv = means_heading(false);
  for (const ExperimentResult& experiment : result.experiments) csv += means_line(run, experiment, false, nullptr);
  return csv;
}

std::string metrics_csv(const RunResult& result) {
  const std::string run = run_name(result);
  std::vector<const Metric*> shown;
  Json heading = experiment_columns();
  for (const Metric& metric : metrics()) {
    if (metric.heading.empty()) continue;
    shown.push_back(&metric);
    heading.push_back(metric.key);
  }
  std::string csv = csv_line(heading);
  for (const ExperimentResult& experiment : result.experiments) {
    Json cells = experiment_cells(run, experiment.key);
    for (const Metric* metric : shown) cells.push_back(rounded_or_null(value_of(*metric, experiment)));
    csv += csv_line(cells);
  }
  return csv;
}

std::optional<double> covered_percent(const ExperimentResult& experiment) {
  std::optional<double> percent = experiment.coverage.share();
  if (percent) *percent *= 100;
  return percent;
}

Json experiment_columns() {
  return {"run", "experiment", "trajectory", "database", "truth", "subject", "noise", "noise_factor"};
}

Json experiment_cells(const std::string& run, const ExperimentKey& key) {
  return {run,         to_string(key),  key.trajectory,           key.database, to_string(key.truth),
          key.subject, key.noise.model, rounded(key.noise.factor)};
}

std::string frames_csv(const std::string& run, const ExperimentResult& experiment) {
  const std::vector<std::string> keys = frame_metric_keys();
  Json heading = {"run", "experiment", "seed"};
  for (const std::string& column : frame_columns(keys)) heading.push_back(column);
  std::string csv = csv_line(heading);
  for (const SeedRun& seed_run : experiment.runs) {
    for (const FrameRecord& frame : seed_run.frames) {
      Json cells = {run, to_string(experiment.key), seed_run.seed};
      for (const Json& cell : frame_row(frame, keys)) cells.push_back(cell);
      csv += csv_line(cells);
    }
  }
  return csv;
}

std::string curve_csv(const std::string& run, const ExperimentResult& experiment, const PaperCurve& paper) {
  std::string csv =
      "run,experiment,seed,frame,timestamp_us,status,position_error_mm,posture_rms_deg,rotation_error_deg,"
      "paper_position_error_mm,paper_posture_error_deg,paper_rotation_error_deg\n";
  for (const SeedRun& seed_run : experiment.runs) {
    for (size_t i = 0; i < seed_run.frames.size(); ++i) {
      const FrameRecord& frame = seed_run.frames[i];
      Json cells = {run,         to_string(experiment.key), seed_run.seed,
                    frame.frame, frame.timestamp_us,        std::string(to_string(frame.status))};
      for (const Headline& headline : kPaperHeadlines) cells.push_back(rounded_or_null(frame[headline.metric]));
      for (const Headline& headline : kPaperHeadlines)
        cells.push_back(i < paper.frames.size() ? Json(paper.frames[i].*headline.paper) : nullptr);
      csv += csv_line(cells);
    }
  }
  return csv;
}

Json csv_tables(const RunResult& result, const PaperNumbers& paper) {
  const std::string run = run_name(result);
  const NoiseSetting noise = headline_noise(result);
  Json tables = Json::object();
  if (is_figure4(result))
    tables["figure4"] = figure4_csv(result, paper, noise);
  else if (!result.experiments.empty())
    tables["errors"] = errors_csv(result);
  const auto add_curve = [&](const std::string& name, const PaperCurve& curve) {
    const ExperimentKey key = {curve.trajectory, curve.database, TruthKind::recorded, 1, noise};
    if (const ExperimentResult* experiment = find_experiment(result, key))
      tables[name] = curve_csv(run, *experiment, curve);
  };
  add_curve("figure5", paper.figure_5);
  add_curve("figure6", paper.figure_6);
  for (const StudyResult& study : result.studies)
    for (const Table& table : study.tables)
      tables[table.name] = to_csv(table, {{"run", run}, {"experiment", study.title}});
  return tables;
}

}  // namespace glovebench::reports
