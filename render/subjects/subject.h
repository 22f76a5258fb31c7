#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/hand/hand_model.h"
#include "render/glove_colors.h"
#include "render/subjects/capsule_hand.h"

namespace glovebench::render {

/// Subject 1: the tracker's hand; 2: its mesh, reshaped; from 3: capsules.
inline constexpr int kFirstCapsuleSubject = 3;
inline constexpr int kSubjectCount = 22;

/// Copies share the hand.
class Subject {
 public:
  // Implicit, so that a tracker's hand is a subject.
  Subject(std::shared_ptr<const HandModel> model) : hand_(std::move(model)) {}
  Subject(std::shared_ptr<const CapsuleHand> hand) : hand_(std::move(hand)) {}

  const std::vector<Triangle>& triangles() const;
  PosedHand pose(const Posture& posture) const;
  JointPoses joints(const Posture& posture) const;
  const std::string& hash() const;

 private:
  std::variant<std::shared_ptr<const HandModel>, std::shared_ptr<const CapsuleHand>> hand_;
};

/// Capsule hands take side and thumb zero of `tracker_hand`.
/// Throws: Error for an unknown number.
Subject make_subject(int number, const std::string& mesh_path, std::shared_ptr<const HandModel> tracker_hand);

Shader shader_of(int subject);

}  // namespace glovebench::render
