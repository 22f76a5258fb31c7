#include <fmt/format.h>

#include <map>

#include "eval/sources/field_reader.h"
#include "eval/sources/message_file.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kBagBegin = "#ROSBAG V2.0\n";
constexpr const char* kWholeBag = "a whole bag (`rosbag reindex` mends one that was not closed)";

enum class BagCode : uint8_t { message = 2, begin = 3, chunk = 5, connection = 7 };

/// Fields "name=value", each after its length.
class BagFields {
 public:
  BagFields(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  std::string_view text(std::string_view name) const {
    FieldReader reader(bytes_, where_, field_);
    while (reader.left() > 0) {
      const std::string_view field = reader.text();
      if (field.size() > name.size() && field.starts_with(name) && field[name.size()] == '=')
        return field.substr(name.size() + 1);
    }
    reader.fail(fmt::format("no {}", name), "one");
  }
  template <typename Number>
  Number number(std::string_view name) const {
    const std::string_view value = text(name);
    FieldReader reader(value, where_, field_);
    return reader.number<Number>();
  }

 private:
  std::string_view bytes_;
  const std::string& where_;
  inline static const std::string field_ = "record";
};

struct BagRecord {
  BagFields fields;
  BagCode code;
  std::string_view data;
};
BagRecord next_bag_record(FieldReader& reader, const std::string& where) {
  const auto part = [&] {
    const uint32_t size = reader.left() < sizeof(uint32_t) ? UINT32_MAX : reader.number<uint32_t>();
    if (size > reader.left()) reader.fail("the end", kWholeBag);
    return reader.take(size);
  };
  const BagFields fields(part(), where);
  return {fields, fields.number<BagCode>("op"), part()};
}

template <typename UseRecord>
void for_each_bag_record(std::string_view records, const std::string& where, const UseRecord& use) {
  static const std::string field = "records";
  FieldReader reader(records, where, field);
  while (reader.left() > 0) {
    const uint64_t position = reader.position();
    use(next_bag_record(reader, where), position);
  }
}

PackedChunk bag_chunk_in(const BagRecord& record) {
  PackedChunk chunk;
  chunk.compression = record.fields.text("compression");
  if (chunk.compression == "none") chunk.compression = "";
  chunk.packed = record.data;
  chunk.size = record.fields.number<uint32_t>("size");
  return chunk;
}

void for_each_bag_message(std::string_view file, const std::string& where, const UseMessage& use) {
  std::map<uint32_t, MessageTopic> topics;
  std::string buffer;
  const auto use_record = [&](const BagRecord& record, uint64_t chunk, const char* begin) {
    if (record.code != BagCode::connection && record.code != BagCode::message) return;
    const auto connection = record.fields.number<uint32_t>("conn");
    if (record.code == BagCode::connection) {
      const BagFields about(record.data, where);
      topics.try_emplace(connection, MessageTopic{topic_name(record.fields.text("topic"), where),
                                                  topic_name(about.text("type"), where), "ros1"});
      if (topics.size() > kMostTopics)
        throw Error(where, "connections", fmt::format("over {}", kMostTopics),
                    fmt::format("at most {}", kMostTopics));
      return;
    }
    const auto topic = topics.find(connection);
    if (topic == topics.end())
      throw Error(where, "message", fmt::format("connection {}", connection), "its connection before it");
    use(topic->second, {chunk, static_cast<uint64_t>(record.data.data() - begin), record.data.size()}, record.data);
  };
  for_each_bag_record(file.substr(kBagBegin.size()), where, [&](const BagRecord& record, uint64_t offset) {
    if (record.code == BagCode::begin) {
      const auto index = record.fields.number<uint64_t>("index_pos");
      if (index == 0 || index >= file.size()) throw Error(where, "index", "none", kWholeBag);
    }
    if (record.code != BagCode::chunk) return use_record(record, 0, file.data());
    const uint64_t position = kBagBegin.size() + offset;
    const std::string_view records = unpack(bag_chunk_in(record), position, where, buffer);
    for_each_bag_record(records, where,
                        [&](const BagRecord& inner, uint64_t) { use_record(inner, position, records.data()); });
  });
}

PackedChunk bag_chunk_at(std::string_view file, uint64_t position, const std::string& where) {
  static const std::string field = "records";
  FieldReader reader(file.substr(position), where, field);
  return bag_chunk_in(next_bag_record(reader, where));
}

}  // namespace

MessageFormat bag_messages() { return {"bag", kBagBegin, for_each_bag_message, bag_chunk_at}; }

}  // namespace glovebench::eval
