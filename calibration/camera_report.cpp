#include "calibration/camera_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/angles.h"

namespace glovebench::calibration {
namespace {

using nlohmann::json;

json errors_json(const std::string& name, double error_px) {
  return {{"name", name}, {"error_px", error_px}};
}

json left_out_json(const std::vector<LeftOut>& left_out) {
  json entries = json::array();
  for (const LeftOut& entry : left_out) entries.push_back({{"name", entry.name}, {"reason", entry.reason}});
  return entries;
}

json camera_json(const CameraFit& fit) {
  json views = json::array();
  for (size_t i = 0; i < fit.views.size(); ++i)
    views.push_back(errors_json(fit.views[i].name, fit.view_errors_px[i]));
  return {{"error_px", fit.error_px},
          {"deviation",
           {{"fx_px", fit.deviation.fx},
            {"fy_px", fit.deviation.fy},
            {"cx_px", fit.deviation.cx},
            {"cy_px", fit.deviation.cy}}},
          {"views", views},
          {"left_out", left_out_json(fit.left_out)}};
}

std::string camera_row(const char* name, const PinholeCamera& c, const LensDistortion& lens, const CameraFit& fit) {
  const PinholeCamera& d = fit.deviation;
  return fmt::format(
      "| {} | {:.2f} ± {:.2f} | {:.2f} ± {:.2f} | {:.2f} ± {:.2f} | {:.2f} ± {:.2f} | {:.4f}, {:.4f}, "
      "{:.4f}, {:.4f}, {:.4f} | {} | {:.3f} |\n",
      name, c.fx, d.fx, c.fy, d.fy, c.cx, d.cx, c.cy, d.cy, lens.k1, lens.k2, lens.p1, lens.p2, lens.k3,
      fit.views.size(), fit.error_px);
}

std::string left_out_lines(const char* of, const std::vector<LeftOut>& left_out) {
  std::string lines;
  for (const LeftOut& entry : left_out) lines += fmt::format("left out, {} {}: {}\n", of, entry.name, entry.reason);
  return lines;
}

}  // namespace

json report_json(const StereoFit& fit, const Chessboard& board) {
  json pairs = json::array();
  for (size_t i = 0; i < fit.pairs.size(); ++i) pairs.push_back(errors_json(fit.pairs[i], fit.pair_errors_px[i]));
  return {{"version", 1},
          {"chessboard", {{"columns", board.columns}, {"rows", board.rows}, {"square_m", board.square}}},
          {"ir", camera_json(fit.ir)},
          {"rgb", camera_json(fit.rgb)},
          {"stereo",
           {{"error_px", fit.error_px},
            {"translation_error_m", fit.translation_error},
            {"rotation_error_deg", degrees_from_radians(fit.rotation_error)},
            {"pairs", pairs},
            {"left_out", left_out_json(fit.left_out)}}}};
}

std::string report_text(const StereoFit& fit) {
  const Eigen::Vector3d t_mm = 1000 * fit.calibration.T_rgb_ir.translation();
  const double angle = Eigen::AngleAxisd(fit.calibration.T_rgb_ir.linear()).angle();
  return "| camera | fx px | fy px | cx px | cy px | k1, k2, p1, p2, k3 | views | error px |\n"
         "| --- | --- | --- | --- | --- | --- | ---: | ---: |\n" +
         camera_row("IR", fit.calibration.ir, fit.calibration.ir_lens, fit.ir) +
         camera_row("RGB", fit.calibration.rgb, fit.calibration.rgb_lens, fit.rgb) +
         fmt::format(
             "\nIR to RGB: {:.2f}, {:.2f}, {:.2f} mm (± {:.2f}), turned by {:.3f} degrees (± {:.3f}); {} pairs, "
             "error {:.3f} px\n",
             t_mm.x(), t_mm.y(), t_mm.z(), 1000 * fit.translation_error, degrees_from_radians(angle),
             degrees_from_radians(fit.rotation_error), fit.pairs.size(), fit.error_px) +
         left_out_lines("IR", fit.ir.left_out) + left_out_lines("RGB", fit.rgb.left_out) +
         left_out_lines("pair", fit.left_out);
}

}  // namespace glovebench::calibration
