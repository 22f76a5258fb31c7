#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "core/calibration/stereo_fit.h"
#include "eval/commands/flags.h"
#include "eval/sources/source.h"
#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

constexpr int kDepthWidth = 640, kDepthHeight = 480;
/// Most extra pixels of an IR picture per axis; libfreenect's has eight extra rows.
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
    require_different_files({{"--output", output}, {"--report", report}});
    const calibration::Chessboard chessboard = parse_board();
    const calibration::BoardViews ir_boards = boards_of(ir, chessboard, "IR");
    const calibration::BoardViews rgb_boards = boards_of(rgb, chessboard, "RGB");
    calibration::StereoFit fit =
        calibration::fit_stereo(ir_boards, rgb_boards, chessboard, from_name<calibration::LensModel>(lens).value());
    fit.calibration.ir = depth_camera(fit.calibration.ir);
    require_device_size(fit.calibration.rgb);
    save_calibration(fit.calibration, output);
    if (!report.empty()) write_file(report, calibration::report_json(fit, chessboard).dump(2) + "\n");
    if (quiet) return;
    fmt::print("{}\n{}: both cameras and the transform between them\n", calibration::report_text(fit), output);
  }

  calibration::BoardViews boards_of(const std::string& source, const calibration::Chessboard& chessboard,
                                    const char* camera) const {
    Progress progress(fmt::format("{} views", camera), quiet);
    calibration::BoardViews views = calibration::find_boards(
        source, chessboard, most,
        [&](size_t done, size_t count) { progress.show(static_cast<double>(done) / static_cast<double>(count)); });
    say_changed(source, views.changed, quiet);
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

  /// IR camera of the depth image, whose corner --ir-offset gives; the image may reach beyond the IR pictures.
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

void add_calibrate_cameras(Command calibrate) {
  const Command command = calibrate.subcommand(
      "cameras",
      "Calibrate the cameras of a Kinect from pictures of a chessboard, for --calibration.\n"
      "Both cameras' pictures of one name must show the board in the same place (core/calibration/README.md).");
  const auto state = std::make_shared<CalibrateCameras>();
  command.option("--ir", state->ir, "pictures of the IR camera: a folder, or fakenect:FOLDER").required();
  command.option("--rgb", state->rgb, "pictures of the RGB camera: a folder, or fakenect:FOLDER").required();
  command.option("--board", state->board, "inner corners of the chessboard, COLUMNSxROWS");
  command.option("--square-mm", state->square_mm, "side of a square, mm");
  command.option("--lens", state->lens, "distortion to fit: none; radial, k1, k2, k3; full, also p1, p2")
      .one_of(all_names<calibration::LensModel>());
  command
      .option("--ir-offset", state->ir_offset,
              "where the depth image begins in the IR pictures: pixels from the left, from the top")
      .count(2)
      .in(-16, 16);
  command.option("--most", state->most, "of a recording, take at most that many pictures").in(5, 10000);
  command.option("-o,--output", state->output, "calibration to write (*.json)").named_file().required();
  command.option("--report", state->report, "errors of every view, to write (*.json)").named_file();
  command.option("-q,--quiet", state->quiet, "print only errors");
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
