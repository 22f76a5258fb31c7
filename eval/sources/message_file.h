#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace glovebench::eval {

// Files of ROS messages in chunks, which may be compressed.

struct MessageTopic {
  std::string name;
  std::string type;      ///< "sensor_msgs/msg/Image"; of ROS 1 "sensor_msgs/Image"
  std::string encoding;  ///< of messages: "cdr", "ros1"
};
inline constexpr size_t kMostTopics = 4096;
/// Throws: Error for a long name or control characters.
std::string topic_name(std::string_view text, const std::string& where);

struct MessagePlace {
  uint64_t chunk = 0;   ///< position in the file; 0: the message is in no chunk
  uint64_t offset = 0;  ///< in the unpacked chunk, or in the file
  uint64_t size = 0;
};
using UseMessage =
    std::function<void(const MessageTopic& topic, const MessagePlace& place, std::string_view message)>;

struct PackedChunk {
  std::string_view compression;  ///< zstd, lz4, or empty
  std::string_view packed;
  uint64_t size = 0;  ///< unpacked, bytes
  uint32_t crc = 0;   ///< of the unpacked bytes; 0: unknown
};

struct MessageFormat {
  std::string_view name;
  std::string_view begin;  ///< of a file
  /// In the order of the file. A message is valid during the call.
  /// Throws: Error if the file is damaged, cut off or beyond the limits (core/README.md).
  void (*for_each)(std::string_view file, const std::string& where, const UseMessage& use);
  PackedChunk (*chunk)(std::string_view file, uint64_t position, const std::string& where);
};
/// https://mcap.dev/spec
MessageFormat mcap_messages();
/// Version 2.0, https://wiki.ros.org/Bags/Format/2.0
MessageFormat bag_messages();
/// By the first bytes.
/// Throws: Error.
MessageFormat format_of(std::string_view file, const std::string& where);

/// The records of a chunk: its own bytes, or `buffer`.
/// Throws: Error.
std::string_view unpack(const PackedChunk& chunk, uint64_t position, const std::string& where, std::string& buffer);

/// Reads single messages. Keeps the last chunk.
class MessageReader {
 public:
  /// `file` must live longer.
  MessageReader(std::string_view file, std::string where)
      : file_(file), where_(std::move(where)), format_(format_of(file, where_)) {}
  /// Valid until the next call. The place must come from `MessageFormat::for_each`.
  /// Throws: Error.
  std::string_view at(const MessagePlace& place);

 private:
  std::string_view file_;
  std::string where_;
  MessageFormat format_;
  uint64_t kept_ = 0;  ///< the chunk; 0: none
  std::string buffer_;
  std::string_view records_;
};

}  // namespace glovebench::eval
