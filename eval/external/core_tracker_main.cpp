// The paper's tracker as a program of its own, with the core library alone (eval/guides/tracker.md):
// exec:"core_tracker MESH DATABASE.glovedb COLORS"
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/base/math.h"
#include "core/kinect/disparity.h"
#include "core/tracker/tracker.h"

using namespace glovebench;
using nlohmann::json;

/// What glovebench sends after the line `header`.
static DeviceFrame read_frame(const json& header, const json& start, const RgbdCalibration& calibration) {
  DeviceFrame frame{{calibration.ir.width, calibration.ir.height},
                    {calibration.rgb.width, calibration.rgb.height},
                    header["depth_timestamp_us"],
                    header["color_timestamp_us"]};
  const double unit = start["depth_unit_mm"].get<double>() / 1000;  // m
  Image<uint16_t>& depth = frame.raw_disparity;
  std::cin.read(reinterpret_cast<char*>(depth.data()), header["depth_bytes"]);
  std::cin.read(reinterpret_cast<char*>(frame.color.data()), header["rgb_bytes"]);
  for (uint16_t& pixel : depth) pixel = disparity_from_depth(pixel * unit, calibration.disparity);
  return frame;
}

static json answer_of(int number, const TrackResult& result) {
  json answer = {{"frame", number}, {"status", to_string(result.status)}};
  if (result.status != TrackStatus::tracked) return answer;
  for (const double angle : result.posture) answer["angles_deg"].push_back(degrees_from_radians(angle));
  const Eigen::Vector3d p = 1000 * result.T_camera_hand.translation();
  const Eigen::Quaterniond q(result.T_camera_hand.linear());
  answer["position_mm"] = {p.x(), p.y(), p.z()};
  answer["quaternion_wxyz"] = {q.w(), q.x(), q.y(), q.z()};
  return answer;
}

int main(int argc, char** argv) try {
  if (argc != 4) throw std::runtime_error("usage: core_tracker MESH DATABASE.glovedb COLORS");
  std::string line;
  std::getline(std::cin, line);
  const json start = json::parse(line);
  const RgbdCalibration calibration = calibration_from_json(start["calibration"], "stdin");
  const Tracker tracker(profile("paper"), calibration, std::make_shared<HandModel>(HandModel::load(argv[1])),
                        std::make_shared<Database>(Database::load(argv[2])),
                        std::make_shared<ColorTable>(ColorTable::load(argv[3])));
  std::vector<TrackResult> results;
  while (std::getline(std::cin, line)) {
    const json header = json::parse(line);
    results.push_back(tracker.track(read_frame(header, start, calibration), results));
    std::cout << answer_of(header["frame"], results.back()).dump() << std::endl;
  }
} catch (const std::exception& e) {
  std::fprintf(stderr, "core_tracker: %s\n", e.what());
  return 2;
}
