#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pose/articulated_step.h"

namespace glovebench {

/// Bodies that move a face, with shares at each corner.
struct FaceBodies {
  static constexpr int kMost = 8;
  int count = 0;
  std::array<uint8_t, kMost> body{};
  std::array<std::array<float, kMost>, 3> share{};
};
std::vector<FaceBodies> face_bodies(const HandModel& model, std::span<const BodyShares> shares);

/// Products of rows, summed up by the bodies that move them.
struct BodySums {
  static constexpr int kPairs = kBodyCount * (kBodyCount + 1) / 2;
  static constexpr size_t kProducts = 24, kRow = 8;  ///< upper triangle by rows: 21, a row: 6, and zeros

  alignas(64) std::array<std::array<double, kProducts>, kPairs> products;  ///< uninitialized unless is_used
  alignas(64) std::array<std::array<double, kRow>, kBodyCount> rows{};
  std::array<bool, kPairs> is_used{};

  static int pair_of(int low, int high) { return high * (high + 1) / 2 + low; }
  std::array<double, kProducts>& of_pair(int low, int high) {
    const int pair = pair_of(low, high);
    if (!is_used[pair]) products[pair].fill(0);
    is_used[pair] = true;
    return products[pair];
  }
};

/// Equals PlainPullSums up to rounding, faster. All instruction sets give the same bits.
class PullSums {
 public:
  explicit PullSums(const std::array<Screw, kAngleCount>& screws);
  /// `shares`: the point's.
  void add(const Pull& pull, const BodyShares& shares);
  /// `faces`: of all triangles.
  void add(const MatchedPoints& matched, std::span<const FaceBodies> faces, const PullWeights& weights);
  NormalEquations equations() const;

 private:
  std::array<Vector6d, kAngleCount> screws_;
  BodySums sums_;
};

}  // namespace glovebench
