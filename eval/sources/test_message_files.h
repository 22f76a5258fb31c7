#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace glovebench::eval {

/// Fields of records and of messages of ROS 1, little-endian.
class FieldBytes {
 public:
  template <typename Number>
  FieldBytes& put(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  FieldBytes& text(std::string_view text) {
    put(static_cast<uint32_t>(text.size()));
    return raw(text);
  }
  FieldBytes& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  std::string record(uint8_t code) const {
    return FieldBytes().put(code).put(static_cast<uint64_t>(bytes_.size())).bytes_ + bytes_;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

inline std::string mcap_topic(uint16_t number, std::string_view topic, std::string_view type,
                              std::string_view encoding = "cdr") {
  return FieldBytes().put(number).text(type).text("ros2msg").text("").record(3) +
         FieldBytes().put(number).put(number).text(topic).text(encoding).text("").record(4);
}

inline std::string mcap_message(uint16_t topic, std::string_view message) {
  return FieldBytes().put(topic).put(uint32_t{0}).put(uint64_t{0}).put(uint64_t{0}).raw(message).record(5);
}

/// `size`: as the chunk claims.
inline std::string mcap_chunk(std::string_view compression, std::string_view packed, uint64_t size,
                              uint32_t crc = 0) {
  return FieldBytes()
      .put(uint64_t{0})
      .put(uint64_t{0})
      .put(size)
      .put(crc)
      .text(compression)
      .put(static_cast<uint64_t>(packed.size()))
      .raw(packed)
      .record(6);
}

inline std::string mcap_file(const std::string& records) {
  return "\x89MCAP0\r\n" + records + FieldBytes().put(uint32_t{0}).record(15);
}

inline std::string bag_field(const std::string& name, std::string_view value) {
  return FieldBytes().text(name + "=" + std::string(value)).bytes();
}
template <typename Number>
std::string bag_number(const std::string& name, Number value) {
  return bag_field(name, FieldBytes().put(value).bytes());
}
inline std::string bag_record(uint8_t code, const std::string& fields, std::string_view data) {
  return FieldBytes().text(fields + bag_number("op", code)).text(data).bytes();
}
inline std::string bag_topic(uint32_t number, std::string_view topic, std::string_view type) {
  return bag_record(7, bag_number("conn", number) + bag_field("topic", topic),
                    bag_field("topic", topic) + bag_field("type", type));
}
inline std::string bag_message(uint32_t topic, std::string_view message) {
  return bag_record(2, bag_number("conn", topic) + bag_number("time", uint64_t{0}), message);
}
inline std::string bag_chunk(std::string_view compression, std::string_view packed, uint32_t size) {
  return bag_record(5, bag_field("compression", compression) + bag_number("size", size), packed);
}
/// `is_closed`: has an index.
inline std::string bag_file(const std::string& records, bool is_closed = true) {
  const auto begin = [](uint64_t index) {
    return bag_record(3, bag_number("index_pos", index), std::string(100, ' '));
  };
  const std::string start = "#ROSBAG V2.0\n";
  const uint64_t index = start.size() + begin(0).size() + records.size();
  return start + begin(is_closed ? index : 0) + records + bag_record(6, "", "");
}

}  // namespace glovebench::eval
