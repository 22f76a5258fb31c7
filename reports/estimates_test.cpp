#include "reports/estimates.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"
#include "reports/test_text.h"

namespace glovebench::reports {
namespace {

using testing::HasSubstr;

/// Two seeds of three frames, one of them lost.
ExperimentEstimates example_estimates() {
  ExperimentEstimates estimates{{"Tr4", "DB_open_power", TruthKind::source, 1, {}}, {}};
  for (const uint64_t seed : {1, 2}) {
    for (int frame = 4; frame < 7; ++frame) {
      RandomStream random(seed, "estimates_test", frame, "example");
      Estimate e{seed, frame, 66667 * frame, TrackStatus::tracked, Posture::Zero(), Eigen::Isometry3d::Identity()};
      for (double& angle : e.posture) angle = random.uniform(-1, 1);
      const Eigen::Vector4d q(random.normal(), random.normal(), random.normal(), random.normal());
      e.T_camera_hand = Eigen::Translation3d(random.normal(), random.normal(), random.normal()) *
                        Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
      if (frame == 5) e.status = TrackStatus::poor_match;
      estimates.estimates.push_back(e);
    }
  }
  return estimates;
}

std::string estimates_error(const std::string& text) {
  return thrown_by([&] { parse_estimates(text, "e.csv"); });
}

/// Replaces the first occurrence.
std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST(Estimates, ComeBackAsTheyWereWritten) {
  const ExperimentEstimates written = example_estimates();
  const std::string path = test_folder() + "/estimates.csv";
  write_file(path, estimates_csv(written));
  const std::vector<Estimate> read = read_estimates(path);
  ASSERT_EQ(read.size(), written.estimates.size());
  for (size_t i = 0; i < read.size(); ++i) {
    const Estimate &r = read[i], &w = written.estimates[i];
    EXPECT_EQ(std::tie(r.seed, r.frame, r.timestamp_us, r.status),
              std::tie(w.seed, w.frame, w.timestamp_us, w.status));
    if (w.status != TrackStatus::tracked) continue;
    EXPECT_LT((r.posture - w.posture).cwiseAbs().maxCoeff(), 1e-8) << "1e-6 degrees";
    EXPECT_LT((r.T_camera_hand.translation() - w.T_camera_hand.translation()).norm(), 1e-9) << "1e-6 mm";
    EXPECT_LT((r.T_camera_hand.linear() - w.T_camera_hand.linear()).norm(), 1e-8) << "a quaternion to 1e-9";
  }
}

TEST(Estimates, NamesUnitsAndLostFrames) {
  const std::string csv = estimates_csv(example_estimates());
  EXPECT_THAT(csv, testing::StartsWith("seed,frame,timestamp_us,status,position_x_mm,"));
  EXPECT_THAT(csv, HasSubstr(",little_dip_flexion_deg\n1,4,266668,tracked,"));
  EXPECT_THAT(csv, HasSubstr("\n1,5,333335,poor_match,,,,"));
  EXPECT_EQ(estimates_file(example_estimates().key), "estimates/Tr4_DB_open_power_source_subject1_gradient_1.csv");
}

TEST(Estimates, ErrorsNameLineColumnAndExpectation) {
  const std::string csv = estimates_csv(example_estimates());
  EXPECT_THAT(estimates_error(""), HasSubstr("e.csv: line 1: found no line end"));
  EXPECT_THAT(estimates_error("seed,frame\n"), HasSubstr("line 1: found 2 columns, expected 33"));
  EXPECT_THAT(estimates_error(replaced(csv, "position_x_mm", "position_x_m")), HasSubstr("expected position_x_mm"));
  EXPECT_THAT(estimates_error(csv.substr(0, csv.size() - 1)), HasSubstr("line 7: found no line end"));
  EXPECT_THAT(estimates_error(replaced(csv, "\n1,4,", "\n-1,4,")), HasSubstr("line 2, column seed: found \"-1\""));
  EXPECT_THAT(estimates_error(replaced(csv, "\n1,4,", "\n01,4,")), HasSubstr("line 2, column seed"));
  EXPECT_THAT(estimates_error(replaced(csv, "\n1,4,", "\n1,-4,")), HasSubstr("line 2, column frame"));
  EXPECT_THAT(estimates_error(replaced(csv, "\n1,6,", "\n1,7,")),
              HasSubstr("line 4, column frame: found \"7\", expected 6"));
  EXPECT_THAT(estimates_error(replaced(csv, ",333335,", ",266668,")), HasSubstr("line 3, column timestamp_us"));
  EXPECT_THAT(estimates_error(replaced(csv, "\n2,6,", "\n1,6,")), HasSubstr("line 7, column seed"));
  EXPECT_THAT(estimates_error(replaced(csv, "poor_match,,", "poor_match,1.5,")),
              HasSubstr("line 3, column position_x_mm"));
  EXPECT_THAT(estimates_error(replaced(csv, "poor_match", "bored")), HasSubstr("expected a frame's status"));
  EXPECT_THAT(estimates_error(replaced(csv, "poor_match", "tracked")),
              HasSubstr("line 3, column position_x_mm: found \"\""));
  for (const char* number : {"nan", "inf", "1e999", "2e6", "1.50", "0.12345678", "-0.0", " 1.0", "+1.0", "0x1p3"}) {
    EXPECT_THAT(
        estimates_error(replaced(csv, "4,266668,tracked,", std::string("4,266668,tracked,") + number + ",")),
        HasSubstr("34 columns"));
    std::string cell = csv;
    const size_t begin = cell.find("tracked,") + 8;
    cell.replace(begin, cell.find(',', begin) - begin, number);
    EXPECT_THAT(estimates_error(cell), HasSubstr("line 2, column position_x_mm: found")) << number;
  }
}

TEST(Estimates, DamageGivesAnErrorOrValidEstimates) {
  const ExperimentEstimates written = example_estimates();
  const std::string csv = estimates_csv(written);
  int refused = 0, accepted = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    RandomStream random(1, "estimates_test", trial, "damage");
    std::string text = csv;
    const size_t at = random.index(text.size());
    switch (random.index(4)) {
      case 0:
        text[at] = static_cast<char>(random.index(256));
        break;
      case 1:
        text.erase(at, 1 + random.index(20));
        break;
      case 2:
        text.insert(at, text.substr(at, 1 + random.index(300)));
        break;
      default:
        text[at] = static_cast<char>('0' + random.index(10));
    }
    try {
      const std::vector<Estimate> read = parse_estimates(text, "e.csv");
      ++accepted;
      EXPECT_EQ(estimates_csv({written.key, read}).find("nan"), std::string::npos);
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(accepted, 100) << "another digit is another estimate: the damage reaches the values";
}

}  // namespace
}  // namespace glovebench::reports
