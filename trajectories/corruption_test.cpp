// Damaged files must give Error or a valid object, never another exception or a crash.
#include <gmock/gmock.h>

#include <string>

#include "ci/build_paths.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/random.h"
#include "trajectories/formats/format.h"
#include "trajectories/posture_file.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {
namespace {

const std::string kCorruptedFolder = build_paths::source("trajectories/data");

struct Token {
  size_t begin;
  size_t length;
};

/// A maximal run of characters that are not separators.
Token random_token(const std::string& text, RandomStream& random) {
  constexpr const char* separators = " ,:[]{}\n";
  const size_t begin = text.find_first_not_of(separators, random.index(text.size()));
  if (begin == std::string::npos) return {0, 1};
  const size_t end = std::min(text.find_first_of(separators, begin), text.size());
  return {begin, end - begin};
}

std::string corrupted(std::string text, RandomStream& random) {
  const uint64_t damages = 1 + random.index(3);
  for (uint64_t d = 0; d < damages && !text.empty(); ++d) {
    const size_t at = random.index(text.size());
    switch (random.index(5)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text[at] = static_cast<char>(random.index(256));
        break;
      case 2:
        text.erase(at, 1 + random.index(20));
        break;
      case 3: {
        static const std::vector<std::string> tokens = {
            "NaN",      "null", "-1", "1e999", "[]", "{}", "\"\"", "-", "1e3", "true", "18446744073709551615",
            "\xff\xfe", "[[[["};
        const Token token = random_token(text, random);
        text.replace(token.begin, token.length, tokens[random.index(tokens.size())]);
        break;
      }
      default: {
        const Token from = random_token(text, random);
        const std::string copied = text.substr(from.begin, from.length);
        const Token to = random_token(text, random);
        text.replace(to.begin, to.length, copied);
      }
    }
  }
  return text;
}

struct Outcome {
  int refused = 0;
  int accepted = 0;
};

/// `parse` returns the canonical text of the object it made, which must be valid in turn.
template <typename Parse>
Outcome try_corruptions(const std::string& text, const std::string& kind, int count, Parse parse) {
  Outcome outcome;
  for (int i = 0; i < count; ++i) {
    RandomStream random(1, "corruption_test", i, kind);
    const std::string damaged = corrupted(text, random);
    try {
      parse(parse(damaged));
      ++outcome.accepted;
    } catch (const Error& e) {
      ++outcome.refused;
      EXPECT_THAT(e.what(), ::testing::HasSubstr("damaged")) << "the message names the file";
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    } catch (const std::exception& e) {
      ADD_FAILURE() << kind << " " << i << ": " << e.what();
    }
  }
  return outcome;
}

void expect_both(const Outcome& outcome) {
  EXPECT_GT(outcome.refused, 0);
  EXPECT_GT(outcome.accepted, 0);  // a changed digit is another valid file: the damage reaches the values
}

TEST(Corruption, of_trajectories) {
  Trajectory trajectory = load_trajectory(kCorruptedFolder + "/sources/Tr1.json");
  trajectory.frames.resize(6);
  expect_both(try_corruptions(canonical_text(trajectory), "trajectory", 3000, [](const std::string& text) {
    return canonical_text(parse_trajectory(text, "damaged"));
  }));
}

TEST(Corruption, of_posture_sets) {
  const std::string text = read_file(kCorruptedFolder + "/postures/DB_open_pinch.json");
  expect_both(try_corruptions(text, "postures", 2000, [](const std::string& damaged) {
    return canonical_text(parse_postures_json(damaged, "damaged"));
  }));
}

TEST(Corruption, of_posture_tables) {
  const std::string text = read_file(kCorruptedFolder + "/gestures.csv");
  const auto parse = [](const std::string& damaged) {
    const PostureSet set = parse_postures_csv(damaged, "gestures", "damaged");
    parse_postures_json(canonical_text(set), "damaged");
    return damaged;
  };
  expect_both(try_corruptions(text, "table", 2000, parse));
}

}  // namespace
}  // namespace glovebench::trajectories
