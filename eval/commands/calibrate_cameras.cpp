#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "calibration/camera_report.h"
#include "calibration/stereo_fit.h"
#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "eval/commands/calibrate.h"
#include "eval/commands/command.h"
#include "eval/commands/track_source.h"
#include "eval/progress.h"

namespace glovebench::eval {
namespace {

/// A Kinect's depth image, and its color image.
constexpr int kDepthWidth = 640, kDepthHeight = 480;
/// What an IR picture may have more on each axis: libfreenect's have eight rows.
constexpr int kMostRim = 16;

struct CalibrateCameras {
  std::string ir, rgb;
  std::string board = "9x6";
  double square_mm = 25;
  std::string lens = "radial";
  std::vector<double> ir_offset = {0, 0};
  size_t most = 60;
  std::string output, report;
  bool quiet = false;

  void run() const {
    const calibration::Chessboard chessboard = parse_board();
    const std::optional<calibration::LensModel> model = calibration::lens_model_from_string(lens);
    if (!model) throw Error("--lens", "value", lens, "none, radial or full");
    const calibration::BoardViews ir_boards = boards_of(ir, chessboard, "IR");
    const calibration::BoardViews rgb_boards = boards_of(rgb, chessboard, "RGB");
    calibration::StereoFit fit = calibration::fit_stereo(ir_boards, rgb_boards, chessboard, *model);
    fit.calibration.ir = depth_camera(fit.calibration.ir);
    require_device_size(fit.calibration.rgb);
    save_calibration(fit.calibration, output);
    if (!report.empty()) write_file(report, calibration::report_json(fit, chessboard).dump(2) + "\n");
    fmt::print("{}\n{}: both cameras and the transform between them\n", calibration::report_text(fit), output);
  }

  calibration::BoardViews boards_of(const std::string& source, const calibration::Chessboard& chessboard,
                                    const char* camera) const {
    Progress progress(fmt::format("{} views", camera), quiet);
    calibration::BoardViews views = calibration::find_boards(
        source, chessboard, most,
        [&](size_t done, size_t count) { progress.show(static_cast<double>(done) / static_cast<double>(count)); });
    say_changed(source, views.changed);
    return views;
  }

  /// "9x6".
  calibration::Chessboard parse_board() const {
    calibration::Chessboard chessboard{.square = square_mm / 1000};
    const char* end = board.data() + board.size();
    const auto columns = std::from_chars(board.data(), end, chessboard.columns);
    const bool has_rows = columns.ec == std::errc() && columns.ptr != end && *columns.ptr == 'x';
    const auto rows = has_rows ? std::from_chars(columns.ptr + 1, end, chessboard.rows) : columns;
    if (!has_rows || rows.ec != std::errc() || rows.ptr != end)
      throw Error("--board", "value", board, "inner corners such as 9x6");
    calibration::check_chessboard(chessboard, "--board, --square-mm");
    return chessboard;
  }

  void require_device_size(const PinholeCamera& camera) const {
    if (camera.width != kDepthWidth || camera.height != kDepthHeight)
      throw Error(rgb, "size", fmt::format("{}x{}", camera.width, camera.height),
                  fmt::format("{}x{}, as the device's frames are", kDepthWidth, kDepthHeight));
  }

  /// Of the depth image, which begins where --ir-offset says and may reach beyond the IR pictures.
  PinholeCamera depth_camera(PinholeCamera camera) const {
    const int rim_x = camera.width - kDepthWidth, rim_y = camera.height - kDepthHeight;
    if (std::min(rim_x, rim_y) < 0 || std::max(rim_x, rim_y) > kMostRim)
      throw Error(
          ir, "size", fmt::format("{}x{}", camera.width, camera.height),
          fmt::format("the {}x{} of the depth image and a rim of at most {}", kDepthWidth, kDepthHeight, kMostRim));
    camera.width = kDepthWidth;
    camera.height = kDepthHeight;
    camera.cx -= ir_offset[0];
    camera.cy -= ir_offset[1];
    return camera;
  }
};

}  // namespace

void add_calibrate_cameras(CLI::App& calibrate) {
  CLI::App* command = calibrate.add_subcommand(
      "cameras",
      "Calibrate the cameras of a Kinect from pictures of a chessboard, for --calibration.\n"
      "Both cameras' pictures of one name must show the board in the same place (calibration/README.md).");
  const auto state = std::make_shared<CalibrateCameras>();
  command->add_option("--ir", state->ir, "pictures of the IR camera: a folder, or fakenect:FOLDER")->required();
  command->add_option("--rgb", state->rgb, "pictures of the RGB camera: a folder, or fakenect:FOLDER")->required();
  command->add_option("--board", state->board, "inner corners of the chessboard, COLUMNSxROWS")
      ->capture_default_str();
  command->add_option("--square-mm", state->square_mm, "side of a square, mm")->capture_default_str();
  command->add_option("--lens", state->lens, "distortion to fit: none, radial (k1, k2, k3), full (also p1, p2)")
      ->capture_default_str();
  command
      ->add_option("--ir-offset", state->ir_offset,
                   "where the depth image begins in the IR pictures: pixels from the left, from the top")
      ->expected(2)
      ->check(number_within(-16, 16))
      ->capture_default_str();
  command->add_option("--most", state->most, "of a recording, take at most that many pictures")
      ->check(CLI::Range(5, 10000))
      ->capture_default_str();
  command->add_option("-o,--output", state->output, "calibration to write (*.json)")
      ->check(named_file())
      ->required();
  command->add_option("--report", state->report, "errors of every view, to write (*.json)")->check(named_file());
  command->add_flag("--quiet", state->quiet, "no progress");
  command->callback([state] { state->run(); });
}

}  // namespace glovebench::eval
