#include "eval/sources/oni_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/adapters/openni2/oni_player.h"
#include "core/base/error.h"
#include "core/base/mapped_memory.h"
#include "core/base/text.h"
#include "core/kinect/frame_pairer.h"
#include "eval/sources/field_reader.h"
#include "eval/sources/paired_recording.h"
#include "eval/sources/source.h"
#include "eval/terminal.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kOniBegin = "NI10";
constexpr uint32_t kRecordBegin = 0x52494E;                  // "NIR" and a zero
constexpr uint32_t kRecordHead = 28, kMostFields = 1 << 16;  // bytes
constexpr uint32_t kMostNodes = 100;
constexpr uint32_t kLargestImage = 1600 * 1200 * 3;  // bytes, of OpenNI2's player
constexpr size_t kMostOniImages = 108'000;           // of a kind: an hour
constexpr uint64_t kLatest_us = 10'000'000'000'000'000;

enum OniRecordType : uint32_t {
  kIntProperty = 3,
  kGeneralProperty = 6,
  kNewData = 10,
  kEnd = 11,
  kNodeAdded = 13,
  kSeekTable = 14
};
enum OniNodeType : uint32_t { kDepthNode = 2, kColorNode = 3 };

class OniWalk {
 public:
  OniWalk(std::string_view file, const std::string& where) : file_(file), where_(where) {}

  OniTimes times() {
    head();
    while (record()) {
    }
    for (const uint64_t position : seek_tables_wanted_)
      if (!std::ranges::binary_search(seek_tables_, position))
        throw Error(where_, "seek table", fmt::format("none at byte {}", position), "one");
    return std::move(times_);
  }

 private:
  void head() {
    if (!file_.starts_with(kOniBegin))
      throw Error(where_, "first bytes", quoted_excerpt(file_.substr(0, kOniBegin.size())),
                  "\"NI10\" of a recording of OpenNI2's recorder");
    const std::string field = "head";
    FieldReader head(file_, where_, field);
    head.take(kOniBegin.size());
    const int major = head.number<uint8_t>(), minor = head.number<uint8_t>(), patch = head.number<uint16_t>();
    head.number<uint32_t>();  // build
    if (major != 1 || minor != 0 || patch != 1)
      throw Error(where_, "version", fmt::format("{}.{}.{}", major, minor, patch), "1.0.1");
    head.number<uint64_t>();  // largest time
    if (const auto node = head.number<uint32_t>(); node > kMostNodes)
      head.fail(fmt::format("node {}", node), fmt::format("{} at most", kMostNodes));
    position_ = head.position();
  }

  /// False at the end.
  bool record() {
    const std::string field = fmt::format("record at byte {}", position_);
    FieldReader record(file_.substr(position_), where_, field);
    const auto begin = record.number<uint32_t>(), type = record.number<uint32_t>(),
               node = record.number<uint32_t>(), size = record.number<uint32_t>(),
               payload = record.number<uint32_t>();
    record.number<uint64_t>();  // earlier record
    if (begin != kRecordBegin || type < kIntProperty || type > kSeekTable || node > kMostNodes ||
        size < kRecordHead || size > kMostFields)
      record.fail("damaged data", "a record");
    FieldReader fields(record.take(size - kRecordHead), where_, field);
    record.take(payload);
    if (type <= kGeneralProperty) skip_name(fields);
    if (type == kNodeAdded) add_node(node, fields);
    if (type == kNewData) add_image(node, fields, payload);
    if (type == kSeekTable) seek_tables_.push_back(position_);
    position_ += record.position();
    return type != kEnd;
  }
  /// OpenNI2 indexes an array by these characters.
  static void skip_name(FieldReader& fields) {
    const std::string_view name = fields.text();
    const auto is_plain = [](char c) { return c >= ' ' && c <= '~'; };
    if (name.empty() || name.back() != '\0' || !std::all_of(name.begin(), name.end() - 1, is_plain))
      fields.fail("damaged data", "a name");
  }
  void add_node(uint32_t node, FieldReader& fields) {
    skip_name(fields);
    nodes_[node] = fields.number<uint32_t>();
    fields.number<uint32_t>();  // codec
    fields.number<uint32_t>();  // images
    fields.number<uint64_t>();  // first time
    fields.number<uint64_t>();  // last time
    if (const auto position = fields.number<uint64_t>(); position != 0) seek_tables_wanted_.push_back(position);
  }
  void add_image(uint32_t node, FieldReader& fields, uint32_t payload) {
    const auto time_us = fields.number<uint64_t>();
    fields.number<uint32_t>();  // number of the image
    if (payload > kLargestImage || time_us > kLatest_us) fields.fail("damaged data", "an image");
    if (nodes_[node] == kDepthNode) add_time(times_.depth_us, time_us, fields);
    if (nodes_[node] == kColorNode) add_time(times_.color_us, time_us, fields);
  }
  static void add_time(std::vector<int64_t>& times_us, uint64_t time_us, const FieldReader& fields) {
    if (times_us.size() == kMostOniImages) fields.fail(fmt::format("over {} images", kMostOniImages), "fewer");
    times_us.push_back(static_cast<int64_t>(time_us));
  }

  std::string_view file_;
  const std::string& where_;
  uint64_t position_ = 0;
  OniTimes times_;
  std::map<uint32_t, uint32_t> nodes_;  ///< types
  std::vector<uint64_t> seek_tables_, seek_tables_wanted_;
};

OniTimes oni_times_of(const std::string& path) {
  const MappedMemory memory = MappedMemory::of_file(path);
  return parse_oni_times({reinterpret_cast<const char*>(memory.bytes().data()), memory.bytes().size()}, path);
}

TrackSource open_oni_source(const std::string& path, const SourceFlags& flags, bool quiet) {
  const OniTimes times = oni_times_of(path);
  const std::shared_ptr<OniPlayer> player = open_oni(path);
  const RgbdCalibration calibration =
      flags.calibration.empty() ? calibration_from_json(to_json(player->calibration()), path)  // checks it
                                : load_calibration(flags.calibration);
  if (flags.calibration.empty() && !quiet)
    say("glovebench: {}: depth counts as registered to color; if it is not, give --calibration\n", flags.source);
  RecordedImages images{times.depth_us, times.color_us,
                        [player, times](size_t i) {
                          return depth_in_m(player->depth_steps(times.depth_us[i]), player->steps_per_m());
                        },
                        [player, times](size_t i) { return player->color(times.color_us[i]); }};
  return paired_source(path, calibration, std::move(images), PairingRules().max_gap_us);
}

}  // namespace

OniTimes parse_oni_times(std::string_view file, const std::string& where) { return OniWalk(file, where).times(); }

SourceKind oni_source() { return {"oni", "oni:FILE", "of OpenNI2's recorder", open_oni_source}; }

}  // namespace glovebench::eval
