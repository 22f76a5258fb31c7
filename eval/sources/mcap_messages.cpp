#include <fmt/format.h>

#include <map>

#include "eval/sources/field_reader.h"
#include "eval/sources/message_file.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kMcapBegin("\x89MCAP0\r\n", 8);
constexpr uint64_t kMcapRecordHeader = 9;  // bytes: code, length
constexpr const char* kWholeMcap = "a whole file (`mcap recover` mends one that is cut off)";

enum class McapCode : uint8_t { footer = 2, schema, channel, message, chunk, data_end = 15 };

struct McapRecord {
  McapCode code;
  std::string_view content;
};
McapRecord next_mcap_record(FieldReader& reader) {
  if (reader.left() < kMcapRecordHeader) reader.fail("the end", kWholeMcap);
  const auto code = reader.number<McapCode>();
  const auto size = reader.number<uint64_t>();
  if (size > reader.left()) reader.fail(fmt::format("{} of {} bytes", reader.left(), size), kWholeMcap);
  return {code, reader.take(size)};
}

/// Schemas and channels by number, as far as they were read.
class McapTopics {
 public:
  explicit McapTopics(const std::string& where) : where_(where) {}

  void add_schema(std::string_view content) {
    FieldReader reader(content, where_, field_);
    const auto number = reader.number<uint16_t>();
    types_.try_emplace(number, topic_name(reader.text(), where_));
    require_few(types_.size());
  }
  void add_channel(std::string_view content) {
    FieldReader reader(content, where_, field_);
    const auto number = reader.number<uint16_t>();
    const auto type = types_.find(reader.number<uint16_t>());
    MessageTopic topic;
    topic.name = topic_name(reader.text(), where_);
    topic.encoding = topic_name(reader.text(), where_);
    if (type != types_.end()) topic.type = type->second;
    topics_.try_emplace(number, std::move(topic));
    require_few(topics_.size());
  }
  const MessageTopic& at(uint16_t number) const {
    const auto found = topics_.find(number);
    if (found == topics_.end())
      throw Error(where_, field_, fmt::format("a message of channel {}", number), "its channel before it");
    return found->second;
  }

 private:
  void require_few(size_t count) const {
    if (count > kMostTopics)
      throw Error(where_, field_, fmt::format("over {}", kMostTopics), fmt::format("at most {}", kMostTopics));
  }

  const std::string& where_;
  const std::string field_ = "channels";
  std::map<uint16_t, std::string> types_;
  std::map<uint16_t, MessageTopic> topics_;
};

/// Of the file or of a chunk. False if it has no record that ends the data.
template <typename UseRecord>
bool for_each_mcap_record(std::string_view records, const std::string& where, const UseRecord& use) {
  static const std::string field = "records";
  FieldReader reader(records, where, field);
  while (reader.left() > 0) {
    const uint64_t position = reader.position();
    const McapRecord record = next_mcap_record(reader);
    if (record.code == McapCode::data_end || record.code == McapCode::footer) return true;
    use(record, position);
  }
  return false;
}

PackedChunk mcap_chunk_in(std::string_view content, const std::string& where) {
  static const std::string field = "chunk";
  FieldReader reader(content, where, field);
  reader.take(2 * sizeof(uint64_t));  // times
  PackedChunk chunk;
  chunk.size = reader.number<uint64_t>();
  chunk.crc = reader.number<uint32_t>();
  chunk.compression = reader.text();
  chunk.packed = reader.take(reader.number<uint64_t>());
  return chunk;
}

void for_each_mcap_message(std::string_view file, const std::string& where, const UseMessage& use) {
  static const std::string field = "message";
  McapTopics topics(where);
  std::string buffer;
  const auto use_record = [&](const McapRecord& record, uint64_t chunk, const char* begin) {
    if (record.code == McapCode::schema) topics.add_schema(record.content);
    if (record.code == McapCode::channel) topics.add_channel(record.content);
    if (record.code != McapCode::message) return;
    FieldReader reader(record.content, where, field);
    const MessageTopic& topic = topics.at(reader.number<uint16_t>());
    reader.take(sizeof(uint32_t) + 2 * sizeof(uint64_t));  // sequence, times
    const std::string_view message = reader.take(reader.left());
    use(topic, {chunk, static_cast<uint64_t>(message.data() - begin), message.size()}, message);
  };
  const bool is_whole =
      for_each_mcap_record(file.substr(kMcapBegin.size()), where, [&](const McapRecord& record, uint64_t offset) {
        if (record.code != McapCode::chunk) return use_record(record, 0, file.data());
        const uint64_t position = kMcapBegin.size() + offset;
        const std::string_view records = unpack(mcap_chunk_in(record.content, where), position, where, buffer);
        for_each_mcap_record(records, where, [&](const McapRecord& inner, uint64_t) {
          use_record(inner, position, records.data());
        });
      });
  if (!is_whole) throw Error(where, "content", "no end of the data", kWholeMcap);
}

PackedChunk mcap_chunk_at(std::string_view file, uint64_t position, const std::string& where) {
  static const std::string field = "records";
  FieldReader reader(file.substr(position), where, field);
  return mcap_chunk_in(next_mcap_record(reader).content, where);
}

}  // namespace

MessageFormat mcap_messages() { return {"mcap", kMcapBegin, for_each_mcap_message, mcap_chunk_at}; }

}  // namespace glovebench::eval
