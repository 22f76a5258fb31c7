#include "eval/sources/message_file.h"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/base/text.h"

namespace glovebench::eval {
namespace {

constexpr uint64_t kLargestChunk = uint64_t{12} << 20;

/// Returns the number of bytes; over `room`: damaged, or more than fits.
size_t unpack_lz4(std::string_view packed, std::string& room) {
  LZ4F_dctx* context = nullptr;
  check(LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) == 0, "lz4 has memory");
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(context,
                                                                                   &LZ4F_freeDecompressionContext);
  size_t written = 0, hint = 1;
  while (hint != 0) {
    size_t room_left = room.size() - written, bytes = packed.size();
    hint = LZ4F_decompress(context, room.data() + written, &room_left, packed.data(), &bytes, nullptr);
    if (LZ4F_isError(hint) != 0 || (hint != 0 && room_left == 0 && bytes == 0)) return room.size() + 1;
    written += room_left;
    packed.remove_prefix(bytes);
  }
  return written;
}

}  // namespace

std::string topic_name(std::string_view text, const std::string& where) {
  constexpr size_t kLongest = 256;
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; };
  if (text.size() > kLongest || std::ranges::any_of(text, is_control))
    throw Error(where, "topic", quoted_excerpt(text), fmt::format("a name of at most {} characters", kLongest));
  return std::string(text);
}

std::string_view unpack(const PackedChunk& chunk, uint64_t position, const std::string& where,
                        std::string& buffer) {
  const auto fail = [&](const std::string& found, const std::string& expected) {
    throw Error(where, fmt::format("chunk at byte {}", position), found, expected);
  };
  if (chunk.size > kLargestChunk)
    fail(fmt::format("{} bytes unpacked", chunk.size), fmt::format("at most {}", kLargestChunk));
  std::string_view records = chunk.packed;
  size_t size = records.size();
  if (chunk.compression == "zstd" || chunk.compression == "lz4") {
    buffer.resize(chunk.size);
    records = buffer;
    size = chunk.compression == "lz4"
               ? unpack_lz4(chunk.packed, buffer)
               : ZSTD_decompress(buffer.data(), buffer.size(), chunk.packed.data(), chunk.packed.size());
  } else if (!chunk.compression.empty()) {
    fail(quoted_excerpt(chunk.compression), "zstd, lz4 or no compression");
  }
  if (size != chunk.size) fail("damaged data", fmt::format("{} bytes", chunk.size));
  if (chunk.crc != 0 && crc32_z(0, reinterpret_cast<const Bytef*>(records.data()), records.size()) != chunk.crc)
    fail("damaged data", "its CRC");
  return records;
}

MessageFormat format_of(std::string_view file, const std::string& where) {
  for (const MessageFormat& format : {mcap_messages(), bag_messages()})
    if (file.starts_with(format.begin)) return format;
  throw Error(where, "content", "neither", "an MCAP file or a bag of ROS 1 (version 2.0)");
}

std::string_view MessageReader::at(const MessagePlace& place) {
  if (place.chunk == 0) return file_.substr(place.offset, place.size);
  if (kept_ != place.chunk) {
    kept_ = 0;
    records_ = unpack(format_.chunk(file_, place.chunk, where_), place.chunk, where_, buffer_);
    kept_ = place.chunk;
  }
  check(place.offset <= records_.size(), "a message lies in its chunk");
  return records_.substr(place.offset, place.size);
}

}  // namespace glovebench::eval
