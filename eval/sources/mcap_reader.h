#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace glovebench::eval {

// MCAP files, without their indexes and summary. Chunks may be plain, zstd or lz4.
// Format: https://mcap.dev/spec

struct McapTopic {
  std::string name;
  std::string type;      ///< "sensor_msgs/msg/Image"
  std::string encoding;  ///< of messages: "cdr"
};

/// Where a message lies.
struct McapPlace {
  uint64_t record = 0;  ///< position of the message or of its chunk in the file
  uint32_t offset = 0;  ///< of the message in the unpacked chunk
};

using UseMessage = std::function<void(const McapTopic& topic, const McapPlace& place, std::string_view message)>;
/// In the order of the file. `message` is valid during the call.
/// Throws: Error if the file is damaged or cut off, or exceeds the limits (core/README.md).
void for_each_message(std::string_view file, const std::string& where, const UseMessage& use);

/// Reads single messages. Keeps the last chunk.
class McapMessages {
 public:
  /// `file` must live longer.
  McapMessages(std::string_view file, std::string where) : file_(file), where_(std::move(where)) {}
  /// Valid until the next call. The place must come from `for_each_message`.
  /// Throws: Error.
  std::string_view at(const McapPlace& place);

 private:
  std::string_view file_;
  std::string where_;
  uint64_t kept_ = 0;         ///< place of `unpacked_`; 0: none
  std::string buffer_;        ///< of a compressed chunk
  std::string_view records_;  ///< of the chunk
};

}  // namespace glovebench::eval
