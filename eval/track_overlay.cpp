#include "eval/track_overlay.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "render/pictures.h"

namespace glovebench::eval {

class PictureSink {
 public:
  virtual ~PictureSink() = default;
  /// Numbers and times must rise.
  /// Throws: Error.
  virtual void add(int number, int64_t timestamp_us, const ColorImage& picture) = 0;
  /// Throws: Error.
  virtual void finish() {}
};

namespace {

namespace fs = std::filesystem;

class PictureFolder : public PictureSink {
 public:
  explicit PictureFolder(const std::string& folder) : folder_(folder) {
    std::error_code error;
    if (fs::exists(folder, error) && !(fs::is_directory(folder, error) && fs::is_empty(folder, error)))
      throw Error(folder, "folder", fs::is_directory(folder, error) ? "files in it" : "a file",
                  "a new or empty one");
    make_folders(folder);
  }
  void add(int number, int64_t, const ColorImage& picture) override {
    render::write_png(fmt::format("{}/{:06}.png", folder_, number), picture);
  }

 private:
  std::string folder_;
};

constexpr int kVideoRate = 30;  // frames/s

[[noreturn]] void fail_ffmpeg(const std::string& found) {
  throw Error("ffmpeg", "program", found, "one that writes MP4 (Debian: ffmpeg), or a folder for the pictures");
}

/// A running ffmpeg that takes raw pictures on its standard input.
class Encoder {
 public:
  Encoder(const std::string& path, int width, int height) {
    const std::string size = fmt::format("{}x{}", width, height), rate = std::to_string(kVideoRate);
    std::vector<std::string> words = {"ffmpeg",   "-y",      "-loglevel", "error",     "-f",         "rawvideo",
                                      "-pix_fmt", "rgb24",   "-s",        size,        "-framerate", rate,
                                      "-i",       "-",       "-c:v",      "libx264",   "-crf",       "20",
                                      "-pix_fmt", "yuv420p", "-movflags", "faststart", path};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    std::array<int, 2> pipe_ends{};
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) fail_ffmpeg(std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[0], STDIN_FILENO);
    // In a group of its own: Ctrl-C ends the session, which then ends the video.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error = posix_spawnp(&process_, "ffmpeg", &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[0]);
    input_ = pipe_ends[1];
    if (error != 0) {
      close(input_);
      fail_ffmpeg(std::strerror(error));
    }
  }
  ~Encoder() { wait(); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  void add(const ColorImage& picture) {
    const auto* bytes = reinterpret_cast<const char*>(picture.data());
    const Written written = write_all(input_, {bytes, picture.size() * sizeof(Rgb)});
    if (written.error != 0) fail_ffmpeg(std::strerror(written.error));
  }
  void finish() {
    const int status = wait();
    if (WIFSIGNALED(status)) fail_ffmpeg(fmt::format("signal {}", WTERMSIG(status)));
    if (WEXITSTATUS(status) != 0) fail_ffmpeg(fmt::format("exit code {}", WEXITSTATUS(status)));
  }

 private:
  /// Ends the input. Returns the wait status; 0 if it has been waited for.
  int wait() {
    if (process_ == 0) return 0;
    close(input_);
    int status = 0;
    while (waitpid(process_, &status, 0) < 0)
      if (errno != EINTR) break;
    process_ = 0;
    return status;
  }

  pid_t process_ = 0;
  int input_ = -1;
};

/// 30 frames/s by the pictures' times: a picture stands until the next is due, one that comes too early is left
/// out.
class Video : public PictureSink {
 public:
  Video(const std::string& path, int width, int height)
      : path_(path), partial_(path.substr(0, path.size() - 4) + ".partial.mp4") {
    const WholeFile probe(path);  // never committed: nothing stays
    encoder_.emplace("file:" + partial_, width, height);
  }
  ~Video() override {
    encoder_.reset();
    std::error_code ignored;
    if (!is_finished_) fs::remove(partial_, ignored);
  }

  void add(int, int64_t timestamp_us, const ColorImage& picture) override {
    if (!last_) first_us_ = timestamp_us;
    repeat_last_until(std::lround(static_cast<double>(timestamp_us - first_us_) * 1e-6 * kVideoRate));
    last_ = picture;
  }
  void finish() override {
    if (!last_) return;
    repeat_last_until(written_ + 1);
    encoder_->finish();
    is_finished_ = true;
    std::error_code error;
    fs::rename(partial_, path_, error);
    if (error) throw Error(path_, "file", error.message(), "room for the video " + partial_);
  }

 private:
  void repeat_last_until(long count) {
    for (; written_ < count; ++written_) encoder_->add(*last_);
  }

  std::string path_, partial_;
  std::optional<Encoder> encoder_;
  std::optional<ColorImage> last_;
  int64_t first_us_ = 0;
  long written_ = 0;
  bool is_finished_ = false;
};

constexpr Rgb kOutline = {255, 255, 255}, kBones = {255, 210, 0};
constexpr double kNearest = 0.05;  // m; nearer joints have no place in the image

/// From each joint to its parent; knuckles and the thumb's base hang on the wrist.
std::vector<render::Stroke> bones_of(const PosedHand& posed, const Eigen::Isometry3d& T_rgb_hand,
                                     const PinholeCamera& camera) {
  std::vector<render::Stroke> bones;
  for (int joint = 0; joint < kJointCount; ++joint) {
    if (joint == kWristJoint || joint == kForearmJoint) continue;
    const int parent = std::max(joint_parents()[joint], kWristJoint);
    const Eigen::Vector3d from = T_rgb_hand * posed.T_hand_joint[parent].translation();
    const Eigen::Vector3d to = T_rgb_hand * posed.T_hand_joint[joint].translation();
    if (std::min(from.z(), to.z()) > kNearest) bones.push_back({camera.project(from), camera.project(to)});
  }
  return bones;
}

/// Size in px.
std::unique_ptr<PictureSink> open_picture_sink(const std::string& path, int width, int height) {
  const std::string ending = fs::path(path).extension();
  if (ending == ".mp4") return std::make_unique<Video>(path, width, height);
  if (!ending.empty() && !fs::is_directory(path)) throw Error(path, "ending", ending, ".mp4, or none for a folder");
  return std::make_unique<PictureFolder>(path);
}

}  // namespace

TrackOverlay::TrackOverlay(const std::string& path, std::shared_ptr<const HandModel> hand,
                           const RgbdCalibration& calibration)
    : sink_(open_picture_sink(path, calibration.rgb.width, calibration.rgb.height)),
      hand_(std::move(hand)),
      calibration_(calibration) {}
TrackOverlay::~TrackOverlay() = default;

void TrackOverlay::finish() { sink_->finish(); }

void TrackOverlay::add(int number, const DeviceFrame& frame, const TrackResult& result) {
  const std::string caption = fmt::format("frame {}  {}", number, to_string(result.status));
  sink_->add(number, frame.depth_timestamp_us, render::overlay_text(picture(frame, result), caption));
}

ColorImage TrackOverlay::picture(const DeviceFrame& frame, const TrackResult& result) {
  if (result.status != TrackStatus::tracked) return frame.color;
  const PosedHand posed = hand_->pose(result.posture);
  const Eigen::Isometry3d T_rgb_hand = calibration_.T_rgb_ir * result.T_camera_hand;
  LabelImage silhouette = renderer_.render_labels(*hand_, posed, calibration_.rgb, T_rgb_hand);
  for (uint8_t& label : silhouette) label = label != 0;
  return render::overlay_strokes(render::overlay_outline(frame.color, silhouette, kOutline),
                                 bones_of(posed, T_rgb_hand, calibration_.rgb), kBones);
}

}  // namespace glovebench::eval
