#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace glovebench::eval {

/// Fields of an MCAP record, little-endian.
class McapBytes {
 public:
  template <typename Number>
  McapBytes& put(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  McapBytes& text(std::string_view text) {
    put(static_cast<uint32_t>(text.size()));
    return raw(text);
  }
  McapBytes& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  std::string record(uint8_t code) const {
    return McapBytes().put(code).put(static_cast<uint64_t>(bytes_.size())).bytes_ + bytes_;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

inline std::string mcap_topic(uint16_t number, std::string_view topic, std::string_view type,
                              std::string_view encoding = "cdr") {
  return McapBytes().put(number).text(type).text("ros2msg").text("").record(3) +
         McapBytes().put(number).put(number).text(topic).text(encoding).text("").record(4);
}

inline std::string mcap_message(uint16_t topic, std::string_view message) {
  return McapBytes().put(topic).put(uint32_t{0}).put(uint64_t{0}).put(uint64_t{0}).raw(message).record(5);
}

/// `size`: that the chunk claims to have.
inline std::string mcap_chunk(std::string_view compression, std::string_view packed, uint64_t size,
                              uint32_t crc = 0) {
  return McapBytes()
      .put(uint64_t{0})
      .put(uint64_t{0})
      .put(size)
      .put(crc)
      .text(compression)
      .put(static_cast<uint64_t>(packed.size()))
      .raw(packed)
      .record(6);
}

/// `records`: of the data.
inline std::string mcap_file(const std::string& records) {
  return "\x89MCAP0\r\n" + records + McapBytes().put(uint32_t{0}).record(15);
}

}  // namespace glovebench::eval
