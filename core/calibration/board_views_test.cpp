// Pictures of boards from folders and recordings.
#include "core/calibration/board_views.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "core/base/whole_file.h"
#include "core/calibration/test_board.h"
#include "core/kinect/recording_files.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench::calibration {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr Chessboard kBoard = {7, 4, 0.03};

class BoardViewsTest : public testing::Test {
 protected:
  void SetUp() override {
    const RgbdCalibration truth = kinect_with_lenses();
    RandomStream noise(1, "board views", 0, "picture");
    const Eigen::Isometry3d T_ir_board = poses_before(truth, kBoard, 1, 1).front();
    corners_ = true_corners(truth.ir, truth.ir_lens, T_ir_board, kBoard);
    picture_ = BoardCamera(truth.ir, truth.ir_lens).picture(T_ir_board, kBoard, noise);
  }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  static std::string pgm(const Image<uint8_t>& gray) {
    std::string content = "P5 " + std::to_string(gray.width()) + " " + std::to_string(gray.height()) + " 255\n";
    content.append(gray.begin(), gray.end());
    return content;
  }
  std::string refusal(const std::string& source) const {
    return thrown_by([&] { find_boards(source, kBoard, 10); });
  }

  const std::string folder_ = test_folder();
  Corners corners_;
  Image<uint8_t> picture_;
};

TEST_F(BoardViewsTest, OfAFolderAreNamedByItsFiles) {
  write_file(path("b.pgm"), pgm(picture_));
  write_file(path("a.PGM"), pgm(picture_));
  write_file(path("notes.txt"), "not a picture");
  write_file(path("black.pgm"), pgm(Image<uint8_t>(640, 480)));
  write_file(path("cut.pgm"), pgm(picture_).substr(0, 20));
  write_file(path("empty.png"), "");
  const BoardViews views = find_boards(folder_, kBoard, 10);
  EXPECT_EQ(views.width_px, 640);
  EXPECT_EQ(views.height_px, 480);
  ASSERT_EQ(views.views.size(), 2U);
  EXPECT_EQ(views.views[0].name, "a");
  EXPECT_EQ(views.views[1].name, "b");
  const Corners found = in_the_order_of(corners_, views.views[0].corners, kBoard);
  ASSERT_EQ(found.size(), corners_.size());
  for (size_t i = 0; i < found.size(); ++i) EXPECT_LT((found[i] - corners_[i]).norm(), 0.3) << i;
  ASSERT_EQ(views.left_out.size(), 3U);
  EXPECT_EQ(views.left_out[0].name, "black");
  EXPECT_THAT(views.left_out[0].reason, HasSubstr("7x4"));
  EXPECT_THAT(views.left_out[2].reason, HasSubstr("empty.png: content: found no image"));
}

TEST_F(BoardViewsTest, SixteenBitsAreStretched) {
  std::string content = "P5 640 480 65535\n";
  for (const uint8_t gray : picture_) {  // a sensor of ten bits that is dark; big-endian, as the format says
    const int dim = gray * 2;
    content.push_back(static_cast<char>(dim >> 8));
    content.push_back(static_cast<char>(dim & 255));
  }
  write_file(path("dim.pgm"), content);
  EXPECT_EQ(find_boards(folder_, kBoard, 10).views.size(), 1U);
}

TEST_F(BoardViewsTest, OfARecordingAreNumbered) {
  ColorImage color(640, 480);
  for (size_t i = 0; i < color.size(); ++i) color[i] = {picture_[i], picture_[i], picture_[i]};
  std::string index;
  for (const int64_t time_us : {100'000, 200'000, 300'000, 400'000}) {
    const std::string name = recorded_name({RecordedKind::color, time_us});
    write_file(path(name), time_us == 300'000 ? std::string("damaged") : encode_ppm(color));
    index += name + "\n";
  }
  write_file(path("INDEX.txt"), index);
  const BoardViews all = find_boards("fakenect:" + folder_, kBoard, 10);
  ASSERT_EQ(all.views.size(), 3U);
  EXPECT_EQ(all.views[2].name, "3");
  ASSERT_EQ(all.left_out.size(), 1U);
  EXPECT_EQ(all.left_out[0].name, "2");
  EXPECT_EQ(find_boards("fakenect:" + folder_, kBoard, 2).views.size(), 1U) << "numbers 0 and 2";
}

TEST_F(BoardViewsTest, RefusesWhatIsNoSource) {
  EXPECT_THAT(refusal(path("none")), HasSubstr("none: folder: found"));
  EXPECT_THAT(refusal(folder_), HasSubstr("pictures: found none"));
  EXPECT_THAT(refusal("fakenect:" + folder_), HasSubstr("INDEX.txt"));
  write_file(path("a.pgm"), pgm(picture_));
  write_file(path("b.pgm"), pgm(Image<uint8_t>(320, 240)));
  EXPECT_THAT(refusal(folder_), HasSubstr("b.pgm: size: found 320x240, expected 640x480"));
  fs::remove(path("b.pgm"));
  write_file(path("a.png"), pgm(picture_));
  EXPECT_THAT(refusal(folder_), HasSubstr("two of the name a"));
}

TEST(Chessboard, IsCheckedFieldByField) {
  const auto refusal = [](const Chessboard& board) { return thrown_by([&] { check_chessboard(board, "here"); }); };
  EXPECT_EQ(refusal({9, 6, 0.025}), "");
  EXPECT_THAT(refusal({2, 6, 0.025}), HasSubstr("here: columns: found 2"));
  EXPECT_THAT(refusal({9, 101, 0.025}), HasSubstr("rows"));
  EXPECT_THAT(refusal({6, 6, 0.025}), HasSubstr("columns and rows: found 6 each"));
  for (const double square : {0.0, -1.0, 25.0, std::nan("")})
    EXPECT_THAT(refusal({9, 6, square}), HasSubstr("square")) << square;
}

TEST(Chessboard, RowsThatRunTheOtherWayAreTurned) {
  const Corners rows = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  const Corners turned(rows.rbegin(), rows.rend());
  const Chessboard board = {3, 2, 1};
  EXPECT_EQ(in_the_order_of(rows, turned, board), rows);
  EXPECT_EQ(in_the_order_of(rows, rows, board), rows);
}

}  // namespace
}  // namespace glovebench::calibration
