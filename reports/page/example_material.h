#pragma once

#include <opencv2/imgproc.hpp>

#include "core/adapters/pictures/picture_files.h"
#include "reports/page/page.h"

namespace glovebench::reports {

inline FrameSheet example_sheet(const std::string& figure, int frames) {
  FrameSheet sheet{figure, "", 16, 160, 128, 0, frames};
  const int rows = (frames + sheet.columns - 1) / sheet.columns;
  ColorImage pixels(sheet.columns * sheet.tile_width, 2 * rows * sheet.tile_height, Rgb{30, 25, 20});
  cv::Mat image(pixels.height(), pixels.width(), CV_8UC3, pixels.data());
  for (int frame = 0; frame < frames; ++frame) {
    for (const int row : {0, 1}) {
      const cv::Point corner(frame % sheet.columns * sheet.tile_width,
                             (2 * (frame / sheet.columns) + row) * sheet.tile_height);
      const cv::Point center = corner + cv::Point(80, 64);
      cv::ellipse(image, center, {40 + frame % 20, 30}, 3.0 * frame, 0, 360,
                  row == 0 ? cv::Scalar(200, 140, 60) : cv::Scalar(240, 240, 240), cv::FILLED, cv::LINE_AA);
      cv::putText(image, std::to_string(frame), corner + cv::Point(8, 24), cv::FONT_HERSHEY_SIMPLEX, 0.6,
                  {220, 220, 220}, 1, cv::LINE_AA);
    }
  }
  sheet.image = encode_jpeg(pixels, 90);
  return sheet;
}

inline Column example_column(const std::string& key) {
  return {key, key, 2, key.find("_ms") != std::string::npos || key.find("_us") != std::string::npos};
}
inline Table example_table(const std::string& name, const std::string& title, const std::vector<std::string>& keys,
                           int name_columns) {
  Table table{name, title, "Invented numbers.", {}, name_columns, {}};
  for (const std::string& key : keys) table.columns.push_back(example_column(key));
  return table;
}

inline StudyResult example_figure9() {
  Table table = example_table(
      "figure9", "Sub-sampling",
      {"truth", "database", "factor", "icp_points", "position_error_mm", "position_error_mm_low",
       "position_error_mm_high", "rotation_error_deg", "rotation_error_deg_low", "rotation_error_deg_high"},
      3);
  Table times = example_table("figure9_times", "Time with sub-sampling",
                              {"implementation", "factor", "frame_ms_p50", "look_up_ms_p50"}, 2);
  for (const std::string database : {"DB_open_power", "DB_20_postures"}) {
    for (int64_t factor = 1; factor <= 64; factor *= 2) {
      const double f = static_cast<double>(factor), mm = 2 + 0.02 * f + (database == "DB_20_postures" ? 1 : 0);
      table.rows.push_back(
          {"source", database, factor, 3000 / factor, mm, mm - 0.2, mm + 0.3, 2 * mm, 1.8 * mm, 2.3 * mm});
    }
  }
  for (const std::string implementation : {"plain", "fast"}) {
    const double speed = implementation == "plain" ? 1 : 20;
    for (int64_t factor = 1; factor <= 64; factor *= 2)
      times.rows.push_back({implementation, factor, (6 + 60.0 / static_cast<double>(factor)) / speed, 4 / speed});
  }
  return {"fig9", "Figure 9: sub-sampling", {table, times}, {}};
}

inline StudyResult example_ablations() {
  std::vector<std::string> keys = {"ablation", "setting", "database"};
  for (const std::string error : {"position", "posture", "rotation"}) {
    const std::string unit = error == "position" ? "_mm" : "_deg";
    keys.push_back(error + "_error" + unit);
    for (const std::string part : {"", "_low", "_high"}) keys.push_back(error + "_change" + unit + part);
  }
  for (const char* key : {"covered_percent", "jitter_position_mm", "jitter_rotation_deg", "latency_frames"})
    keys.emplace_back(key);
  Table table = example_table("ablations", "One change at a time", keys, 3);
  const Cell none;
  for (const std::string ablation : {"filter", "neighbors", "colors in the alignment", "noise"}) {
    for (const std::string database : {"DB_open_power", "DB_20_postures"}) {
      for (const std::string setting : {"as in the paper", "off", "double"}) {
        const double change = (setting == "off" ? 1.0 : -0.3) * static_cast<double>(ablation.size()) / 5;
        std::vector<Cell> row = {ablation, setting, database};
        for (const double error : {3.0, 6.0, 2.0}) {
          row.emplace_back(error);
          if (setting == "as in the paper")
            row.insert(row.end(), {none, none, none});
          else
            row.insert(row.end(), {change, change - 0.4, change + 0.5});
        }
        row.insert(row.end(), {100.0, 0.3, 0.2, 1.0});
        table.rows.push_back(row);
      }
    }
  }
  return {"ablations", "What the paper asserts, one change at a time", {table}, {}};
}

inline std::vector<Picture> example_pictures(const RunResult& result) {
  std::vector<Picture> pictures;
  for (const WorstFrame& worst : worst_frames(result))
    pictures.push_back(
        {caption(worst), encode_jpeg(ColorImage(400, 300, Rgb{90, 90, 90}), 90), explain_command(worst)});
  return pictures;
}

inline PageMaterial example_material(const RunResult& result, std::vector<std::string> scripts) {
  return {
      std::move(scripts), {example_sheet("figure5", 117), example_sheet("figure6", 137)}, example_pictures(result)};
}

}  // namespace glovebench::reports
