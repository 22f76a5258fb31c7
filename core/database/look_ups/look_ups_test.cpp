#include "core/database/look_up_parts.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/random.h"
#include "core/base/sanitizers.h"
#include "core/database/look_up_kernels.h"
#include "core/database/made_distances.h"
#include "core/database/test_database.h"
#include "core/test_simd.h"

namespace glovebench {
namespace {

bool equal(const RecycledVector<Match>& a, const RecycledVector<Match>& b) {
  return std::ranges::equal(
      a, b, [](const Match& x, const Match& y) { return x.entry == y.entry && x.error == y.error; });
}

/// Each look-up's matches and trace are the plain one's, on each instruction set.
void expect_equal_to_plain(const Database& database, const TinyImages& query, const Cascade& cascade) {
  LookUpTrace plain_trace{{{1}}};  // of another look-up
  const RecycledVector<Match> plain = look_up(database, query, cascade, "plain", &plain_trace);
  on_each_instruction_set([&] {
    for (const LookUpEntry& other : look_ups()) {
      if (other.name == "plain") continue;
      LookUpTrace trace{{{2}}};
      EXPECT_TRUE(equal(plain, look_up(database, query, cascade, other.name, &trace)))
          << other.name << " " << to_string(cascade);
      EXPECT_EQ(plain_trace.kept, trace.kept) << other.name << " " << to_string(cascade);
    }
  });
}

/// A query that is hard in one of several ways, as a tiny image of one size. The same number gives the same query.
LabelImage hostile_query(const Database& database, int size, int number) {
  RandomStream random(1, "fast look-up", number, "query");
  const auto below = [&](int n) { return static_cast<int>(random.uniform(0, n)); };
  LabelImage query = entry_image(database, size, below(database.entry_count()));
  const auto any_color = [&] { return static_cast<uint8_t>(1 + below(kColorCount)); };
  switch (number % 8) {
    case 0:  // a view itself
      break;
    case 1:  // wrong labels here and there
      for (uint8_t& label : query)
        if (random.uniform(0, 1) < 0.1) label = static_cast<uint8_t>(below(kColorCount + 1));
      break;
    case 2: {  // shifted
      const LabelImage before = query;
      const int du = below(9) - 4, dv = below(9) - 4;
      for (int v = 0; v < size; ++v)
        for (int u = 0; u < size; ++u)
          query(u, v) = before.contains(u + du, v + dv) ? before(u + du, v + dv) : uint8_t{0};
      break;
    }
    case 3:  // glove everywhere, in one color: most entries are far away
      std::ranges::fill(query, any_color());
      break;
    case 4:  // noise alone
      for (uint8_t& label : query) label = static_cast<uint8_t>(below(kColorCount + 1));
      break;
    case 5:  // a single pixel: most entries are equally near
      std::ranges::fill(query, uint8_t{0});
      query[below(static_cast<int>(query.size()))] = any_color();
      break;
    case 6: {  // one color of a view
      const uint8_t color = any_color();
      for (uint8_t& label : query)
        if (label != color) label = 0;
      break;
    }
    case 7: {  // half of one view and half of another
      const LabelImage other = entry_image(database, size, below(database.entry_count()));
      std::copy_n(other.begin(), other.size() / 2, query.begin());
      break;
    }
  }
  return query;
}

constexpr int kQueries = kHasAddressSanitizer ? 8 : 16;  // each of the eight kinds once or twice

TinyImages hostile_queries(const Database& database, const Cascade& cascade, int number) {
  TinyImages query;
  for (const CascadeStage& stage : cascade) query.images.push_back(hostile_query(database, stage.size, number));
  return query;
}

Database database_of_one_posture(std::span<const int> sizes, DatabaseMemory memory = DatabaseMemory::normal) {
  PostureSet one = test_postures();
  one.postures.resize(1);
  one.posture_names.resize(1);
  return Database::build(one, render::test_hand(), {}, render::label_renderer_factory(), 2, {}, sizes, memory);
}

TEST(FastLookUp, agrees_with_the_plain_one_on_each_instruction_set) {
  const Database& database = test_database();
  for (const char* text : {"16:500,64:3", "64:3", "16:1000,32:300,64:3", "8:15", "8:1512,32:7", "32:3", "32:700",
                           "64:1512", "64:100000,64:2", "8:1"}) {
    const Cascade cascade = parse_cascade(text);
    for (int number = 0; number < kQueries; ++number) {
      SCOPED_TRACE(number);
      expect_equal_to_plain(database, hostile_queries(database, cascade, number), cascade);
    }
  }
}

TEST(FastLookUpLong, finds_the_same_in_a_low_memory_database) {
  const Database &normal = test_database(), &low = test_database(DatabaseMemory::low);
  for (const char* text : {"16:500,64:3", "64:3", "exact:3", "16:1000,32:300,64:3", "8:15", "8:1512,32:7", "32:3",
                           "64:700", "8:1", "8:1512,16:100,64:50"}) {
    const Cascade cascade = parse_cascade(text);
    for (int number = 0; number < kQueries; ++number) {  // 5 and 13, a single pixel: most entries are equally near
      SCOPED_TRACE(number);
      const TinyImages query = hostile_queries(normal, cascade, number);
      LookUpTrace expected, found;
      const RecycledVector<Match> matches = look_up(normal, query, cascade, "plain", &expected);
      on_each_instruction_set([&] {
        EXPECT_TRUE(equal(matches, look_up(low, query, cascade, "fast", &found))) << text;
        EXPECT_EQ(expected.kept, found.kept) << text;
      });
    }
    const TinyImages query = hostile_queries(normal, cascade, 7);
    EXPECT_TRUE(equal(look_up(normal, query, cascade), look_up(low, query, cascade, "plain"))) << text;
  }
}

TEST(FastLookUp, made_distances_are_the_stored_ones_or_above_the_limit) {
  const Database &normal = test_database(), &low = test_database(DatabaseMemory::low);
  for (const int size : kTinySizes) {
    for (int number = 0; number < kQueries; ++number) {
      const LabelImage query = hostile_query(normal, size, number);
      const auto glove = static_cast<float>(query.size() - std::ranges::count(query, 0));
      const MadeDistances made(low, query);
      for (int entry = 0; entry < low.entry_count(); entry += 101) {
        const auto sum = static_cast<uint32_t>(std::lround(distance(normal, entry, query) * glove * kFieldScale));
        ASSERT_EQ(distance(low, entry, query), distance(normal, entry, query));
        ASSERT_EQ(made.sum(entry, 1u << 31), sum) << size << " px, entry " << entry;
        ASSERT_EQ(made.sum(entry, sum), sum) << size << " px, entry " << entry;
        if (sum > 0) {
          ASSERT_GT(made.sum(entry, sum - 1), sum - 1) << size << " px, entry " << entry;
        }
      }
    }
  }
}

TEST(FastLookUpLong, finds_the_neighbors_of_brute_force_for_ten_thousand_queries) {
  const Database database = database_of_one_posture(std::array{64});  // brute force is what takes the time
  const Cascade exact = parse_cascade("exact:3");
  for (int number = 0; number < 10'000; ++number) {
    const TinyImages query = hostile_queries(database, exact, number);
    ASSERT_TRUE(equal(look_up(database, query, exact, "plain"), look_up(database, query, exact, "fast"))) << number;
  }
}

void expect_plain_answers_of_any_size(DatabaseMemory memory, int queries) {
  const std::vector<int> sizes = {4, 6, 12, 24, 25, 31, 48, 50, 64};
  const Database database = database_of_one_posture(sizes, memory);
  for (const int size : sizes) {
    for (const int keep : {1, 3, 756, 1'000'000}) {
      const Cascade cascade = {{size, keep}};
      for (int number = 0; number < queries; ++number)
        expect_equal_to_plain(database, hostile_queries(database, cascade, number), cascade);
    }
  }
}

TEST(FastLookUp, works_with_databases_of_any_size) { expect_plain_answers_of_any_size(DatabaseMemory::normal, 8); }

TEST(FastLookUpLong, works_with_low_memory_databases_of_any_size) {
  expect_plain_answers_of_any_size(DatabaseMemory::low, 3);
}

class FastLookUpMemory : public testing::TestWithParam<DatabaseMemory> {};
INSTANTIATE_TEST_SUITE_P(Memory, FastLookUpMemory, testing::Values(DatabaseMemory::normal, DatabaseMemory::low),
                         [](const auto& tested) { return std::string(to_string(tested.param)); });

TEST_P(FastLookUpMemory, sums_at_the_cap_do_not_overflow) {
  // Glove in every pixel, no color in any entry: fields at the largest cap there is.
  for (const int size : {16, 24, 32, 64}) {
    const size_t pixels = static_cast<size_t>(size) * size;
    const uint8_t cap = static_cast<uint8_t>(size * kFieldScale);
    constexpr int kEntries = 70;
    const std::vector<uint8_t> fields(pixels * kColorCount * kEntries + 64, cap);
    FieldRows rows(size, GetParam(), kEntries, cap);
    rows.put(0, std::span(fields).first(pixels * kColorCount * kEntries));
    const LabelImage query(size, size, 7);
    std::vector<uint16_t> sums(rows.block_count() * FieldRows::kBlock), minima(rows.block_count());
    QueryLabels labels;
    std::ranges::copy(query, labels.labels);
    std::vector<FieldChunk> chunks;
    for (size_t pixel = 0; pixel < pixels; pixel += 64)
      chunks.push_back({static_cast<uint32_t>(6 * pixels + pixel), static_cast<uint16_t>(pixel), 7});
    on_each_instruction_set([&] {
      add_rows(rows, rows.rows_of(query), sums, minima);
      const size_t expected = std::min<size_t>(65535, pixels * cap);
      EXPECT_THAT(sums, testing::Each(expected)) << size;
      EXPECT_THAT(minima, testing::Each(expected)) << size;
      EXPECT_TRUE(!rows.exact() || pixels * cap < 65535) << "exact sums are not cut off";
      EXPECT_EQ(add_chunks(fields.data(), labels, chunks, 1'000'000, nullptr), pixels * cap) << size;
    });
  }
}

TEST(FastLookUp, adding_chunks_stops_above_the_limit) {
  const std::vector<uint8_t> fields(64 * 100, 10);
  QueryLabels labels;
  labels.labels[5] = 3;
  labels.labels[6] = 2;  // another color
  std::vector<FieldChunk> chunks;
  for (uint32_t c = 0; c < 100; ++c) chunks.push_back({64 * c, 0, 3});
  on_each_instruction_set([&] {
    EXPECT_EQ(add_chunks(fields.data(), labels, chunks, 1000, nullptr), 1000u);
    EXPECT_EQ(add_chunks(fields.data(), labels, chunks, 5000, fields.data()), 1000u);
    const uint32_t stopped = add_chunks(fields.data(), labels, chunks, 200, nullptr);
    EXPECT_GT(stopped, 200u);
    EXPECT_LT(stopped, 1000u) << "went on to the end";
    EXPECT_EQ(add_chunks(fields.data(), labels, {}, 0, nullptr), 0u);
  });
}

TEST_P(FastLookUpMemory, rows_bound_every_distance_from_below) {
  const Database& database = test_database(GetParam());
  for (const int size : kTinySizes) {
    const FieldRows& rows = database.field_rows(size);
    std::vector<uint16_t> sums(rows.block_count() * FieldRows::kBlock), minima(rows.block_count());
    for (int number = 0; number < kQueries; ++number) {
      const LabelImage query = hostile_query(database, size, number);
      add_rows(rows, rows.rows_of(query), sums, minima);
      const auto glove = static_cast<float>(query.size() - std::ranges::count(query, 0));
      for (int entry = 0; entry < database.entry_count(); entry += 7) {
        const long sum = std::lround(distance(database, entry, query) * glove * kFieldScale);
        ASSERT_LE(sums[entry], sum) << size << " px, entry " << entry;
        if (rows.exact()) {
          ASSERT_EQ(sums[entry], sum) << size << " px, entry " << entry;
        }
        ASSERT_EQ(std::min(65535u, rows.sum(entry, rows.rows_of(query))), sums[entry]);
      }
    }
  }
}

}  // namespace
}  // namespace glovebench
