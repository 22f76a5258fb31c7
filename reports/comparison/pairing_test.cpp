#include "reports/comparison/pairing.h"

#include <gmock/gmock.h>

#include "reports/comparison/example_runs.h"
#include "reports/test_text.h"

namespace glovebench::reports {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

NamedResult two_experiments(const std::string& name) {
  const MakeFrame make_frame = [](uint64_t, int f) {
    return f == 5 ? example_lost_frame(f) : example_frame(f, 3, 2, 1);
  };
  return example_named(
      name, {example_experiment("Tr1", {1, 2}, 20, make_frame), example_experiment("Tr4", {1, 2}, 20, make_frame)});
}

std::string refusal(const NamedResult& baseline, const NamedResult& candidate, const PairingOptions& options = {}) {
  return thrown_by<Incomparable>([&] { pair_results(baseline, candidate, options); });
}

std::string refusal_of_change(const std::function<void(RunResult&)>& change, const PairingOptions& options = {}) {
  NamedResult candidate = two_experiments("out/new");
  change(candidate.result);
  return refusal(two_experiments("base"), candidate, options);
}

TEST(Pairing, EqualResultsArePairedWithAllTheyHave) {
  const NamedResult a = two_experiments("a");
  NamedResult b = two_experiments("b");
  std::ranges::reverse(b.result.experiments);
  const Pairing pairing = pair_results(a, b);
  ASSERT_EQ(pairing.experiments.size(), 2u);
  for (const auto& [baseline, candidate] : pairing.experiments) EXPECT_EQ(baseline->key, candidate->key);
  EXPECT_EQ(pairing.experiments[0].first, &a.result.experiments[0]);
  EXPECT_EQ(pairing.experiments[0].second, &b.result.experiments[1]);
  EXPECT_THAT(pairing.only_in_baseline, IsEmpty());
  EXPECT_THAT(pairing.only_in_candidate, IsEmpty());
}

TEST(Pairing, OtherProtocolsAreRefusedByTheMemberThatDiffers) {
  EXPECT_EQ(refusal_of_change([](RunResult& r) { ++r.protocol.metric_definitions; }),
            "out/new: protocol.metric_definitions: found 2, expected 1");
  EXPECT_THAT(refusal_of_change([](RunResult& r) { r.protocol.joint_order[3] = std::string("elbow"); }),
              HasSubstr("protocol.joint_order[3]: found elbow, expected "));
  EXPECT_THAT(refusal_of_change([](RunResult& r) { r.protocol.association = "nearest"; }),
              HasSubstr("protocol.association: found nearest, expected by time stamp, exact"));
}

TEST(Pairing, GatedMetricsThatBothHaveAreCompared) {
  NamedResult fewer = two_experiments("fewer"), more = two_experiments("more");
  std::erase(fewer.result.protocol.metric_keys, "rotation_error_deg");
  std::erase(fewer.result.protocol.metric_keys, "joint_error_mm");  // is not gated
  more.result.protocol.metric_keys.push_back("mood_deg");
  std::vector<const Metric*> shared;
  for (const Metric& metric : gated_metrics())
    if (metric.key != "rotation_error_deg") shared.push_back(&metric);
  EXPECT_EQ(pair_results(fewer, more).metrics, shared);
  EXPECT_EQ(pair_results(more, fewer).metrics, shared);
  using Why = std::map<std::string, std::string>;
  EXPECT_EQ(uncompared_metrics(fewer.result.protocol, more.result.protocol),
            (Why{{"rotation_error_deg", "not in the baseline"}, {"mood_deg", "unknown to this program"}}));
  EXPECT_EQ(uncompared_metrics(more.result.protocol, fewer.result.protocol),
            (Why{{"rotation_error_deg", "not in the candidate"}, {"mood_deg", "unknown to this program"}}));
  EXPECT_EQ(uncompared_metrics(fewer.result.protocol, fewer.result.protocol),
            (Why{{"rotation_error_deg", "not in the candidate"}}));
}

TEST(Pairing, ABaselineWithoutLevelsOfCoverageIsComparedInTheRest) {
  NamedResult older = two_experiments("older");
  older.result.protocol.coverage_rules.clear();
  std::erase(older.result.protocol.metric_keys, "visible_percent");
  const NamedResult newer = two_experiments("newer");
  std::vector<const Metric*> shared;
  for (const Metric& metric : gated_metrics())
    if (metric.key != "unusable_percent") shared.push_back(&metric);
  EXPECT_EQ(pair_results(older, newer).metrics, shared);
  EXPECT_EQ(uncompared_metrics(older.result.protocol, newer.result.protocol),
            (std::map<std::string, std::string>{{"unusable_percent", "not in the baseline"}}));
}

TEST(Pairing, OtherTruthsAndDatabasesAreRefused) {
  EXPECT_EQ(refusal_of_change([](RunResult& r) { r.inputs.truths["source/Tr4"] = "ee"; }),
            "out/new: inputs.truths.source/Tr4: found ee, expected ff");
  EXPECT_EQ(refusal_of_change([](RunResult& r) { r.inputs.databases["DB_open_power"] = "0b"; }),
            "out/new: inputs.databases.DB_open_power: found 0b, expected 0a");
  EXPECT_EQ(refusal_of_change([](RunResult& r) { r.inputs.truths.erase("source/Tr1"); }),
            "out/new: inputs.truths.source/Tr1: found nothing, expected ff");
  NamedResult baseline = two_experiments("base");
  baseline.result.inputs.databases.clear();
  EXPECT_EQ(refusal(baseline, two_experiments("new")),
            "base: inputs.databases.DB_open_power: found nothing, expected a hash");
}

TEST(Pairing, InputsOfWhatIsNotSharedDoNotMatter) {
  EXPECT_EQ(refusal_of_change([](RunResult& r) { r.inputs.truths["source/Tr3"] = "01"; }), "");
  EXPECT_EQ(refusal_of_change([](RunResult& r) { r.inputs.color_table = "01"; }), "")
      << "a table calibrated otherwise is a change of the tracker, to be measured";
}

TEST(Pairing, SeedsMustBeTheSameUnlessOthersAreAskedFor) {
  const auto other = [](RunResult& r) { r.experiments[1].runs[1].seed = 3; };
  EXPECT_EQ(refusal_of_change(other),
            "out/new: Tr4_DB_open_power_source_subject1_gradient_1.seeds: found [1, 3], expected [1, 2]");
  EXPECT_EQ(refusal_of_change(other, {.other_seeds = true}), "");
  const auto fewer = [](RunResult& r) { r.experiments[0].runs.pop_back(); };
  EXPECT_THAT(refusal_of_change(fewer), HasSubstr("seeds: found [1], expected [1, 2]"));
  EXPECT_THAT(refusal_of_change(fewer, {.other_seeds = true}), HasSubstr("seeds: found [1], expected 2 seeds"));
}

TEST(Pairing, AFrameThatLeftTheResultIsNamed) {
  EXPECT_EQ(
      refusal_of_change([](RunResult& r) {
        auto& frames = r.experiments[1].runs[0].frames;
        frames.erase(frames.begin() + 5);
      }),
      "out/new: Tr4_DB_open_power_source_subject1_gradient_1.seed 1.frames: found 19 frames, without frame 5, "
      "expected 20 frames (a lost frame stays in a result)");
  EXPECT_THAT(refusal_of_change([](RunResult& r) { r.experiments[1].runs[0].frames.pop_back(); }),
              HasSubstr("found 19 frames, without frame 19"));
  EXPECT_THAT(
      refusal_of_change([](RunResult& r) { r.experiments[0].runs[1].frames.push_back(example_lost_frame(20)); }),
      HasSubstr("seed 2.frames: found 21 frames, frame 20 among them, expected 20 frames"));
}

TEST(Pairing, FrameNumbersAndTimeStampsMustBeEqual) {
  EXPECT_THAT(refusal_of_change([](RunResult& r) { r.experiments[0].runs[1].frames[3].frame = 4; }),
              HasSubstr("seed 2.frames[3].frame: found 4, expected 3"));
  EXPECT_THAT(refusal_of_change([](RunResult& r) { r.experiments[0].runs[1].frames[3].timestamp_us += 1; }),
              HasSubstr("seed 2.frames[3].timestamp_us: found 200001, expected 200000"));
}

TEST(Pairing, AMissingExperimentIsRefusedUnlessAPartIsAskedFor) {
  const auto remove = [](RunResult& r) { r.experiments.pop_back(); };
  EXPECT_EQ(refusal_of_change(remove),
            "out/new: experiments: found no Tr4_DB_open_power_source_subject1_gradient_1, expected all 2 of the "
            "baseline's");
  NamedResult part = two_experiments("part");
  remove(part.result);
  const Pairing pairing = pair_results(two_experiments("base"), part, {.partial = true});
  EXPECT_EQ(pairing.experiments.size(), 1u);
  EXPECT_THAT(pairing.only_in_baseline, ElementsAre("Tr4_DB_open_power_source_subject1_gradient_1"));
  const Pairing grown = pair_results(part, two_experiments("more"));
  EXPECT_THAT(grown.only_in_candidate, ElementsAre("Tr4_DB_open_power_source_subject1_gradient_1"));
}

TEST(Pairing, NothingInCommonIsNoComparison) {
  const auto remove_all = [](RunResult& r) { r.experiments.clear(); };
  EXPECT_THAT(refusal_of_change(remove_all, {.partial = true}), HasSubstr("found none that the baseline has"));
  NamedResult empty = two_experiments("empty");
  remove_all(empty.result);
  EXPECT_THAT(refusal(empty, two_experiments("new")), HasSubstr("found none that the baseline has"));
}

TEST(Pairing, AnExperimentThatIsThereTwiceIsRefused) {
  EXPECT_THAT(refusal_of_change([](RunResult& r) { r.experiments.push_back(r.experiments[0]); }),
              HasSubstr("out/new: experiments: found Tr1_DB_open_power_source_subject1_gradient_1 twice"));
}

TEST(Pairing, TheFirstDifferenceIsTheOneNamed) {
  EXPECT_THAT(refusal_of_change([](RunResult& r) {
                r.experiments[0].runs[0].frames.pop_back();
                r.experiments[1].runs[0].seed = 9;
                r.inputs.databases["DB_open_power"] = "0b";
                r.protocol.association = "nearest";
              }),
              HasSubstr("protocol.association"));
  EXPECT_THAT(refusal_of_change([](RunResult& r) {
                r.experiments[0].runs[0].frames.pop_back();
                r.experiments[1].runs[0].seed = 9;
              }),
              HasSubstr("seeds"));
}

TEST(Pairing, AcrossNoiseAndSubjectNamesWhatDiffers) {
  const NamedResult a = two_experiments("a");
  NamedResult b = two_experiments("b");
  for (ExperimentResult& experiment : b.result.experiments) {
    experiment.key.noise = {"kinect", 0.5};
    experiment.key.subject = 3;
  }
  const std::string both = "(they differ in noise and subject: `glovebench compare --across noise,subject`)";
  EXPECT_EQ(refusal(a, b),
            "b: experiments: found no Tr1_DB_open_power_source_subject1_gradient_1, expected all 2 of the "
            "baseline's " +
                both);
  EXPECT_THAT(refusal(a, b, {.across = {Across::noise}}), testing::EndsWith(both));
  NamedResult one = two_experiments("one"), noisier = two_experiments("noisier");
  for (NamedResult* named : {&one, &noisier}) named->result.experiments.resize(1);
  noisier.result.experiments[0].key.noise.factor = 2;
  EXPECT_THAT(refusal(one, noisier), testing::EndsWith("expected it, as in the baseline (they differ in noise: "
                                                       "`glovebench compare --across noise`)"));
  one.result.experiments.insert(one.result.experiments.begin(), noisier.result.experiments[0]);
  EXPECT_THAT(refusal(one, noisier), testing::EndsWith("expected all 2 of the baseline's"))
      << "nothing else differs";
  const Pairing pairing = pair_results(a, b, {.across = {Across::noise, Across::subject}});
  EXPECT_EQ(pairing.experiments.size(), 2U);
  ASSERT_EQ(pairing.across.size(), 2U) << "each once";
  EXPECT_EQ(pairing.across[0].field, "noise");
  EXPECT_EQ(pairing.across[0].baseline, "gradient x 1");
  EXPECT_EQ(pairing.across[0].candidate, "kinect x 0.5");
  EXPECT_EQ(pairing.across[1].field, "subject");
  EXPECT_EQ(pairing.across[1].candidate, "3");
}

TEST(Pairing, AcrossHandTheDatabasesOfAnotherHandAreCompared) {
  const NamedResult a = two_experiments("a");
  NamedResult b = two_experiments("b");
  b.result.inputs.databases["DB_open_power"] = "0b";
  const std::string refused = "b: inputs.databases.DB_open_power: found 0b, expected 0a";
  EXPECT_EQ(refusal(a, b, {.across = {Across::hand}}), refused) << "built otherwise from one hand";
  b.result.inputs.hand_model = "another";
  EXPECT_EQ(refusal(a, b), refused + " (they differ in hand: `glovebench compare --across hand`)");
  const Pairing pairing = pair_results(a, b, {.across = {Across::hand}});
  EXPECT_EQ(pairing.experiments.size(), 2U);
  ASSERT_EQ(pairing.across.size(), 1U);
  EXPECT_EQ(pairing.across[0].field, "inputs.hand_model");
  EXPECT_EQ(pairing.across[0].baseline, a.result.inputs.hand_model);
  EXPECT_EQ(pairing.across[0].candidate, "another");
  b.result.inputs.truths["source/Tr4"] = "ee";
  EXPECT_THAT(refusal(a, b, {.across = {Across::hand}}), HasSubstr("inputs.truths.source/Tr4"));
}

TEST(Pairing, AcrossNoiseEachExperimentHasOnePartner) {
  NamedResult b = two_experiments("b");
  b.result.experiments[1].key = b.result.experiments[0].key;
  b.result.experiments[1].key.noise.factor = 2;
  EXPECT_THAT(refusal(two_experiments("a"), b, {.across = {Across::noise}}),
              HasSubstr("b: experiments: found Tr1_DB_open_power_source_subject1_gradient_1 and "
                        "Tr1_DB_open_power_source_subject1_gradient_2, expected one of them"));
}

TEST(Pairing, AcrossFramesThoseOfBothAreCompared) {
  const NamedResult a = two_experiments("a");
  NamedResult b = two_experiments("b");
  for (ExperimentResult& experiment : b.result.experiments) {
    for (SeedRun& run : experiment.runs) {
      run.frames.erase(run.frames.begin(), run.frames.begin() + 4);
      run.frames.push_back(example_frame(20, 3, 2, 1));
    }
  }
  EXPECT_THAT(refusal(a, b), HasSubstr("frames"));
  const Pairing pairing = pair_results(a, b, {.across = {Across::frames}});
  for (const auto& [before, after] : pairing.experiments) {
    for (size_t s = 0; s < 2; ++s) {
      EXPECT_EQ(before->runs[s].frames.size(), 16U);
      EXPECT_EQ(before->runs[s].frames.front().frame, 4);
      EXPECT_TRUE(std::ranges::equal(before->runs[s].frames, after->runs[s].frames, {}, &FrameRecord::frame,
                                     &FrameRecord::frame));
    }
  }
  ASSERT_EQ(pairing.across.size(), 1U);
  EXPECT_EQ(pairing.across[0].baseline, "0 to 19");
  EXPECT_EQ(pairing.across[0].candidate, "4 to 20");
  for (ExperimentResult& experiment : b.result.experiments)
    for (SeedRun& run : experiment.runs) run.frames = {example_frame(30, 3, 2, 1)};
  EXPECT_THAT(refusal(a, b, {.across = {Across::frames}}), HasSubstr("none that the baseline has"));
}

}  // namespace
}  // namespace glovebench::reports
