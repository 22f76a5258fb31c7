#pragma once

// Fingertips from Shadow's dimensions, independent of the library.

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace glovebench {

class TestFingertips {
 public:
  using Tips = Eigen::Matrix<double, 3, 5>;

  /// Hand frame, m. `q`: by ShadowJoint, rad.
  explicit TestFingertips(const std::array<double, 24>& q) : q_(q) {
    const Tips palm = in_palm();
    tips_.row(0) = (0.0055 - palm.row(0).array()).matrix();
    tips_.row(1) = palm.row(1);
    tips_.row(2) = (0.0495 - palm.row(2).array()).matrix();
  }
  const Tips& in_hand() const { return tips_; }
  /// In the frame of WRJ2, fixed to the forearm.
  Tips in_forearm() const {
    const Tips palm = in_palm();
    const double bend = q_[22], side = q_[23];
    Tips tips;
    for (int f = 0; f < 5; ++f) {
      const Eigen::Vector3d bent = about_x(bend, palm.col(f)) + Eigen::Vector3d(0, 0, 0.034);
      tips.col(f) = about_y(side, bent);
    }
    return tips;
  }

 private:
  static Eigen::Vector3d about_x(double a, const Eigen::Vector3d& p) {
    return {p.x(), p.y() * std::cos(a) - p.z() * std::sin(a), p.y() * std::sin(a) + p.z() * std::cos(a)};
  }
  static Eigen::Vector3d about_y(double a, const Eigen::Vector3d& p) {
    return {p.x() * std::cos(a) + p.z() * std::sin(a), p.y(), p.z() * std::cos(a) - p.x() * std::sin(a)};
  }
  static Eigen::Vector3d about_z(double a, const Eigen::Vector3d& p) {
    return {p.x() * std::cos(a) - p.y() * std::sin(a), p.x() * std::sin(a) + p.y() * std::cos(a), p.z()};
  }
  /// From the finger's knuckle. `first`: its J1.
  Eigen::Vector3d finger(int first, double spread) const {
    const double a = q_[first + 2], b = a + q_[first + 1], c = b + q_[first];
    const Eigen::Vector3d bent(0, -0.045 * std::sin(a) - 0.025 * std::sin(b) - 0.026 * std::sin(c),
                               0.045 * std::cos(a) + 0.025 * std::cos(b) + 0.026 * std::cos(c));
    return about_y(spread, bent);
  }
  Eigen::Vector3d thumb() const {
    Eigen::Vector3d p = about_y(-q_[17], {0, 0, 0.0275}) + Eigen::Vector3d(0, 0, 0.032);
    p = about_x(q_[19], about_y(-q_[18], p)) + Eigen::Vector3d(0, 0, 0.038);
    p = about_z(-q_[21], about_x(q_[20], p));
    return about_y(std::atan(1.0), p) + Eigen::Vector3d(0.034, -0.0085, 0.029);
  }
  Tips in_palm() const {
    Tips palm;
    palm.col(0) = thumb();
    palm.col(1) = Eigen::Vector3d(0.033, 0, 0.095) + finger(0, -q_[3]);
    palm.col(2) = Eigen::Vector3d(0.011, 0, 0.099) + finger(4, -q_[7]);
    palm.col(3) = Eigen::Vector3d(-0.011, 0, 0.095) + finger(8, q_[11]);
    // The fold's axis is 35 degrees off the fingers.
    const double tilt = 35 * std::atan(1.0) / 45;
    const Eigen::Vector3d little = Eigen::Vector3d(0, 0, 0.06579) + finger(12, q_[15]);
    palm.col(4) = Eigen::Vector3d(-0.033, 0, 0.02071) + about_y(tilt, about_z(q_[16], about_y(-tilt, little)));
    return palm;
  }

  std::array<double, 24> q_;
  Tips tips_;
};

}  // namespace glovebench
