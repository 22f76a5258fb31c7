#include "eval/sources/mcap_reader.h"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <map>
#include <memory>

#include "core/base/text.h"
#include "eval/sources/field_reader.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kMcapStart("\x89MCAP0\r\n", 8);
constexpr uint64_t kRecordHeader = 9;  // bytes: code, length
constexpr uint64_t kLargestChunk = uint64_t{12} << 20;
constexpr size_t kMostTopics = 4096, kLongestMcapName = 256;

constexpr const char* kWholeFile = "a whole file (`mcap recover` mends one that is cut off)";

enum class McapCode : uint8_t { footer = 2, schema, channel, message, chunk, data_end = 15 };

/// One after another.
struct McapRecord {
  McapCode code;
  std::string_view content;
};
McapRecord next_record(FieldReader& reader) {
  if (reader.left() < kRecordHeader) reader.fail("the end", kWholeFile);
  const auto code = reader.number<McapCode>();
  const auto size = reader.number<uint64_t>();
  if (size > reader.left()) reader.fail(fmt::format("{} of {} bytes", reader.left(), size), kWholeFile);
  return {code, reader.take(size)};
}

/// Schemas and channels by number, as far as they were read.
class McapTopics {
 public:
  explicit McapTopics(const std::string& where) : where_(where) {}

  void add_schema(std::string_view content) {
    FieldReader reader(content, where_, field_);
    const auto number = reader.number<uint16_t>();
    types_.try_emplace(number, name(reader));
    require_few(types_.size());
  }
  void add_channel(std::string_view content) {
    FieldReader reader(content, where_, field_);
    const auto number = reader.number<uint16_t>();
    const auto type = types_.find(reader.number<uint16_t>());
    std::string topic = name(reader), encoding = name(reader);
    topics_.try_emplace(number, McapTopic{std::move(topic), type != types_.end() ? type->second : std::string(),
                                          std::move(encoding)});
    require_few(topics_.size());
  }
  const McapTopic& at(uint16_t number) const {
    const auto found = topics_.find(number);
    if (found == topics_.end())
      throw Error(where_, field_, fmt::format("a message of channel {}", number), "its channel before it");
    return found->second;
  }

 private:
  static std::string name(FieldReader& reader) {
    const std::string_view text = reader.text();
    if (text.size() > kLongestMcapName)
      reader.fail(quoted_excerpt(text), fmt::format("a name of at most {} bytes", kLongestMcapName));
    return std::string(text);
  }
  void require_few(size_t count) const {
    if (count > kMostTopics)
      throw Error(where_, field_, fmt::format("over {}", kMostTopics), fmt::format("at most {}", kMostTopics));
  }

  const std::string& where_;
  const std::string field_ = "channels";
  std::map<uint16_t, std::string> types_;
  std::map<uint16_t, McapTopic> topics_;
};

void unpack_lz4(std::string_view packed, std::string& room, const FieldReader& reader) {
  LZ4F_dctx* context = nullptr;
  check(LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) == 0, "lz4 has memory");
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(context,
                                                                                   &LZ4F_freeDecompressionContext);
  size_t written = 0, hint = 1;
  while (hint != 0) {
    size_t room_left = room.size() - written, bytes = packed.size();
    hint = LZ4F_decompress(context, room.data() + written, &room_left, packed.data(), &bytes, nullptr);
    if (LZ4F_isError(hint) != 0 || (hint != 0 && room_left == 0 && bytes == 0))
      reader.fail("damaged lz4 data", fmt::format("{} bytes", room.size()));
    written += room_left;
    packed.remove_prefix(bytes);
  }
  if (written != room.size()) reader.fail(fmt::format("{} bytes", written), fmt::format("{}", room.size()));
}

/// The records of a chunk: a part of `content`, or `buffer`.
std::string_view unpack(std::string_view content, std::string& buffer, const std::string& where, uint64_t place) {
  const std::string field = fmt::format("chunk at byte {}", place);
  FieldReader reader(content, where, field);
  reader.take(2 * sizeof(uint64_t));  // times
  const auto size = reader.number<uint64_t>();
  const auto crc = reader.number<uint32_t>();
  const std::string_view compression = reader.text();
  const std::string_view packed = reader.take(reader.number<uint64_t>());
  if (size > kLargestChunk)
    reader.fail(fmt::format("{} bytes unpacked", size), fmt::format("at most {}", kLargestChunk));
  std::string_view records = packed;
  if (compression == "zstd" || compression == "lz4") {
    buffer.resize(size);
    if (compression == "lz4") unpack_lz4(packed, buffer, reader);
    if (compression == "zstd" && ZSTD_decompress(buffer.data(), size, packed.data(), packed.size()) != size)
      reader.fail("damaged zstd data", fmt::format("{} bytes", size));
    records = buffer;
  } else if (!compression.empty()) {
    reader.fail(quoted_excerpt(compression), "zstd, lz4 or no compression");
  }
  if (records.size() != size) reader.fail(fmt::format("{} bytes", records.size()), fmt::format("{}", size));
  if (crc != 0 && crc32_z(0, reinterpret_cast<const Bytef*>(records.data()), records.size()) != crc)
    reader.fail("damaged data", "its CRC");
  return records;
}

struct RawMessage {
  uint16_t channel;
  std::string_view message;
};
RawMessage raw_message(std::string_view content, const std::string& where) {
  static const std::string field = "message";
  FieldReader reader(content, where, field);
  const auto channel = reader.number<uint16_t>();
  reader.take(sizeof(uint32_t) + 2 * sizeof(uint64_t));  // sequence, times
  return {channel, reader.take(reader.left())};
}

/// Of the file or of a chunk. False if it has no record that ends the data.
template <typename UseRecord>
bool for_each_record(std::string_view records, const std::string& where, const UseRecord& use) {
  static const std::string field = "records";
  FieldReader reader(records, where, field);
  while (reader.left() > 0) {
    const uint64_t place = reader.position();
    const McapRecord record = next_record(reader);
    if (record.code == McapCode::data_end || record.code == McapCode::footer) return true;
    use(record, place);
  }
  return false;
}

}  // namespace

void for_each_message(std::string_view file, const std::string& where, const UseMessage& use) {
  if (!file.starts_with(kMcapStart)) throw Error(where, "content", "no MCAP file", "one");
  McapTopics topics(where);
  std::string buffer;
  const auto use_record = [&](const McapRecord& record, const McapPlace& place) {
    if (record.code == McapCode::schema) topics.add_schema(record.content);
    if (record.code == McapCode::channel) topics.add_channel(record.content);
    if (record.code != McapCode::message) return;
    const RawMessage raw = raw_message(record.content, where);
    use(topics.at(raw.channel), place, raw.message);
  };
  const bool is_whole =
      for_each_record(file.substr(kMcapStart.size()), where, [&](const McapRecord& record, uint64_t offset) {
        const uint64_t place = kMcapStart.size() + offset;
        if (record.code != McapCode::chunk) return use_record(record, {place, 0});
        for_each_record(unpack(record.content, buffer, where, place), where,
                        [&](const McapRecord& inner, uint64_t inner_offset) {
                          use_record(inner, {place, static_cast<uint32_t>(inner_offset)});
                        });
      });
  if (!is_whole) throw Error(where, "content", "no end of the data", kWholeFile);
}

std::string_view McapMessages::at(const McapPlace& place) {
  static const std::string field = "records";
  const auto record_at = [&](std::string_view records, uint64_t offset) {
    check(offset < records.size(), "a message lies in its chunk");
    FieldReader reader(records.substr(offset), where_, field);
    return next_record(reader);
  };
  if (kept_ != place.record) {
    kept_ = 0;
    const McapRecord record = record_at(file_, place.record);
    if (record.code == McapCode::message) return raw_message(record.content, where_).message;
    records_ = unpack(record.content, buffer_, where_, place.record);
    kept_ = place.record;
  }
  return raw_message(record_at(records_, place.offset).content, where_).message;
}

}  // namespace glovebench::eval
