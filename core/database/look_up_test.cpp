#include "core/database/look_up.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/database/test_database.h"

namespace glovebench {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr PinholeCamera kKinect{640, 480, 575.816, 575.816, 319.5, 239.5};

/// A query between the views: the hand in a posture between those of the database, from a random side.
LabelImage random_query(int number) {
  RandomStream random(1, "look-up", number, "query");
  const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  T_camera_hand.linear() = q.normalized().toRotationMatrix();
  T_camera_hand.translation() = Eigen::Vector3d(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), 0.7);
  const Posture posture = random.uniform(0, 1) * power_posture();
  render::LabelRenderer renderer;
  return renderer.render_labels(render::test_hand(), render::test_hand().pose(posture), kKinect, T_camera_hand);
}

/// Equation (2) word for word with Euclidean distances, px; an absent color costs half the side.
double brute_force_distance(const LabelImage& query, const LabelImage& entry) {
  double sum = 0;
  int count = 0;
  for (int i = 0; i < static_cast<int>(query.size()); ++i) {
    if (query[i] == 0) continue;
    double best = 0.5 * query.width();
    for (int j = 0; j < static_cast<int>(entry.size()); ++j) {
      if (entry[j] != query[i]) continue;
      best =
          std::min(best, std::hypot(i % query.width() - j % query.width(), i / query.width() - j / query.width()));
    }
    sum += best;
    ++count;
  }
  return sum / count;
}

TEST(LookUp, distance_is_equation_2_within_the_bounds_of_chamfering) {
  const Database& database = test_database();
  for (const int size : {8, 16, 32}) {
    const LabelImage image = random_query(0);
    const LabelImage query = make_tiny_image(image, bounding_square(image), size);
    for (int entry = 3; entry < database.entry_count(); entry += 97) {
      const double expected = brute_force_distance(query, entry_image(database, size, entry));
      const float found = distance(database, entry, query);
      // A 3-4 path is 5.7% shorter to 5.4% longer than the straight line.
      EXPECT_GT(found, 0.942 * expected) << size << " px, entry " << entry;
      EXPECT_LT(found, 1.055 * expected + 1e-6) << size << " px, entry " << entry;
    }
  }
}

TEST(LookUp, distance_is_the_mean_of_the_stored_fields) {
  const Database& database = test_database();
  LabelImage query(16, 16);
  query(3, 5) = 2;
  query(9, 12) = 7;
  for (const int entry : {0, 900}) {
    const uint8_t* fields = database.fields(16, entry);
    const int a = fields[1 * 256 + 5 * 16 + 3], b = fields[6 * 256 + 12 * 16 + 9];
    EXPECT_FLOAT_EQ(distance(database, entry, query), static_cast<float>(a + b) / 2 / 3);
  }
  EXPECT_EQ(distance(database, 0, LabelImage(16, 16)), 0);
}

TEST(LookUp, distances_are_those_of_all_entries) {
  const Database& database = test_database();
  const LabelImage image = random_query(2);
  const LabelImage query = make_tiny_image(image, bounding_square(image), 16);
  const std::vector<float> all = distances(database, query);
  ASSERT_EQ(static_cast<int>(all.size()), database.entry_count());
  for (int entry = 0; entry < database.entry_count(); ++entry)
    ASSERT_EQ(all[entry], distance(database, entry, query)) << entry;
  EXPECT_EQ(distances(database, LabelImage(16, 16)), std::vector<float>(all.size(), 0));
}

TEST(LookUp, finds_each_own_view_with_error_0) {
  const Database& database = test_database();
  const Cascade cascade = {{64, 1}};
  for (int entry = 0; entry < database.entry_count(); entry += 61) {
    const RecycledVector<Match> matches = look_up(database, {{entry_image(database, 64, entry)}}, cascade);
    ASSERT_EQ(matches.size(), 1u);
    EXPECT_EQ(matches[0].error, 0);
    EXPECT_EQ(matches[0].entry, entry);
  }
}

TEST(LookUp, ranks_by_distance_and_equal_ones_by_entry) {
  const Database& database = test_database();
  LabelImage query(8, 8);
  query(4, 4) = 1;  // one pixel: many entries are equally far
  const RecycledVector<Match> matches = look_up(database, {{query}}, {{8, 1512}});
  ASSERT_EQ(matches.size(), 1512u);
  int ties = 0;
  for (size_t i = 0; i < matches.size(); ++i) {
    ASSERT_EQ(matches[i].error, distance(database, matches[i].entry, query));
    if (i == 0) continue;
    ASSERT_LE(matches[i - 1].error, matches[i].error);
    if (matches[i - 1].error != matches[i].error) continue;
    ASSERT_LT(matches[i - 1].entry, matches[i].entry);
    ++ties;
  }
  EXPECT_GT(ties, 1000);
}

TEST(LookUp, a_stage_ranks_what_the_one_before_kept) {
  const Database& database = test_database();
  const LabelImage image = random_query(1);
  const Cascade cascade = {{8, 40}, {32, 5}};
  const TinyImages query = make_tiny_images(image, bounding_square(image), cascade);
  std::vector<std::pair<float, int>> kept;
  for (const Match& match : look_up(database, {{query.images[0]}}, {{8, 40}}))
    kept.emplace_back(distance(database, match.entry, query.images[1]), match.entry);
  std::sort(kept.begin(), kept.end());
  const RecycledVector<Match> matches = look_up(database, query, cascade);
  ASSERT_EQ(matches.size(), 5u);
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(matches[i].entry, kept[i].second);
    EXPECT_EQ(matches[i].error, kept[i].first);
  }
}

TEST(LookUp, the_papers_cascade_agrees_with_exhaustive_search) {
  const Database& database = test_database();
  const Cascade fast = {{16, 500}, {64, 3}}, exhaustive = {{64, 3}};
  constexpr int kQueries = 100;
  int equal = 0;
  for (int number = 0; number < kQueries; ++number) {
    const LabelImage image = random_query(number);
    const Square square = bounding_square(image);
    const RecycledVector<Match> a = look_up(database, make_tiny_images(image, square, fast), fast);
    const RecycledVector<Match> b = look_up(database, make_tiny_images(image, square, exhaustive), exhaustive);
    equal += std::equal(a.begin(), a.end(), b.begin(), b.end(),
                        [](const Match& x, const Match& y) { return x.entry == y.entry && x.error == y.error; });
    ASSERT_GE(a[0].error, b[0].error) << "nothing is nearer than the nearest";
  }
  RecordProperty("cascade_agreement_percent", equal);
  std::printf("16:500,64:3 gives the three of 64:3 for %d of %d queries\n", equal, kQueries);
  EXPECT_GE(equal, 98);
}

TEST(LookUp, the_trace_holds_what_each_stage_kept) {
  const Database& database = test_database();
  const LabelImage image = random_query(1);
  const Cascade cascade = {{8, 40}, {32, 5}};
  const TinyImages query = make_tiny_images(image, bounding_square(image), cascade);
  const auto entries_of = [](const RecycledVector<Match>& matches) {
    std::vector<int> entries;
    for (const Match& match : matches) entries.push_back(match.entry);
    return entries;
  };
  LookUpTrace trace{{{1, 2, 3}}};  // of another look-up
  const RecycledVector<Match> matches = look_up(database, query, cascade, "plain", &trace);
  ASSERT_EQ(trace.kept.size(), 2u);
  EXPECT_EQ(trace.kept[0], entries_of(look_up(database, {{query.images[0]}}, {{8, 40}})));
  EXPECT_EQ(trace.kept[1], entries_of(matches));
}

TEST(LookUp, a_query_without_glove_matches_nothing) {
  const Cascade cascade = {{16, 500}, {64, 3}};
  const LabelImage empty(640, 480);
  const TinyImages query = make_tiny_images(empty, bounding_square(empty), cascade);
  EXPECT_TRUE(look_up(test_database(), query, cascade).empty());
}

TEST(Cascade, is_parsed_and_written_back) {
  const Cascade papers = {{16, 500}, {64, 3}};
  EXPECT_EQ(parse_cascade("16:500,64:3"), papers);
  for (const char* text : {"8:1", "64:3", "8:2000,16:500,32:50,64:3", "64:3,64:3", "64:100000000"})
    EXPECT_EQ(to_string(parse_cascade(text)), text);
}

TEST(Cascade, exact_means_the_largest_images_alone) {
  const Cascade largest = {{64, 3}};
  EXPECT_EQ(parse_cascade("exact:3"), largest);
  for (const char* text : {"exact", "exact:", "exact:x", "exact:3,64:1", "16:500,exact:3", "Exact:3"})
    EXPECT_THAT([&] { parse_cascade(text); }, ThrowsMessage<Error>(HasSubstr("exact:KEEP"))) << text;
  EXPECT_THAT([] { parse_cascade("exact:0"); }, ThrowsMessage<Error>(HasSubstr("found keep 0")));
}

TEST(Cascade, refuses_what_is_malformed_or_impossible_and_says_why) {
  for (const char* text : {"", "64", "64:", ":3", "64:3,", ",64:3", "64:3,,64:2", "64:3;16:2", "64:three", "64:3.5",
                           " 64:3", "64:3 ", "64:+3", "64:3:2", "0x40:3", "64:99999999999999999999"})
    EXPECT_THAT([&] { parse_cascade(text); }, ThrowsMessage<Error>(HasSubstr("such as 16:500,64:3"))) << text;
  for (const char* text : {"12:5", "0:5", "-8:5", "128:3", "2147483647:1"})
    EXPECT_THAT([&] { parse_cascade(text); }, ThrowsMessage<Error>(HasSubstr("8, 16, 32 or 64"))) << text;
  EXPECT_THAT([] { parse_cascade("64:0"); }, ThrowsMessage<Error>(HasSubstr("found keep 0")));
  EXPECT_THAT([] { parse_cascade("64:-3"); }, ThrowsMessage<Error>(HasSubstr("found keep -3")));
  EXPECT_THAT([] { parse_cascade("64:100000001"); }, ThrowsMessage<Error>(HasSubstr("at most 100000000")));
  EXPECT_THAT([] { parse_cascade("16:3,64:500"); }, ThrowsMessage<Error>(HasSubstr("at most the 3")));
}

}  // namespace

}  // namespace glovebench
