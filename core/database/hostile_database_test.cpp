// Files of databases whose checksums are right and whose content nobody made.

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "core/database/look_up.h"
#include "core/database/test_damaged_database.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::array kSizes = {8, 40};

class HostileFile : public testing::Test {
 protected:
  explicit HostileFile(DatabaseMemory memory)
      : good_(painted_database(memory, {8, 40})), layout_(layout_of(good_)), sections_(stored_sections(layout_)) {}

  const Section& section(const std::string& name) const {
    return *std::ranges::find(sections_, name, &Section::name);
  }
  /// Writes the file with these bytes in a section, and right hashes.
  void damage(const std::string& name, uint64_t place, std::string_view bytes) {
    std::string file = good_;
    file.replace(section(name).offset + place, bytes.size(), bytes);
    write_file(path_, with_right_hashes(file, layout_));
  }
  Database load() const { return Database::load(path_, kSizes); }
  void expect_refused(const std::string& name, const std::string& expected) const {
    EXPECT_THAT([&] { load(); }, ThrowsMessage<Error>(AllOf(HasSubstr(path_ + ": " + name + ": found "),
                                                            HasSubstr("expected " + expected))));
  }

  const TestFolder folder_;
  const std::string path_ = folder_ / "hostile.glovedb";
  const std::string good_;
  const DatabaseLayout layout_;
  const std::vector<Section> sections_;  ///< that the file holds
};

class HostileDatabase : public HostileFile, public testing::WithParamInterface<DatabaseMemory> {
 protected:
  HostileDatabase() : HostileFile(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(Memory, HostileDatabase, testing::Values(DatabaseMemory::normal, DatabaseMemory::low),
                         [](const auto& tested) { return std::string(to_string(tested.param)); });

class HostileNormalDatabase : public HostileFile {
 protected:
  HostileNormalDatabase() : HostileFile(DatabaseMemory::normal) {}
};
class HostileLowMemoryDatabase : public HostileFile {
 protected:
  HostileLowMemoryDatabase() : HostileFile(DatabaseMemory::low) {}
};

std::string bytes_of(const Eigen::Vector3d& v) {
  return {reinterpret_cast<const char*>(v.data()), sizeof(Eigen::Vector3d)};
}

TEST_P(HostileDatabase, with_right_hashes_is_the_good_one_again) {
  EXPECT_EQ(with_right_hashes(good_, layout_), good_);
  write_file(path_, good_);
  load().check();
}

TEST_P(HostileDatabase, a_ray_that_is_no_direction_to_a_hand_is_an_error) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), huge = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& ray :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0, 0, 1.001),
        Eigen::Vector3d(nan, 0, 1), Eigen::Vector3d(huge, 0, 1), Eigen::Vector3d(1, 0, 0)}) {
    damage("box_rays", 700 * sizeof(ray), bytes_of(ray));
    expect_refused("box_rays", "unit vectors");
  }
  damage("box_rays", 700 * sizeof(Eigen::Vector3d), bytes_of(Eigen::Vector3d(0.6, 0, 0.8)));
  load();
}

TEST_P(HostileDatabase, a_label_that_no_glove_has_is_an_error) {
  for (const char pair : {'\x0b', '\xb0', '\xff'}) {
    damage("labels_40", 5000, {&pair, 1});
    expect_refused("labels_40", "0 to 10");
  }
}

TEST_F(HostileNormalDatabase, with_a_distance_above_the_cap_is_an_error) {
  for (const std::string name : {"fields_8", "fields_40"}) {
    const uint8_t cap = field_cap(0.5, section(name).size_px);
    const char above = static_cast<char>(cap + 1), equal = static_cast<char>(cap);
    damage(name, section(name).bytes - 1, {&above, 1});
    expect_refused(name, "at most " + std::to_string(cap));
    damage(name, 0, {&equal, 1});
    load();
  }
}

TEST_P(HostileDatabase, a_byte_behind_a_section_is_an_error) {
  for (const Section& section : sections_) {
    damage(section.name(), section.bytes, "x");
    expect_refused("bytes behind " + section.name(), "0");
  }
}

TEST_P(HostileDatabase, a_posture_that_no_hand_has_is_an_error) {
  for (const std::string angle : {"9.9", "9e9"}) {
    std::string file = good_;
    const std::string from = "\"angles_rad\":[0.0,";
    file.replace(file.find(from) + from.size() - 4, 3, angle);
    write_file(path_, with_right_hashes(file, layout_));
    expect_refused("postures[0].angles_rad", "angles within the limits");
  }
}

TEST(HostileDatabaseHeader, two_postures_of_one_name_are_an_error) {
  DatabaseLayout layout({.postures = {"set", {"open", "open"}, {Posture::Zero(), Posture::Zero()}},
                         .side = Side::right,
                         .input_hash = "painted",
                         .memory = DatabaseMemory::low,
                         .field_cap_share = 0.5,
                         .sizes_px = {8}});
  MappedMemory file = MappedMemory::zeros(layout.bytes());
  auto* const rays = reinterpret_cast<Eigen::Vector3d*>(file.writable().data() + layout.box_rays().offset);
  std::fill_n(rays, 2 * kViewCount, Eigen::Vector3d::UnitZ());
  layout.seal(file);
  EXPECT_THAT([&] { DatabaseLayout(file.bytes(), "db"); },
              ThrowsMessage<Error>(HasSubstr("names of postures: found one twice")));
}

/// A query of each size, none of them an entry's image.
TinyImages queries(const Cascade& cascade, int number) {
  TinyImages query;
  for (const CascadeStage& stage : cascade) {
    LabelImage image(stage.size, stage.size);
    for (size_t i = 0; i < image.size(); ++i)
      image[i] = static_cast<uint8_t>(i * (number + 3) / 5 % (kColorCount + 1));
    query.images.push_back(std::move(image));
  }
  return query;
}

bool is_same_match(const Match& a, const Match& b) { return a.entry == b.entry && a.error == b.error; }

const std::vector<Cascade> kCascades = {{{40, 3}}, {{8, 3}}, {{8, 500}, {40, 3}}, {{8, 20}, {40, 3}}};

/// Both implementations give the same entries, which exist.
void expect_entries(const Database& database) {
  for (const Cascade& cascade : kCascades) {
    for (int number = 0; number < 8; ++number) {
      const TinyImages query = queries(cascade, number);
      const auto matches = look_up(database, query, cascade);
      ASSERT_TRUE(std::ranges::equal(matches, look_up(database, query, cascade, "plain"), is_same_match));
      for (const Match& match : matches) {
        ASSERT_GE(match.entry, 0);
        ASSERT_LT(match.entry, database.entry_count());
        ASSERT_TRUE(match.error >= 0 && match.error <= 64);
      }
    }
  }
}

TEST_F(HostileNormalDatabase, with_other_distances_gives_entries_that_exist_and_a_check_finds_it) {
  for (const std::string name : {"fields_8", "fields_40"}) {
    for (const uint64_t place : {uint64_t{0}, section(name).bytes - section(name).piece_bytes}) {
      damage(name, place, std::string(section(name).piece_bytes, '\0'));
      const Database damaged = load();
      expect_entries(damaged);
      EXPECT_THAT([&] { damaged.check(); },
                  ThrowsMessage<Error>(
                      AllOf(HasSubstr("DB_painted: " + name + ", entry "), HasSubstr("those of its labels"))));
    }
  }
}

TEST_P(HostileDatabase, other_bytes_in_any_section_are_another_content) {
  write_file(path_, good_);
  const std::string content = load().content_hash();
  for (const Section& section : sections_) {
    const char other = section.kind == Section::Kind::labels ? '\x21' : '\1';
    const std::string bytes =
        section.kind == Section::Kind::box_rays ? bytes_of({0.6, 0, 0.8}) : std::string(1, other);
    damage(section.name(), 0, bytes);
    EXPECT_NE(load().content_hash(), content) << section.name();
  }
  std::string file = good_;
  const std::string from = "\"angles_rad\":[0.0,";
  file.replace(file.find(from) + from.size() - 4, 3, "0.1");
  write_file(path_, with_right_hashes(file, layout_));
  EXPECT_NE(load().content_hash(), content);
}

TEST_F(HostileLowMemoryDatabase, with_other_labels_gives_entries_that_exist) {
  for (const std::string name : {"labels_8", "labels_40"}) {
    damage(name, 0, std::string(section(name).piece_bytes, '\x21'));
    expect_entries(load());
  }
}

TEST_F(HostileLowMemoryDatabase, that_states_the_hash_of_other_fields_is_an_error) {
  // That of a normal database with other distances: without this check two databases that give other matches would
  // have the same content.
  const std::string normal = painted_database(DatabaseMemory::normal, {8, 40});
  const DatabaseLayout layout = layout_of(normal);
  std::string other = normal, file = good_;
  other[layout.sizes().at(8).fields.offset] ^= 1;
  const std::string key = "\"fields_8\":\"", stated = with_right_hashes(other, layout);
  file.replace(file.find(key) + key.size(), 32, stated.substr(stated.find(key) + key.size(), 32));
  write_file(path_, with_right_header(file));
  expect_refused("fields_8 checksum", "");
}

}  // namespace
}  // namespace glovebench
