#include "render/subjects/subject.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace glovebench::render {

const std::vector<Triangle>& Subject::triangles() const {
  return std::visit([](const auto& hand) -> const std::vector<Triangle>& { return hand->triangles(); }, hand_);
}

PosedHand Subject::pose(const Posture& posture) const {
  return std::visit([&](const auto& hand) { return hand->pose(posture); }, hand_);
}

JointPoses Subject::joints(const Posture& posture) const {
  if (const auto* capsules = std::get_if<std::shared_ptr<const CapsuleHand>>(&hand_))
    return (*capsules)->joints(posture);
  return pose(posture).T_hand_joint;
}

const std::string& Subject::hash() const {
  return std::visit([](const auto& hand) -> const std::string& { return hand->hash(); }, hand_);
}

Subject make_subject(int number, const std::string& mesh_path, std::shared_ptr<const HandModel> tracker_hand) {
  if (number < 1 || number > kSubjectCount)
    throw Error("subject", "number", std::to_string(number), fmt::format("1 to {}", kSubjectCount));
  if (number == 1) return tracker_hand;
  if (number == 2)
    return std::make_shared<const HandModel>(HandModel::load(mesh_path, tracker_hand->side(), second_subject()));
  return std::make_shared<const CapsuleHand>(static_cast<uint64_t>(number), tracker_hand->side(),
                                             tracker_hand->skeleton());
}

Shader shader_of(int subject) { return subject == 1 ? Shader::first_subject : Shader::second_subject; }

}  // namespace glovebench::render
