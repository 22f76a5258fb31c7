#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/whole_file.h"

namespace glovebench::eval {

struct McapChannel {
  std::string topic;
  std::string schema;      ///< name of the message type
  std::string definition;  ///< of `schema`, ROS 2
};
using McapMetadata = std::map<std::string, std::string>;

/// Writes an MCAP file of the profile "ros2", indexed and compressed by zstd. Holds one chunk in memory. The file
/// appears at `finish`.
/// Throws: Error, from every function.
/// Format: https://mcap.dev/spec
class McapWriter {
 public:
  McapWriter(const std::string& path, std::vector<McapChannel> channels);

  /// `channel`: index into `channels`. `message`: CDR.
  void write(size_t channel, int64_t time_us, std::string_view message);
  void finish(const McapMetadata& metadata);

 private:
  struct ChunkIndex {
    uint64_t begin_ns = 0, end_ns = 0;
    uint64_t offset = 0, length = 0;
    std::map<uint16_t, uint64_t> message_indexes;  ///< offsets by channel
    uint64_t message_indexes_length = 0;
    uint64_t compressed = 0, uncompressed = 0;  ///< bytes
  };

  void append(std::string_view bytes);
  void finish_chunk();
  std::string schemas_and_channels() const;
  std::string statistics() const;

  WholeFile file_;
  std::vector<McapChannel> channels_;
  uint64_t offset_ = 0;
  unsigned long crc_ = 0;  ///< of all bytes since the last section began
  std::string chunk_;
  ChunkIndex open_;
  std::map<uint16_t, std::map<uint64_t, std::vector<uint64_t>>> entries_;  ///< of the open chunk
  std::vector<ChunkIndex> chunks_;
  std::map<uint16_t, uint64_t> message_counts_;
};

}  // namespace glovebench::eval
