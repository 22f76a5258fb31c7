#include "reports/latex.h"

#include <fmt/format.h>

#include <algorithm>

namespace glovebench::reports {
namespace {

/// A number with a minus sign instead of a hyphen; a dash where there is none.
std::string number_cell(const std::string& text) {
  if (text == "-") return "--";
  return text.starts_with('-') ? "$-$" + escape_latex(text.substr(1)) : escape_latex(text);
}

std::string table_row(const std::vector<std::string>& cells, int name_columns) {
  std::string row;
  for (size_t c = 0; c < cells.size(); ++c) {
    if (c > 0) row += " & ";
    row += static_cast<int>(c) < name_columns ? escape_latex(cells[c]) : number_cell(cells[c]);
  }
  return row + " \\\\\n";
}

void append_variant(std::vector<std::string>& row, const ExperimentResult* experiment) {
  if (!experiment) {
    row.insert(row.end(), 4, "-");
    return;
  }
  for (const char* metric : {"position_error_mm", "posture_rms_deg", "rotation_error_deg"})
    row.push_back(fixed(experiment->aggregate_of(metric).mean, 2));
  std::optional<double> percent = experiment->coverage.share();
  if (percent) *percent *= 100;
  row.push_back(fixed(percent, 1));
}

/// A row that spans each variant's columns with its title.
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

std::string escape_latex(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) {
      escaped.append("\\") += c;
    } else if (std::string_view("[]*").find(c) != std::string_view::npos) {
      escaped.append("{").append(1, c) += "}";  // else an option of the \\ before it
    } else if (c == '\\') {
      escaped += "\\textbackslash{}";
    } else if (c == '~') {
      escaped += "\\textasciitilde{}";
    } else if (c == '^') {
      escaped += "\\textasciicircum{}";
    } else if (c == '<') {
      escaped += "\\textless{}";
    } else if (c == '>') {
      escaped += "\\textgreater{}";
    } else {
      escaped += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  }
  return escaped;
}

std::string to_latex(const TextTable& table, const std::string& heading) {
  const auto names = std::min<size_t>(table.name_columns, table.heading.size());
  std::string text = fmt::format("\\begin{{tabular}}{{{}{}}}\n\\toprule\n{}", std::string(names, 'l'),
                                 std::string(table.heading.size() - names, 'r'), heading);
  text += table_row(table.heading, static_cast<int>(table.heading.size())) + "\\midrule\n";
  for (const auto& row : table.rows) text += table_row(row, table.name_columns);
  return text + "\\bottomrule\n\\end{tabular}\n";
}

std::string figure4_latex(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise) {
  TextTable table;
  table.heading = {"trajectory", "database"};
  for (size_t v = 0; v < figure4_variants().size(); ++v)
    for (const char* title : {"mm", "post. deg", "rot. deg", "cov. %"}) table.heading.push_back(title);
  for (const char* title : {"mm", "post. deg", "rot. deg"}) table.heading.push_back(title);
  for (const Figure4Row& row : figure4_rows(result, paper, noise)) {
    std::vector<std::string>& cells = table.rows.emplace_back();
    cells = {row.trajectory, row.database};
    for (const ExperimentResult* experiment : row.variants) append_variant(cells, experiment);
    for (const auto error : {&PaperErrors::position_mm, &PaperErrors::posture_deg, &PaperErrors::rotation_deg})
      cells.push_back(row.paper ? fixed(row.paper->*error, 2) : "-");
  }
  return to_latex(table, variant_heading());
}

}  // namespace glovebench::reports
