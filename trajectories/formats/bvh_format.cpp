#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/text.h"
#include "trajectories/capture/marker_places.h"
#include "trajectories/formats/format.h"
#include "trajectories/text_cells.h"

namespace glovebench::trajectories {
namespace {

constexpr size_t kMostNodes = 1000;
constexpr double kMostOffset = 1e6;  ///< of any unit

/// The words of the file, one after the other.
class Words {
 public:
  Words(std::string_view text, const std::string& where) : rest_(text), where_(where) {}

  /// Empty at the end of the file.
  std::string_view next() {
    constexpr std::string_view kSpaces = " \t\r\n";
    const size_t begin = std::min(rest_.find_first_not_of(kSpaces), rest_.size());
    line_ += static_cast<size_t>(std::ranges::count(rest_.substr(0, begin), '\n'));
    rest_.remove_prefix(begin);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kSpaces));
    rest_.remove_prefix(word.size());
    return word;
  }
  void expect(std::string_view expected) {
    if (const std::string_view word = next(); word != expected) fail(word, quoted_excerpt(expected));
  }
  double number(double min, double max) {
    const std::string_view word = next();
    if (word.empty()) fail(word, "a number");
    return number_from(word, min, max, where_, line());
  }
  size_t count(size_t max) {
    const std::string_view word = next();
    const std::optional<double> number = number_in<double>(word);
    if (!number || *number != std::floor(*number) || !(*number >= 0 && *number <= static_cast<double>(max)))
      fail(word, fmt::format("a whole number from 0 to {}", max));
    return static_cast<size_t>(*number);
  }
  [[noreturn]] void fail(std::string_view found, const std::string& expected) const {
    throw Error(where_, line(), found.empty() ? "the end of the file" : quoted_excerpt(found), expected);
  }

 private:
  std::string line() const { return fmt::format("line {}", line_); }

  std::string_view rest_;
  const std::string& where_;
  size_t line_ = 1;
};

/// What one number of a frame moves: the place along an axis of the parent, or a turn about an axis of its own.
struct Channel {
  int axis;
  bool is_turn;
};

/// A joint, or the end of the last bone.
struct Node {
  std::string name;  ///< empty of an end
  int parent;        ///< -1 of the root
  Eigen::Vector3d offset;
  std::vector<Channel> channels;
};

Channel read_channel(Words& words) {
  const std::string_view word = words.next();
  std::string name(word);
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 6> kNames = {"xposition", "yposition", "zposition",
                                                      "xrotation", "yrotation", "zrotation"};
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) words.fail(word, "Xposition, Yposition, Zposition, Xrotation, Yrotation or Zrotation");
  const auto index = static_cast<int>(found - kNames.begin());
  return {index % 3, index >= 3};
}

Eigen::Vector3d read_offset(Words& words) {
  words.expect("OFFSET");
  Eigen::Vector3d offset;
  for (double& value : offset) value = words.number(-kMostOffset, kMostOffset);
  return offset;
}

/// The nodes of all roots, parents before children; reads on to the movement.
std::vector<Node> read_hierarchy(Words& words) {
  words.expect("HIERARCHY");
  std::vector<Node> nodes;
  std::vector<int> open;  // nodes whose braces are open
  const auto add = [&](std::string_view name) {
    if (nodes.size() == kMostNodes) words.fail(name, fmt::format("{} joints at most", kMostNodes));
    words.expect("{");
    Node node = {std::string(name), open.empty() ? -1 : open.back(), read_offset(words), {}};
    if (!name.empty()) {
      words.expect("CHANNELS");
      node.channels.resize(words.count(6));
      for (Channel& channel : node.channels) channel = read_channel(words);
    }
    open.push_back(static_cast<int>(nodes.size()));
    nodes.push_back(std::move(node));
  };
  while (true) {
    const std::string_view word = words.next();
    if (open.empty()) {
      if (word == "MOTION" && !nodes.empty()) return nodes;
      if (word != "ROOT") words.fail(word, nodes.empty() ? "ROOT" : "ROOT or MOTION");
      add(words.next());
    } else if (word == "}") {
      open.pop_back();
    } else if (word == "JOINT") {
      add(words.next());
    } else if (word == "End") {
      words.expect("Site");
      add("");
    } else {
      words.fail(word, "JOINT, End Site or }");
    }
  }
}

/// The WebXR joint of a joint's name: "RightHand" is the wrist, "RightHandIndex1" the index finger's MCP joint.
/// Names may have a prefix that ends in a colon. -1 of any other.
int webxr_joint(std::string_view name, Side side) {
  name.remove_prefix(name.find(':') == std::string_view::npos ? 0 : name.find(':') + 1);
  const std::string_view hand = side == Side::right ? "RightHand" : "LeftHand";
  if (!name.starts_with(hand)) return -1;
  name.remove_prefix(hand.size());
  if (name.empty()) return kWristJoint;
  constexpr std::array<std::string_view, 5> kFingers = {"Thumb", "Index", "Middle", "Ring", "Pinky"};
  for (size_t f = 0; f < kFingers.size(); ++f) {
    if (!name.starts_with(kFingers[f])) continue;
    const std::string_view number = name.substr(kFingers[f].size());
    if (number.size() != 1 || number[0] < '1' || number[0] > '4') return -1;
    return fingertip_joints()[f] - 4 + (number[0] - '0');
  }
  return -1;
}

/// The WebXR joint of each node, or -1. An end is the tip of the finger whose last joint is its parent.
std::vector<int> webxr_joints(const std::vector<Node>& nodes, Side side, const std::string& where) {
  std::vector<int> joints;
  for (const Node& node : nodes) {
    int joint = node.name.empty() ? joints[static_cast<size_t>(node.parent)] : webxr_joint(node.name, side);
    if (node.name.empty()) joint = std::ranges::count(fingertip_joints(), joint + 1) > 0 ? joint + 1 : -1;
    if (joint >= 0 && std::ranges::count(joints, joint) > 0)
      throw Error(where, "joints", quoted_excerpt(node.name) + " again", "each joint of the hand once");
    joints.push_back(joint);
  }
  for (const char* needed : {"Hand", "HandIndex1", "HandMiddle1", "HandPinky1"}) {
    const std::string name = (side == Side::right ? "Right" : "Left") + std::string(needed);
    if (std::ranges::count(joints, webxr_joint(name, side)) == 0)
      throw Error(where, "joints", "none named " + name, "those of a hand (trajectories/README.md)");
  }
  return joints;
}

/// Where the nodes are, in the unit of the file.
std::vector<Eigen::Vector3d> bvh_points(const std::vector<Node>& nodes, Words& words) {
  std::vector<Eigen::Isometry3d> poses;
  std::vector<Eigen::Vector3d> points;
  poses.reserve(nodes.size());
  for (const Node& node : nodes) {
    Eigen::Isometry3d pose =
        node.parent < 0 ? Eigen::Isometry3d::Identity() : poses[static_cast<size_t>(node.parent)];
    Eigen::Vector3d place = node.offset;
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    for (const Channel& channel : node.channels) {
      const double value = words.number(-kMostOffset, kMostOffset);
      if (channel.is_turn)
        turn *=
            Eigen::AngleAxisd(radians_from_degrees(value), Eigen::Vector3d::Unit(channel.axis)).toRotationMatrix();
      else
        place[channel.axis] = value;
    }
    pose.translate(place).rotate(turn);
    poses.push_back(pose);
    points.push_back(pose.translation());
  }
  return points;
}

/// Metres of the file's unit, which it does not say: from the wrist to a knuckle are 5 to 15 cm.
double unit_of(double knuckle_distance, const std::string& where) {
  for (const double unit : {1.0, 0.01, 0.001})
    if (knuckle_distance * unit >= 0.05 && knuckle_distance * unit < 0.15) return unit;
  throw Error(where, "distance from the wrist to the middle finger", fmt::format("{}", knuckle_distance),
              "5 to 15 cm, in m, cm or mm");
}

/// A skeleton and its joint angles over time. Of one hand the joint positions are taken, so that neither the axes
/// nor the rest pose of the file matter. The names are those of HumanIK skeletons (MotionBuilder, Perception
/// Neuron, Mixamo): RightHand, RightHandIndex1 to RightHandIndex3, the end site or RightHandIndex4 for the tip.
/// Position channels replace the offset.
MarkerSequence parse_bvh(std::string_view text, Side side, const std::string& where) {
  Words words(text, where);
  const std::vector<Node> nodes = read_hierarchy(words);
  const std::vector<int> joints = webxr_joints(nodes, side, where);
  words.expect("Frames:");
  const size_t count = words.count(kMaxMarkerFrames);
  words.expect("Frame");
  words.expect("Time:");
  const double frame_s = words.number(1e-5, 1e3);
  if (count == 0) throw Error(where, "Frames", "0", "at least one");
  MarkerSequence sequence = sequence_of_joints();
  double unit = 0;
  for (size_t f = 0; f < count; ++f) {
    const std::vector<Eigen::Vector3d> points = bvh_points(nodes, words);
    MarkerFrame frame = {std::llround(1e6 * frame_s * static_cast<double>(f)),
                         std::vector<Eigen::Vector3d>(kWebxrJointCount, gap())};
    for (size_t n = 0; n < nodes.size(); ++n)
      if (joints[n] >= 0) frame.points[static_cast<size_t>(joints[n])] = points[n];
    if (f == 0) unit = unit_of((frame.points[11] - frame.points[kWristJoint]).norm(), where);
    for (Eigen::Vector3d& point : frame.points) {
      point *= unit;
      if (is_seen(point) && point.cwiseAbs().maxCoeff() > kMaxCoordinate)
        throw Error(where, fmt::format("frame {}", f), fmt::format("a joint {:.0f} m away", point.norm()),
                    fmt::format("coordinates of {} m at most", kMaxCoordinate));
    }
    add_frame(std::move(frame), 0, text.size(), sequence, where, fmt::format("frame {}", f));
  }
  if (const std::string_view word = words.next(); !word.empty())
    words.fail(word, fmt::format("the end of the file after {} frames", count));
  return sequence;
}

}  // namespace

Format bvh_format() {
  return {.name = "bvh",
          .ending = ".bvh",
          .description = "skeletons of motion capture, joints named as HumanIK does",
          .markers = parse_bvh};
}

}  // namespace glovebench::trajectories
