#include "reports/paper_numbers.h"

#include <array>

#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "reports/embedded.h"

namespace glovebench::reports {
namespace {

PaperErrors read_errors(const JsonCursor& json) {
  const JsonItems row = json.items();
  if (row.size() != 3) json.fail("position, posture and rotation error");
  const PaperErrors errors = {row[0].number(), row[1].number(), row[2].number()};
  if (errors.position_mm < 0 || errors.posture_deg < 0 || errors.rotation_deg < 0) json.fail("errors of 0 or more");
  return errors;
}

PaperCurve read_curve(const JsonCursor& json) {
  json.expect_keys({"trajectory", "database", "columns", "mean", "frames"});
  constexpr std::array<std::string_view, 3> kColumns = {"position_error_mm", "posture_error_deg",
                                                        "rotation_error_deg"};
  const JsonItems columns = json["columns"].items();
  if (columns.size() != kColumns.size()) json["columns"].fail("three columns");
  for (size_t i = 0; i < kColumns.size(); ++i) columns[i].expect_text(kColumns[i]);
  PaperCurve curve{json["trajectory"].text(), json["database"].text(), read_errors(json["mean"]), {}};
  for (const JsonCursor& frame : json["frames"].items()) curve.frames.push_back(read_errors(frame));
  return curve;
}

PaperCascade read_cascade(const JsonCursor& json) {
  json.expect_keys({"database", "cascade", "posture_error_deg", "time_ms"});
  PaperCascade row{json["database"].text(), {}, json["posture_error_deg"].number(), json["time_ms"].number()};
  for (const JsonCursor& stage : json["cascade"].items()) {
    const JsonItems values = stage.items();
    if (values.size() != 2) stage.fail("size and number kept");
    row.cascade.push_back({values[0].count(), values[1].count()});
  }
  return row;
}

}  // namespace

const PaperErrors* PaperNumbers::mean_of(const std::string& trajectory, const std::string& database) const {
  for (const PaperCurve* curve : {&figure_5, &figure_6})
    if (curve->trajectory == trajectory && curve->database == database) return &curve->mean;
  return nullptr;
}

const PaperNumbers& paper_numbers() {
  static const PaperNumbers numbers = parse_paper_numbers(embedded_paper_numbers(), "paper_numbers.json");
  return numbers;
}

PaperNumbers parse_paper_numbers(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor json(document, where);
  json.expect_format("glovebench-paper-numbers", 1);
  json.expect_keys({"format", "version", "source", "figure_5", "figure_6", "figure_8", "text_claims"});
  const JsonCursor claims = json["text_claims"];
  claims.expect_keys({"rate_hz", "rate_hardware", "mean_position_error_below_mm"});
  PaperNumbers numbers;
  numbers.source = json["source"].text();
  numbers.figure_5 = read_curve(json["figure_5"]);
  numbers.figure_6 = read_curve(json["figure_6"]);
  for (const JsonCursor& row : json["figure_8"].items()) numbers.figure_8.push_back(read_cascade(row));
  numbers.rate_hz = claims["rate_hz"].number();
  numbers.rate_hardware = claims["rate_hardware"].text();
  numbers.mean_position_error_below_mm = claims["mean_position_error_below_mm"].number();
  return numbers;
}

}  // namespace glovebench::reports
