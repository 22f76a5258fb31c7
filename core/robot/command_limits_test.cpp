#include "core/robot/command_limits.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/test_error.h"

namespace glovebench {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

std::string limits_error(const json& limits) {
  return thrown_by([&] { command_limits_from_json(limits, "limits.json"); });
}

TEST(CommandLimitsJson, ReturnsWithEveryField) {
  CommandLimits limits;
  limits.hand_joint_speed = 1.25;
  limits.hand_speed = 0.5;
  limits.hand_turn_speed = 0.75;
  limits.fingertip_speed = 0.375;
  limits.arm_speed_share = 0.125;
  limits.workspace_min = {-1, -0.5, 0.25};
  limits.workspace_max = {1, 0.5, 1.5};
  limits.longest_step_s = 0.0625;
  limits.silence_s = 0.375;
  limits.stop_after_s = 1.75;
  const CommandLimits read = command_limits_from_json(to_json(limits), "limits.json");
  EXPECT_EQ(to_json(read), to_json(limits));
  EXPECT_EQ(read.hand_joint_speed, limits.hand_joint_speed);
  EXPECT_EQ(read.workspace_min, limits.workspace_min);
  EXPECT_EQ(read.stop_after_s, limits.stop_after_s);
  const json written = to_json(limits), defaults = to_json(CommandLimits());
  for (const auto& [key, value] : written.items())
    EXPECT_NE(value, defaults[key]) << key << " is read, not the default";
}

TEST(CommandLimitsJson, KeepsTheDefaultsOfWhatIsNotThere) {
  json expected = to_json(CommandLimits());
  expected["hand_speed_m_s"] = 0.125;
  EXPECT_EQ(to_json(command_limits_from_json({{"hand_speed_m_s", 0.125}}, "limits.json")), expected);
  EXPECT_EQ(to_json(command_limits_from_json(json::object(), "limits.json")), to_json(CommandLimits()));
}

TEST(CommandLimitsJson, ErrorsNameFileFieldAndExpectation) {
  EXPECT_THAT(limits_error(json::array()),
              HasSubstr("limits.json: top level: found an array of 0, expected an object"));
  EXPECT_THAT(limits_error({{"hand_sped_m_s", 1}}),
              AllOf(HasSubstr("found unknown key \"hand_sped_m_s\""), HasSubstr("hand_speed_m_s")));
  EXPECT_THAT(limits_error({{"hand_speed_m_s", "fast"}}),
              HasSubstr("limits.json: hand_speed_m_s: found \"fast\", expected a number"));
  EXPECT_THAT(limits_error({{"hand_speed_m_s", 0}}),
              HasSubstr("limits.json: hand_speed_m_s: found 0, expected above 0 and at most 10"));
  for (const char* key :
       {"hand_joint_speed_rad_s", "hand_speed_m_s", "hand_turn_speed_rad_s", "fingertip_speed_m_s"})
    EXPECT_THAT(limits_error({{key, 1e308}}), HasSubstr(std::string(key) + ": found 1e+308, expected above 0 and"));
  EXPECT_THAT(limits_error({{"arm_speed_share", 1.5}}), HasSubstr("arm_speed_share"));
  EXPECT_THAT(limits_error({{"workspace_min_m", {0, 0}}}),
              HasSubstr("workspace_min_m: found 2 elements, expected 3"));
  EXPECT_THAT(limits_error({{"workspace_min_m", {0, 0, nullptr}}}), HasSubstr("workspace_min_m[2]: found null"));
  EXPECT_THAT(limits_error({{"workspace_min_m", {0, 0, 3}}}), HasSubstr("the workspace is empty"));
  EXPECT_THAT(limits_error({{"workspace_min_m", {0, 0, 1.8}}}),
              HasSubstr("a side of the workspace is shorter than 0.3 m"));
  EXPECT_THAT(limits_error({{"fingertip_speed_m_s", -0.5}}),
              HasSubstr("fingertip_speed_m_s: found -0.5, expected above 0"));
  EXPECT_THAT(limits_error({{"stop_after_s", 1e99}}),
              HasSubstr("stop_after_s: found 1e+99, expected silence_s to 60"));
  EXPECT_THAT(limits_error({{"longest_step_s", 3}}), HasSubstr("longest_step_s"));
  EXPECT_THAT(limits_error({{"silence_s", 2}}), HasSubstr("stop_after_s: found 0.5, expected silence_s to 60"));
  EXPECT_THAT(limits_error({{"stop_after_s", std::numeric_limits<double>::infinity()}}),
              HasSubstr("limits.json: "));
}

}  // namespace
}  // namespace glovebench
