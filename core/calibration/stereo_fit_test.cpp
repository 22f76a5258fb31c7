// Cameras whose truth is known, from pictures of a board and from corners with noise.
#include "core/calibration/stereo_fit.h"
#include "core/base/enum_names.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/calibration/test_board.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench::calibration {
namespace {

using testing::HasSubstr;

/// The corners that were found in pictures of a board before both cameras.
struct Session {
  RgbdCalibration truth = kinect_with_lenses();
  Chessboard board;
  std::vector<Eigen::Isometry3d> T_ir_boards;
  BoardViews ir{640, 480, {}, {}}, rgb{640, 480, {}, {}};

  Session(const Chessboard& a_board, int poses)
      : board(a_board), T_ir_boards(poses_before(truth, a_board, poses, 1)) {
    const std::string corners = filled_once(shared_test_folder(), "corners", [&](const std::string& folder) {
      const auto T_rgb_boards = [&](const Eigen::Isometry3d& T) { return truth.T_rgb_ir * T; };
      find_in_pictures(folder + "/ir-", BoardCamera(truth.ir, truth.ir_lens), "ir", std::identity());
      find_in_pictures(folder + "/rgb-", BoardCamera(truth.rgb, truth.rgb_lens), "rgb", T_rgb_boards);
    });
    for (int i = 0; i < poses; ++i) {
      add(ir, read_corners(fmt::format("{}/ir-{}", corners, i)), i);
      add(rgb, read_corners(fmt::format("{}/rgb-{}", corners, i)), i);
    }
  }

 private:
  /// Takes the pictures of one camera, a twentieth of a second each, and writes the corners that are found.
  void find_in_pictures(const std::string& path, const BoardCamera& camera, const char* name,
                        const auto& T_camera_board) const {
    for (size_t i = 0; i < T_ir_boards.size(); ++i) {
      RandomStream noise(1, name, static_cast<int64_t>(i), "picture");
      const Corners corners =
          find_corners(camera.picture(T_camera_board(T_ir_boards[i]), board, noise), board).value_or(Corners{});
      write_file(path + std::to_string(i),
                 {reinterpret_cast<const char*>(corners.data()), corners.size() * sizeof(Eigen::Vector2d)});
    }
  }
  static Corners read_corners(const std::string& file) {
    const std::string bytes = read_file(file);
    Corners corners(bytes.size() / sizeof(Eigen::Vector2d));
    for (size_t c = 0; c < corners.size(); ++c)
      std::memcpy(corners[c].data(), bytes.data() + c * sizeof(Eigen::Vector2d), sizeof(Eigen::Vector2d));
    return corners;
  }
  static void add(BoardViews& views, Corners corners, int i) {
    if (corners.empty())
      views.left_out.push_back({std::to_string(i), "not found"});
    else
      views.views.push_back({std::to_string(i), std::move(corners)});
  }
};

/// A board that fits on a sheet of A4.
const Session& session() {
  static const Session session({9, 6, 0.025}, 30);
  return session;
}

/// Fewer pictures: a fit to half of them takes an eighth of the time.
Session half_of_the_session() {
  Session half = session();
  half.T_ir_boards.resize(half.T_ir_boards.size() / 2);
  half.ir.views.resize(half.T_ir_boards.size());
  half.rgb.views.resize(half.T_ir_boards.size());
  return half;
}

/// The same poses before lenses that are also a little askew, with the corners where they are.
Session askew_session() {
  Session askew = session();
  askew.truth.ir_lens.p1 = 0.0008;
  askew.truth.ir_lens.p2 = 0.0003;
  askew.truth.rgb_lens.p1 = -0.0019;
  askew.truth.rgb_lens.p2 = 0.0014;
  const RgbdCalibration& truth = askew.truth;
  for (size_t i = 0; i < askew.T_ir_boards.size(); ++i) {
    const Eigen::Isometry3d& T = askew.T_ir_boards[i];
    askew.ir.views[i].corners = true_corners(truth.ir, truth.ir_lens, T, askew.board);
    askew.rgb.views[i].corners = true_corners(truth.rgb, truth.rgb_lens, truth.T_rgb_ir * T, askew.board);
  }
  return askew;
}

BoardViews with_noise(BoardViews views, double sigma_px, uint64_t seed, const char* of) {
  RandomStream noise(seed, of, 0, "corners");
  for (BoardView& view : views.views)
    for (Eigen::Vector2d& corner : view.corners)
      corner += sigma_px * Eigen::Vector2d(noise.normal(), noise.normal());
  return views;
}

struct Errors {
  double focal = 0;  ///< the largest of four, as a share
  double translation_mm = 0, rotation_deg = 0;
};

Errors errors_of(const RgbdCalibration& found, const RgbdCalibration& truth) {
  const auto share = [](double a, double b) { return std::abs(a / b - 1); };
  return {std::max({share(found.ir.fx, truth.ir.fx), share(found.ir.fy, truth.ir.fy),
                    share(found.rgb.fx, truth.rgb.fx), share(found.rgb.fy, truth.rgb.fy)}),
          1000 * (found.T_rgb_ir.translation() - truth.T_rgb_ir.translation()).norm(),
          degrees_from_radians(
              Eigen::AngleAxisd(found.T_rgb_ir.linear() * truth.T_rgb_ir.linear().transpose()).angle())};
}

/// Fits to `seeds` times noise of 0.3 px in each coordinate; the largest of what the fits err by.
Errors worst_with_noise(const Session& session, LensModel lens, int seeds, const char* title) {
  Errors squares, worst;
  for (int seed = 1; seed <= seeds; ++seed) {
    const StereoFit fit = fit_stereo(with_noise(session.ir, 0.3, seed, "ir"),
                                     with_noise(session.rgb, 0.3, seed, "rgb"), session.board, lens);
    const Errors e = errors_of(fit.calibration, session.truth);
    squares = {squares.focal + e.focal * e.focal, squares.translation_mm + e.translation_mm * e.translation_mm,
               squares.rotation_deg + e.rotation_deg * e.rotation_deg};
    worst = {std::max(worst.focal, e.focal), std::max(worst.translation_mm, e.translation_mm),
             std::max(worst.rotation_deg, e.rotation_deg)};
    EXPECT_NEAR(fit.ir.error_px, 0.3 * std::numbers::sqrt2, 0.03) << "two coordinates of 0.3 px each";
    EXPECT_NEAR(fit.error_px, 0.3 * std::numbers::sqrt2, 0.03);
  }
  const Errors rms = {std::sqrt(squares.focal / seeds), std::sqrt(squares.translation_mm / seeds),
                      std::sqrt(squares.rotation_deg / seeds)};
  std::printf(
      "%s: RMS (worst) of %d seeds: focal length %.3f%% (%.3f%%), translation %.2f mm (%.2f), rotation "
      "%.3f degrees (%.3f)\n",
      title, seeds, 100 * rms.focal, 100 * worst.focal, rms.translation_mm, worst.translation_mm, rms.rotation_deg,
      worst.rotation_deg);
  return worst;
}

std::string refusal(const BoardViews& ir, const BoardViews& rgb, const Chessboard& board) {
  return thrown_by([&] { fit_stereo(ir, rgb, board, LensModel::radial); });
}

TEST(FindCorners, OfRenderedPicturesLieWithinAFractionOfAPixel) {
  const Session& s = session();
  ASSERT_EQ(s.ir.views.size(), s.T_ir_boards.size());
  ASSERT_EQ(s.rgb.views.size(), s.T_ir_boards.size());
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < s.T_ir_boards.size(); ++i) {
    const Corners truth = true_corners(s.truth.ir, s.truth.ir_lens, s.T_ir_boards[i], s.board);
    const Corners found = in_the_order_of(truth, s.ir.views[i].corners, s.board);
    for (size_t c = 0; c < truth.size(); ++c) sum += (found[c] - truth[c]).squaredNorm();
    count += truth.size();
  }
  const double rms = std::sqrt(sum / static_cast<double>(count));
  std::printf("corners: RMS %.3f px\n", rms);
  EXPECT_LT(rms, 0.1);
}

TEST(StereoFit, RecoversTheTruthFromPictures) {
  const Session& s = session();
  const StereoFit fit = fit_stereo(s.ir, s.rgb, s.board, LensModel::radial);
  const Errors errors = errors_of(fit.calibration, s.truth);
  std::printf("%sfocal %.3f%%, translation %.2f mm, rotation %.3f degrees\n", report_text(fit).c_str(),
              100 * errors.focal, errors.translation_mm, errors.rotation_deg);
  EXPECT_EQ(fit.pairs.size(), s.T_ir_boards.size());
  EXPECT_LT(errors.focal, 0.005);
  EXPECT_LT(errors.translation_mm, 1.0);
  EXPECT_LT(errors.rotation_deg, 0.1);
  // A lens is what it does to pixels: its coefficients trade with each other, and its center with a turn.
  for (const double x : {-0.4, -0.2, 0.2, 0.4}) {
    const Eigen::Vector3d p(x, 0.7 * x, 1);
    const RgbdCalibration& c = fit.calibration;
    EXPECT_LT((project(c.ir, c.ir_lens, p) - project(s.truth.ir, s.truth.ir_lens, p)).norm(), 2.0) << x;
    EXPECT_LT((project(c.rgb, c.rgb_lens, p) - project(s.truth.rgb, s.truth.rgb_lens, p)).norm(), 2.0) << x;
  }
}

TEST(StereoFit, RotationTakesPointsFromIrToRgb) {
  const Session s = half_of_the_session();
  const Eigen::Matrix3d found = fit_stereo(s.ir, s.rgb, s.board, LensModel::radial).calibration.T_rgb_ir.linear();
  const auto apart_deg = [&](const Eigen::Matrix3d& R) {
    return degrees_from_radians(Eigen::AngleAxisd(found * R.transpose()).angle());
  };
  EXPECT_LT(apart_deg(s.truth.T_rgb_ir.linear()), 0.1);
  EXPECT_GT(apart_deg(s.truth.T_rgb_ir.linear().transpose()), 2.5)
      << "3 degrees lie between the rotation and its inverse";
}

TEST(StereoFitLong, RecoversTheTruthWithNoise) {
  const Errors worst = worst_with_noise(session(), LensModel::radial, 4, "radial lenses, fitted as such");
  EXPECT_LT(worst.focal, 0.005);
  EXPECT_LT(worst.translation_mm, 1.0);
  EXPECT_LT(worst.rotation_deg, 0.1);
}

/// A lens that is askew looks nearly like a center that is elsewhere, and that like a camera that is turned: to
/// tell them apart takes more than these corners, and to leave it away errs by as much.
TEST(StereoFitLong, LensesThatAreAskewCostTheRotation) {
  const Session askew = askew_session();
  const Errors full = worst_with_noise(askew, LensModel::full, 2, "lenses askew, fitted as such");
  const Errors radial = worst_with_noise(askew, LensModel::radial, 2, "lenses askew, fitted as radial");
  for (const Errors& worst : {full, radial}) {
    EXPECT_LT(worst.focal, 0.005);
    EXPECT_LT(worst.translation_mm, 1.0);
    EXPECT_LT(worst.rotation_deg, 0.5);
  }
}

TEST(StereoFitLong, LeavesOutWhatDoesNotFit) {
  const Session s = half_of_the_session();
  BoardViews ir = s.ir, rgb = s.rgb;
  ir.views[3].corners[10] += Eigen::Vector2d(25, 0);      // one corner of one picture
  std::swap(rgb.views[7].corners, rgb.views[8].corners);  // the board was moved in between
  const StereoFit fit = fit_stereo(ir, rgb, s.board, LensModel::radial);
  ASSERT_EQ(fit.ir.left_out.size(), 1U);
  EXPECT_EQ(fit.ir.left_out[0].name, "3");
  EXPECT_THAT(fit.ir.left_out[0].reason, HasSubstr("does not fit"));
  std::vector<std::string> pairs;
  for (const LeftOut& pair : fit.left_out) pairs.push_back(pair.name);
  EXPECT_THAT(pairs, testing::UnorderedElementsAre("7", "8"));
  EXPECT_LT(errors_of(fit.calibration, s.truth).rotation_deg, 0.15);
  const nlohmann::json report = report_json(fit, s.board);
  EXPECT_EQ(report.at("stereo").at("left_out").size(), 2U);
  EXPECT_EQ(report.at("stereo").at("pairs").size(), 12U);
  EXPECT_THAT(report_text(fit), HasSubstr("left out, pair 7: does not fit"));
}

TEST(StereoFit, ARowThatRunsTheOtherWayChangesNothing) {
  const Session s = half_of_the_session();
  BoardViews rgb = s.rgb;
  for (size_t i = 0; i < rgb.views.size(); i += 2) std::ranges::reverse(rgb.views[i].corners);
  const StereoFit fit = fit_stereo(s.ir, rgb, s.board, LensModel::radial);
  EXPECT_EQ(fit.pairs.size(), s.T_ir_boards.size());
  EXPECT_LT(errors_of(fit.calibration, s.truth).rotation_deg, 0.1);
}

TEST(StereoFitLong, RefusesWhatTellsTooLittle) {
  const Session s = half_of_the_session();
  const auto first = [](BoardViews views, size_t count) {
    views.views.resize(count);
    return views;
  };
  EXPECT_THAT(refusal(first(s.ir, 4), s.rgb, s.board),
              HasSubstr("IR views: views with a whole chessboard: found 4"));
  EXPECT_THAT(refusal(s.ir, first(s.rgb, 0), s.board),
              HasSubstr("RGB views: views with a whole chessboard: found 0"));
  BoardViews renamed = s.rgb;
  for (BoardView& view : renamed.views) view.name += "_";
  EXPECT_THAT(refusal(s.ir, renamed, s.board), HasSubstr("views of the same name that fit: found 0"));
  BoardViews shifted = s.rgb;  // every picture has the name of the one before
  for (size_t i = 0; i < shifted.views.size(); ++i)
    shifted.views[i].corners = s.rgb.views[(i + 1) % shifted.views.size()].corners;
  EXPECT_THAT(refusal(s.ir, shifted, s.board), HasSubstr("IR and RGB views: "));
  // Boards that all face the camera tell the focal length from nothing.
  BoardViews facing{640, 480, {}, {}};
  for (int i = 0; i < 8; ++i) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() = Eigen::Vector3d(-0.1 + 0.01 * i, -0.06, 0.5 + 0.03 * i);
    facing.views.push_back({std::to_string(i), true_corners(s.truth.ir, {}, T, s.board)});
  }
  EXPECT_THAT(refusal(with_noise(facing, 0.3, 1, "ir"), s.rgb, s.board),
              HasSubstr("IR views: boards tilted by more than 10 degrees: found 0"));
}

TEST(StereoFit, AModelLeavesOtherCoefficientsAtZero) {
  const Session s = half_of_the_session();
  const LensDistortion radial = fit_stereo(s.ir, s.rgb, s.board, LensModel::radial).calibration.ir_lens;
  EXPECT_NE(radial.k1, 0);
  EXPECT_NE(radial.k2, 0);
  EXPECT_NE(radial.k3, 0);
  EXPECT_EQ(radial.p1, 0);
  EXPECT_EQ(radial.p2, 0);
  EXPECT_NE(fit_stereo(s.ir, s.rgb, s.board, LensModel::full).calibration.ir_lens.p1, 0);
  EXPECT_FALSE(fit_stereo(s.ir, s.rgb, s.board, LensModel::none).calibration.has_lens());
  for (const LensModel model : {LensModel::none, LensModel::radial, LensModel::full})
    EXPECT_EQ(from_name<LensModel>(to_string(model)), model);
  EXPECT_FALSE(from_name<LensModel>("fisheye"));
}

}  // namespace
}  // namespace glovebench::calibration
