#include "reports/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

Texts headings_of(const Table& table) {
  Texts texts;
  for (const Column& column : table.columns) texts.push_back(column.heading);
  return texts;
}

Texts texts_of(const Table& table, const Row& row) {
  Texts texts;
  for (size_t c = 0; c < row.size(); ++c) texts.push_back(cell_text(row[c], table.columns[c]));
  return texts;
}

bool is_name_column(const Table& table, size_t column) { return std::cmp_less(column, table.name_columns); }

/// "0.00" for "-0.00".
std::string without_minus_zero(std::string text) {
  if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string markdown_cell(const Cell& cell, const Column& column) {
  const std::string text = escape_markdown(cell_text(cell, column));
  const auto* judgment = std::get_if<Judgment>(&cell);
  const bool is_bold = judgment && (judgment->tone == Tone::better || judgment->tone == Tone::worse);
  return is_bold ? "**" + text + "**" : text;
}

std::string html_cell(const Cell& cell, const Column& column) {
  const std::string text = escape_html(cell_text(cell, column));
  const auto* judgment = std::get_if<Judgment>(&cell);
  return judgment ? fmt::format("<span class=\"verdict {}\">{}</span>", glovebench::to_string(judgment->tone), text)
                  : text;
}

std::string html_heading(const Column& column, const std::string& link) {
  const std::string text = escape_html(column.heading);
  return link.empty() ? text : fmt::format("<a href=\"{}\">{}</a>", escape_html(link), text);
}

/// True if names of a column, which is not the first, are too long for a line.
bool has_long_names(const Table& table, size_t column) {
  constexpr size_t kLong = 60;  // bytes
  return column > 0 && is_name_column(table, column) && std::ranges::any_of(table.rows, [&](const Row& row) {
           return cell_text(row[column], table.columns[column]).size() > kLong;
         });
}

/// The attribute of each column's cells.
std::vector<std::string> html_classes(const Table& table) {
  std::vector<std::string> classes(table.columns.size());
  for (size_t c = 0; c < classes.size(); ++c) {
    if (!is_name_column(table, c)) continue;
    classes[c] = has_long_names(table, c) ? " class=\"name long\"" : " class=\"name\"";
  }
  return classes;
}

/// A row of HTML cells, with the plot's cell after the names if there is one.
std::string html_row(const Table& table, const std::vector<std::string>& classes, const char* tag,
                     const Texts& cells, const std::string* plot) {
  std::string html = "<tr>";
  for (size_t c = 0; c < cells.size(); ++c) {
    if (plot && std::cmp_equal(c, table.name_columns)) html += fmt::format("<{0}>{1}</{0}>", tag, *plot);
    html += fmt::format("<{0}{1}>{2}</{0}>", tag, classes[c], cells[c]);
  }
  return html + "</tr>";
}

/// Replaces a hyphen by a minus sign, and no value by a dash.
std::string latex_number(const std::string& text) {
  if (text == "-") return "--";
  return text.starts_with('-') ? "$-$" + escape_latex(text.substr(1)) : escape_latex(text);
}

/// Column widths that the texts need on a terminal.
std::vector<size_t> widths_of(const std::vector<Texts>& lines, size_t first) {
  std::vector<size_t> widths(lines.front().size());
  for (const Texts& line : lines)
    for (size_t c = first; c < line.size(); ++c) widths[c] = std::max(widths[c], text_width(line[c]));
  return widths;
}

/// A spreadsheet takes text for a formula if it begins like one. An apostrophe, which it hides, prevents that.
/// Numbers stay numbers.
std::string without_formula(const std::string& text) {
  const bool looks_like_one = !text.empty() && std::string_view("=+-@\t\r\n").find(text[0]) != std::string::npos;
  const bool is_number = std::isfinite(number_in<double>(text).value_or(NAN));
  return looks_like_one && !is_number ? "'" + text : text;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

}  // namespace

Cell cell(const std::optional<double>& value) { return value ? Cell(*value) : Cell(); }

Table table_of(const std::vector<std::string>& headings, int name_columns) {
  Table table;
  for (const std::string& heading : headings) table.columns.push_back({"", heading});
  table.name_columns = name_columns;
  return table;
}

int column_index(const Table& table, std::string_view key) {
  const auto it = std::ranges::find(table.columns, key, &Column::key);
  check(it != table.columns.end(), "a table has the column that is asked for");
  return static_cast<int>(it - table.columns.begin());
}

std::string cell_text(const Cell& cell, const Column& column) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* judgment = std::get_if<Judgment>(&cell)) return judgment->text;
  if (const auto* count = std::get_if<int64_t>(&cell)) return std::to_string(*count);
  if (const auto* number = std::get_if<double>(&cell))
    return without_minus_zero(fmt::format("{:.{}f}", rounded(*number), column.digits));
  return "-";
}

Json cell_json(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return valid_utf8(*text);
  if (const auto* judgment = std::get_if<Judgment>(&cell)) return valid_utf8(judgment->text);
  if (const auto* count = std::get_if<int64_t>(&cell)) return *count;
  if (const auto* number = std::get_if<double>(&cell)) return rounded(*number);
  return nullptr;
}

std::string to_markdown(const Table& table) {
  const auto line = [](const Texts& cells) { return fmt::format("| {} |\n", fmt::join(cells, " | ")); };
  Texts heading = headings_of(table);
  for (std::string& text : heading) text = escape_markdown(text);
  std::string markdown = line(heading) + "|";
  for (size_t c = 0; c < heading.size(); ++c) markdown += is_name_column(table, c) ? " --- |" : " ---: |";
  markdown += "\n";
  for (const Row& row : table.rows) {
    Texts cells;
    for (size_t c = 0; c < row.size(); ++c) cells.push_back(markdown_cell(row[c], table.columns[c]));
    markdown += line(cells);
  }
  return markdown;
}

std::string to_html(const Table& table, const std::vector<std::string>& plots, std::string (*link)(const Column&)) {
  const std::string no_title;
  Texts heading;
  for (const Column& column : table.columns) heading.push_back(html_heading(column, link ? link(column) : ""));
  const std::vector<std::string> classes = html_classes(table);
  std::string html = "<div class=\"scroll\"><table>\n<thead>" +
                     html_row(table, classes, "th", heading, plots.empty() ? nullptr : &no_title) +
                     "</thead>\n<tbody>\n";
  for (size_t r = 0; r < table.rows.size(); ++r) {
    Texts cells;
    for (size_t c = 0; c < table.columns.size(); ++c)
      cells.push_back(html_cell(table.rows[r][c], table.columns[c]));
    html += html_row(table, classes, "td", cells, plots.empty() ? nullptr : &plots[r]) + "\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string to_latex(const Table& table, const std::string& heading) {
  const auto line = [](const Texts& cells) { return fmt::format("{} \\\\\n", fmt::join(cells, " & ")); };
  const auto names = std::min<size_t>(table.name_columns, table.columns.size());
  Texts titles = headings_of(table);
  for (std::string& title : titles) title = escape_latex(title);
  std::string latex = fmt::format("\\begin{{tabular}}{{{}{}}}\n\\toprule\n{}{}\\midrule\n", std::string(names, 'l'),
                                  std::string(table.columns.size() - names, 'r'), heading, line(titles));
  for (const Row& row : table.rows) {
    Texts cells = texts_of(table, row);
    for (size_t c = 0; c < cells.size(); ++c)
      cells[c] = is_name_column(table, c) ? escape_latex(cells[c]) : latex_number(cells[c]);
    latex += line(cells);
  }
  return latex + "\\bottomrule\n\\end{tabular}\n";
}

std::string to_text(const Table& table, bool grouped, size_t columns) {
  std::vector<Texts> lines = {headings_of(table)};
  for (const Row& row : table.rows) lines.push_back(texts_of(table, row));
  const auto is_left = [&](size_t column) {
    const bool is_verdict = !table.rows.empty() && std::holds_alternative<Judgment>(table.rows.front()[column]);
    return is_name_column(table, column) || is_verdict;
  };
  const size_t first = grouped ? 1 : 0;
  std::vector<size_t> widths = widths_of(lines, first);
  size_t total = std::accumulate(widths.begin(), widths.end(), size_t{0});
  const size_t gaps = widths.size() - 1;
  const size_t gap = total + 2 * gaps <= columns ? 2 : 1;
  for (; total + gap * gaps > columns; --total) --*std::ranges::max_element(widths);
  std::string text;
  for (size_t l = 0; l < lines.size(); ++l) {
    if (grouped && l > 0 && (l == 1 || lines[l][0] != lines[l - 1][0]))
      text += shortened(lines[l][0], columns) + "\n";
    std::string line;
    for (size_t c = first; c < lines[l].size(); ++c) {
      const std::string cell = shortened(lines[l][c], widths[c]);
      const std::string padding(widths[c] - text_width(cell), ' ');
      if (c > 0) line.append(gap, ' ');
      line += is_left(c) ? cell + padding : padding + cell;
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

void erase_column(Table& table, size_t column) {
  const auto at = static_cast<std::ptrdiff_t>(column);
  table.columns.erase(table.columns.begin() + at);
  for (Row& row : table.rows) row.erase(row.begin() + at);
  if (at < table.name_columns) --table.name_columns;
}

Table without_long_names(Table table) {
  for (int column = table.name_columns - 1; column > 0; --column)
    if (has_long_names(table, static_cast<size_t>(column))) erase_column(table, static_cast<size_t>(column));
  return table;
}

std::string to_csv(const Table& table, const std::vector<std::pair<std::string, std::string>>& names) {
  Json heading = Json::array();
  for (const auto& [column, value] : names) heading.push_back(column);
  for (const Column& column : table.columns) heading.push_back(column.key);
  std::string csv = csv_line(heading);
  for (const Row& row : table.rows) {
    Json cells = Json::array();
    for (const auto& [column, value] : names) cells.push_back(valid_utf8(value));
    for (const Cell& cell : row) cells.push_back(cell_json(cell));
    csv += csv_line(cells);
  }
  return csv;
}

std::string csv_line(const Json& cells) {
  std::string line;
  for (const auto& cell : cells) {
    if (&cell != &cells.front()) line += ',';
    if (!cell.is_null()) line += cell.is_string() ? quoted(without_formula(cell.get<std::string>())) : cell.dump();
  }
  return line + "\n";
}

}  // namespace glovebench::reports
