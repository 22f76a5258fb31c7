#include <fmt/format.h>

#include "core/base/registry.h"
#include "trajectories/generation/families/movement_family.h"

namespace glovebench::trajectories {
namespace {

constexpr std::array<Range, 2> kAnyBend = {{{0, 1}, {0, 1}}};

constexpr MovementFamily kAbove = {.name = "above",
                                   .description = "the paper's: the hand opens and grasps, seen from above",
                                   .tilt_deg = {0, 25},
                                   .depth = {0.60, 0.80},
                                   .off_axis = 0.35,
                                   .tilt_axis_deg = {0, 360},
                                   .yaw_deg = 40,
                                   .speed = {0.10, 0.40},
                                   .turn_rate = {0.5, 2.0},
                                   .bends = {{{0, 0.25}, {0.55, 1}}},
                                   .wrist = 0.35,
                                   .posture_s = {0.3, 0.7}};

/// A family that differs from `above` in how the hand is held and that takes any posture.
constexpr MovementFamily family_held(std::string_view name, std::string_view description, Range tilt_deg,
                                     Range tilt_axis_deg, double yaw_deg) {
  MovementFamily family = kAbove;
  family.name = name;
  family.description = description;
  family.tilt_deg = tilt_deg;
  family.tilt_axis_deg = tilt_axis_deg;
  family.yaw_deg = yaw_deg;
  family.bends = kAnyBend;
  family.posture_s = {0.4, 1.0};
  return family;
}

constexpr MovementFamily any_family() {
  MovementFamily family = family_held("any", "any orientation", {0, 180}, {0, 360}, 180);
  family.turn_rate = {1, 4};
  return family;
}

constexpr MovementFamily fast_family() {
  MovementFamily family = family_held("fast", "the hand moves and turns fast", {0, 35}, {0, 360}, 60);
  family.off_axis = 0.5;
  family.speed = {1, 2};
  family.turn_rate = {5, 10};
  return family;
}

constexpr MovementFamily border_family() {
  MovementFamily family = family_held("border", "near the image's borders, in and out of them and of the volume",
                                      {0, 25}, {0, 360}, 60);
  family.depth = {0.35, 1.00};
  family.off_axis = 1.1;
  family.speed = {0.3, 1.0};
  return family;
}

constexpr MovementFamily fingers_family() {
  MovementFamily family =
      family_held("fingers", "fingers play freely on a hand that hardly moves", {0, 25}, {0, 360}, 40);
  family.off_axis = 0.1;
  family.speed = {0.02, 0.10};
  family.turn_rate = {0.1, 0.5};
  family.posture_s = {0.2, 0.5};
  return family;
}

constexpr MovementFamily hidden_family() {
  MovementFamily family =
      family_held("hidden", "seen along bent fingers, which hide each other", {55, 90}, {-20, 20}, 40);
  family.bends = {{{0.3, 1}, {0.3, 1}}};
  return family;
}

constexpr MovementFamily wrist_family() {
  MovementFamily family =
      family_held("wrist", "the wrist bends and swings as far as it can", {0, 35}, {0, 360}, 40);
  family.wrist = 0.95;
  return family;
}

constexpr MovementFamily captured_family() {
  MovementFamily family =
      family_held("captured", "postures that headsets captured of people", {0, 35}, {0, 360}, 40);
  family.captured = true;
  return family;
}

constexpr std::array kMovementFamilies = {
    kAbove,
    family_held("tilted", "the back of the hand tilted by 45 degrees", {35, 55}, {0, 360}, 60),
    family_held("side", "the edge of the hand to the camera", {75, 105}, {70, 110}, 60),
    family_held("palm", "the palm to the camera", {150, 180}, {70, 110}, 60),
    any_family(),
    fast_family(),
    border_family(),
    fingers_family(),
    hidden_family(),
    wrist_family(),
    captured_family(),
};

std::string range_text(const Range& range, int digits) {
  return fmt::format("{:.{}f}-{:.{}f}", range.low, digits, range.high, digits);
}

std::string bends_text(const MovementFamily& family) {
  if (family.captured) return "as captured";
  const auto& [first, second] = family.bends;
  const std::string once = fmt::format("{:.0f}-{:.0f}", 100 * first.low, 100 * first.high);
  if (first.high == second.high) return once;
  return fmt::format("{}, {:.0f}-{:.0f}", once, 100 * second.low, 100 * second.high);
}

}  // namespace

std::span<const MovementFamily> movement_families() { return kMovementFamilies; }

std::vector<std::string> movement_family_names() { return names_in(movement_families()); }

const MovementFamily& find_movement_family(std::string_view name) {
  return find_in(movement_families(), name, "movements", "family");
}

std::string movement_families_text() {
  std::string text;
  for (const MovementFamily& family : kMovementFamilies)
    text += fmt::format("{:<9} {}\n", family.name, family.description);
  const auto add = [&text](const auto&... cells) {
    text += fmt::format("{:<10}{:<8}{:<10}{:<8}{:<10}{:<9}{:<13}{}\n", cells...);
  };
  text += "\n";
  add("Ranges", "tilt,", "depth,", "off", "peaks,", "peaks,", "fingers,", "wrist,");
  add("", "deg", "m", "axis, %", "m/s", "rad/s", "% bent", "%");
  for (const MovementFamily& family : kMovementFamilies) {
    add(family.name, range_text(family.tilt_deg, 0), range_text(family.depth, 2),
        fmt::format("0-{:.0f}", 100 * family.off_axis), range_text(family.speed, 2),
        range_text(family.turn_rate, 1), bends_text(family),
        family.captured ? "as captured" : fmt::format("0-{:.0f}", 100 * family.wrist));
  }
  return text + fmt::format(
                    "\nRandom postures: DIP {} to {} of PIP; flexions of neighboring fingers drawn\n"
                    "with a correlation of {}; fingers at least {} deg RMS from each gesture; no\n"
                    "parts that overlap by more than {:.0f} mm.\n",
                    kDipShare.low, kDipShare.high, kNeighborCorrelation, kGestureDistanceDeg, 1000 * kMostOverlap);
}

}  // namespace glovebench::trajectories
