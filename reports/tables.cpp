#include "reports/tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/json_text.h"
#include "reports/results_json.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

/// The errors of Figure 4, with the paper's members.
struct Headline {
  std::string_view metric;
  double PaperErrors::*paper;
};
constexpr std::array<Headline, 3> kHeadlines = {{{"position_error_mm", &PaperErrors::position_mm},
                                                 {"posture_rms_deg", &PaperErrors::posture_deg},
                                                 {"rotation_error_deg", &PaperErrors::rotation_deg}}};

std::string short_name(const std::string& database) {
  return database.starts_with("DB_") ? database.substr(3) : database;
}

std::optional<double> covered_percent(const ExperimentResult& experiment) {
  std::optional<double> percent = experiment.coverage.share();
  if (percent) *percent *= 100;
  return percent;
}

/// At most six columns wide, for errors up to a kilometer.
std::string narrow(const std::optional<double>& value) {
  return fixed(value, !value || *value < 99.995 ? 2 : *value < 9999.95 ? 1 : 0);
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

std::string table_line(std::string_view trajectory, std::string_view database,
                       const std::array<std::string, 4>& cells) {
  return fmt::format("{:<4} {:<16}|{:^25}|{:^25}|{:^25}|{:^18}", trajectory, database, cells[0], cells[1], cells[2],
                     cells[3]);
}

std::string figure4_csv_line(const ExperimentResult& experiment, const PaperErrors* paper) {
  const ExperimentKey& key = experiment.key;
  Json cells = {key.trajectory,
                key.database,
                to_string(key.truth),
                key.subject,
                experiment.runs.size(),
                experiment.coverage.frames,
                rounded_or_null(experiment.coverage.share())};
  for (const Headline& headline : kHeadlines) {
    const auto& interval = experiment.interval_of(headline.metric);
    cells.push_back(rounded_or_null(experiment.aggregate_of(headline.metric).mean));
    cells.push_back(interval ? Json(rounded(interval->low)) : nullptr);
    cells.push_back(interval ? Json(rounded(interval->high)) : nullptr);
    cells.push_back(paper ? Json(paper->*headline.paper) : nullptr);
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

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

}  // namespace

const std::array<Variant, 3>& figure4_variants() {
  static const std::array<Variant, 3> variants = {{{"recorded truth", TruthKind::recorded, 1},
                                                   {"source truth", TruthKind::source, 1},
                                                   {"source, second subject", TruthKind::source, 2}}};
  return variants;
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
      if (figure4_variants()[v].truth == key.truth && figure4_variants()[v].subject == key.subject)
        row->variants[v] = &experiment;
  }
  return rows;
}

std::string figure4_table(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise) {
  const std::string units = fmt::format("{:>6} {:>6} {:>6} {:>5}", "mm", "post.", "rot.", "cov.");
  std::string text = fmt::format(
      "Mean errors: position (mm), posture (RMS of 22 angles, deg), rotation (deg); coverage (%). Noise: {} x {}\n",
      noise.model, noise.factor);
  text += trimmed(table_line(
      "", "", {figure4_variants()[0].title, figure4_variants()[1].title, figure4_variants()[2].title, "paper"}));
  text += trimmed(table_line("", "database DB_",
                             {units, units, units, fmt::format("{:>5} {:>5} {:>5}", "mm", "post.", "rot.")}));
  std::string previous;
  for (const Figure4Row& row : figure4_rows(result, paper, noise)) {
    if (row.trajectory != previous) text += fmt::format("{0:-<21}+{0:-<25}+{0:-<25}+{0:-<25}+{0:-<18}\n", "");
    text += trimmed(table_line(row.trajectory == previous ? "" : row.trajectory, short_name(row.database),
                               {variant_cells(row.variants[0]), variant_cells(row.variants[1]),
                                variant_cells(row.variants[2]), paper_cells(row.paper)}));
    previous = row.trajectory;
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
      for (const Headline& headline : kHeadlines)
        cells.push_back(experiment ? fixed(experiment->aggregate_of(headline.metric).mean, 2) : "-");
      cells.push_back(experiment ? fixed(covered_percent(*experiment), 1) : "-");
    }
    for (const Headline& headline : kHeadlines)
      cells.push_back(row.paper ? fixed(row.paper->*headline.paper, 2) : "-");
  }
  return to_latex(table, variant_heading());
}

std::string figure4_csv(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise) {
  Json heading = {"trajectory", "database", "truth", "subject", "seeds", "frames", "coverage"};
  for (const Headline& headline : kHeadlines)
    for (const char* part : {"mean", "interval_low", "interval_high", "paper"})
      heading.push_back(fmt::format("{}_{}", headline.metric, part));
  std::string csv = csv_line(heading);
  for (const Figure4Row& row : figure4_rows(result, paper, noise))
    for (const ExperimentResult* experiment : row.variants)
      if (experiment) csv += figure4_csv_line(*experiment, row.paper);
  return csv;
}

std::string frames_csv(const ExperimentResult& experiment) {
  const std::vector<std::string> keys = frame_metric_keys();
  std::string csv = "seed";
  for (const std::string& column : frame_columns(keys)) csv += "," + column;
  csv += "\n";
  for (const SeedRun& run : experiment.runs)
    for (const FrameRecord& frame : run.frames)
      csv += fmt::format("{},{}", run.seed, csv_line(frame_row(frame, keys)));
  return csv;
}

std::string curve_csv(const ExperimentResult& experiment, const PaperCurve& paper) {
  std::string csv =
      "seed,frame,timestamp_us,status,position_error_mm,posture_rms_deg,rotation_error_deg,"
      "paper_position_error_mm,paper_posture_error_deg,paper_rotation_error_deg\n";
  for (const SeedRun& run : experiment.runs) {
    for (size_t i = 0; i < run.frames.size(); ++i) {
      const FrameRecord& frame = run.frames[i];
      Json cells = {run.seed,
                    frame.frame,
                    frame.timestamp_us,
                    std::string(to_string(frame.status)),
                    rounded_or_null(frame["position_error_mm"]),
                    rounded_or_null(frame["posture_rms_deg"]),
                    rounded_or_null(frame["rotation_error_deg"])};
      if (i < paper.frames.size()) {
        const PaperErrors& errors = paper.frames[i];
        for (const double value : {errors.position_mm, errors.posture_deg, errors.rotation_deg})
          cells.push_back(value);
      } else {
        for (int column = 0; column < 3; ++column) cells.push_back(nullptr);
      }
      csv += csv_line(cells);
    }
  }
  return csv;
}

Json csv_tables(const RunResult& result, const PaperNumbers& paper) {
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
  return tables;
}

}  // namespace glovebench::reports
