#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/hand/hand_model.h"
#include "render/glove_colors.h"
#include "render/subjects/capsule_hand.h"

namespace glovebench::render {

/// Subjects are numbered from 1: the tracker's hand, the tracker's mesh in another shape, then capsule hands.
inline constexpr int kFirstCapsuleSubject = 3;
inline constexpr int kSubjectCount = 22;

/// A hand in front of the camera, of either construction. Copies share it.
class Subject {
 public:
  // Not explicit: every tracker's hand can be a subject.
  Subject(std::shared_ptr<const HandModel> model) : hand_(std::move(model)) {}
  Subject(std::shared_ptr<const CapsuleHand> hand) : hand_(std::move(hand)) {}

  const std::vector<Triangle>& triangles() const;
  PosedHand pose(const Posture& posture) const;
  /// The truth of its joints.
  JointPoses joints(const Posture& posture) const;
  const std::string& hash() const;

 private:
  std::variant<std::shared_ptr<const HandModel>, std::shared_ptr<const CapsuleHand>> hand_;
};

/// Makes a subject. `tracker_hand` is subject 1; subjects from 3 on take its side, and the thumb's zero. Throws
/// Error if there is no such subject.
Subject make_subject(int number, const std::string& mesh_path, std::shared_ptr<const HandModel> tracker_hand);

/// How the glove of a subject reflects light.
Shader shader_of(int subject);

}  // namespace glovebench::render
