#include "core/calibration/board_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/input_file.h"
#include "core/kinect/recording_files.h"

namespace glovebench::calibration {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRecording = "fakenect:";
constexpr uint64_t kLargestFile = uint64_t{16} << 20;

struct Picture {
  std::string name, path;
};

bool is_image(const fs::path& path) {
  static constexpr std::array<std::string_view, 6> endings = {".png", ".jpg", ".jpeg", ".pgm", ".ppm", ".pnm"};
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

std::vector<Picture> pictures_in_folder(const std::string& folder) {
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  if (error) throw Error(folder, "folder", error.message(), "a folder of pictures, or fakenect:FOLDER");
  std::vector<Picture> pictures;
  for (const fs::directory_entry& entry : entries)
    if (is_image(entry.path())) pictures.push_back({entry.path().stem().string(), entry.path().string()});
  std::sort(pictures.begin(), pictures.end(), [](const Picture& a, const Picture& b) { return a.path < b.path; });
  for (size_t i = 1; i < pictures.size(); ++i)
    if (pictures[i].name == pictures[i - 1].name)
      throw Error(folder, "pictures", fmt::format("two of the name {}", pictures[i].name), "one of each name");
  return pictures;
}

/// At most `most` color images, evenly spaced.
std::vector<Picture> pictures_of_recording(const std::string& folder, size_t most,
                                           std::vector<std::string>& changed) {
  const FileSet::Found index = FileSet(folder).find(kRecordingIndex, kLargestIndex);
  if (index.is_changed) changed.emplace_back(kRecordingIndex);
  std::vector<RecordingEntry> colors = parse_recording_index(index.content, folder);
  std::erase_if(colors, [](const RecordingEntry& entry) { return entry.kind != RecordedKind::color; });
  std::vector<Picture> pictures;
  const size_t count = std::min(most, colors.size());
  for (size_t i = 0; i < count; ++i) {
    const size_t number = i * colors.size() / count;
    pictures.push_back({fmt::format("{}", number), path_in_recording(folder, colors[number].name)});
  }
  return pictures;
}

/// Throws Error if it is no image.
Image<uint8_t> read_gray(const std::string& path) {
  return decode_gray(read_regular_file(path, kLargestFile), path);
}

/// The first readable picture sets the size of all.
void require_size(BoardViews& views, const Image<uint8_t>& gray, const std::string& path) {
  if (views.width_px == 0) {
    views.width_px = gray.width();
    views.height_px = gray.height();
  }
  if (gray.width() != views.width_px || gray.height() != views.height_px)
    throw Error(path, "size", fmt::format("{}x{}", gray.width(), gray.height()),
                fmt::format("{}x{} like the pictures before it", views.width_px, views.height_px));
}

constexpr int kFewest = 3, kMost = 100;
constexpr double kLargestSquare = 1.0;  // m: what is larger was meant in millimeters

/// Half the window in which a corner is refined: under half a square, so that it holds no other corner.
int window_of(const std::vector<cv::Point2f>& corners) {
  float nearest = INFINITY;
  for (size_t i = 1; i < corners.size(); ++i)
    nearest = std::min(nearest, static_cast<float>(cv::norm(corners[i] - corners[i - 1])));
  return std::clamp(static_cast<int>(0.4f * nearest), 2, 11);
}

Eigen::Vector2d along_first_row(const Corners& corners, const Chessboard& board) {
  return corners[board.columns - 1] - corners[0];
}

}  // namespace

BoardViews find_boards(const std::string& source, const Chessboard& board, size_t most, const Looked& looked) {
  const bool is_recording = source.starts_with(kRecording);
  BoardViews views;
  const std::vector<Picture> pictures =
      is_recording ? pictures_of_recording(source.substr(kRecording.size()), most, views.changed)
                   : pictures_in_folder(source);
  if (pictures.empty()) throw Error(source, "pictures", "none", "pictures of a chessboard");
  for (size_t i = 0; i < pictures.size(); ++i) {
    const Picture& picture = pictures[i];
    if (looked) looked(i, pictures.size());
    Image<uint8_t> gray;
    try {
      gray = read_gray(picture.path);
    } catch (const Error& e) {
      views.left_out.push_back({picture.name, e.what()});
      continue;
    }
    require_size(views, gray, picture.path);
    if (auto corners = find_corners(gray, board)) {
      views.views.push_back({picture.name, std::move(*corners)});
    } else {
      views.left_out.push_back(
          {picture.name, fmt::format("no whole chessboard of {}x{} inner corners", board.columns, board.rows)});
    }
  }
  return views;
}

void check_chessboard(const Chessboard& board, const std::string& where) {
  const auto check_count = [&](const char* field, int count) {
    if (count < kFewest || count > kMost)
      throw Error(where, field, fmt::format("{}", count), fmt::format("{} to {} inner corners", kFewest, kMost));
  };
  check_count("columns", board.columns);
  check_count("rows", board.rows);
  if (board.columns == board.rows)
    throw Error(where, "columns and rows", fmt::format("{} each", board.rows),
                "different numbers: else rows and columns cannot be told apart");
  if (!(board.square > 0 && board.square <= kLargestSquare))
    throw Error(where, "square", fmt::format("{} m", board.square),
                fmt::format("above 0, at most {} m", kLargestSquare));
}

std::vector<Eigen::Vector3d> corners_on(const Chessboard& board) {
  std::vector<Eigen::Vector3d> corners;
  for (int row = 0; row < board.rows; ++row)
    for (int column = 0; column < board.columns; ++column)
      corners.emplace_back(column * board.square, row * board.square, 0);
  return corners;
}

std::optional<Corners> find_corners(const Image<uint8_t>& gray, const Chessboard& board) {
  const cv::Mat image(gray.height(), gray.width(), CV_8UC1, const_cast<uint8_t*>(gray.data()));
  std::vector<cv::Point2f> found;
  const cv::Size size(board.columns, board.rows);
  if (!cv::findChessboardCorners(image, size, found, cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    return std::nullopt;
  const int window = window_of(found);
  cv::cornerSubPix(image, found, cv::Size(window, window), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-3));
  Corners corners;
  for (const cv::Point2f& corner : found) corners.emplace_back(corner.x, corner.y);
  return corners;
}

Corners in_the_order_of(const Corners& reference, Corners corners, const Chessboard& board) {
  if (along_first_row(reference, board).dot(along_first_row(corners, board)) < 0)
    std::reverse(corners.begin(), corners.end());
  return corners;
}

}  // namespace glovebench::calibration
