#include "eval/frame_formats/mcap_writer.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <bit>

#include "core/base/error.h"
#include "eval/program.h"

namespace glovebench::eval {
namespace {

static_assert(std::endian::native == std::endian::little, "MCAP is little-endian");

constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);
constexpr size_t kChunkBytes = size_t{4} << 20;
constexpr int kZstdLevel = 1;  // camera noise does not compress: higher levels save 2%

enum class Op : uint8_t {
  header = 0x01,
  footer,
  schema,
  channel,
  message,
  chunk,
  message_index,
  chunk_index,
  statistics = 0x0b,
  metadata,
  metadata_index,
  summary_offset,
  data_end
};

/// Fields of a record.
class Fields {
 public:
  template <typename Integer>
  Fields& put(Integer value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  Fields& text(std::string_view text) {
    put(static_cast<uint32_t>(text.size()));
    bytes_ += text;
    return *this;
  }
  /// A list or map, after its length in bytes.
  Fields& nested(const Fields& fields) { return text(fields.bytes_); }
  Fields& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  std::string record(Op op) const {
    return Fields().put(op).put(static_cast<uint64_t>(bytes_.size())).bytes_ + bytes_;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

Fields map_of(const McapMetadata& texts) {
  Fields fields;
  for (const auto& [key, value] : texts) fields.text(key).text(value);
  return fields;
}

Fields map_of(const std::map<uint16_t, uint64_t>& values) {
  Fields fields;
  for (const auto& [channel, value] : values) fields.put(channel).put(value);
  return fields;
}

std::string zstd_compressed(std::string_view bytes) {
  std::string compressed(ZSTD_compressBound(bytes.size()), '\0');
  const size_t size = ZSTD_compress(compressed.data(), compressed.size(), bytes.data(), bytes.size(), kZstdLevel);
  check(ZSTD_isError(size) == 0, "a chunk can be compressed");
  compressed.resize(size);
  return compressed;
}

unsigned long crc_of(unsigned long crc, std::string_view bytes) {
  return crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

}  // namespace

McapWriter::McapWriter(const std::string& path, std::vector<McapChannel> channels)
    : file_(path), channels_(std::move(channels)) {
  append(kMcapMagic);
  append(Fields().text("ros2").text("glovebench " + program_info().version).record(Op::header));
  append(schemas_and_channels());
}

void McapWriter::append(std::string_view bytes) {
  file_.append(bytes);
  offset_ += bytes.size();
  crc_ = crc_of(crc_, bytes);
}

std::string McapWriter::schemas_and_channels() const {
  std::string records;
  std::vector<std::string> known;
  for (size_t c = 0; c < channels_.size(); ++c) {
    const McapChannel& channel = channels_[c];
    auto found = std::ranges::find(known, channel.schema);
    const auto schema = static_cast<uint16_t>(found - known.begin() + 1);  // 0 is none
    if (found == known.end()) {
      known.push_back(channel.schema);
      records +=
          Fields().put(schema).text(channel.schema).text("ros2msg").text(channel.definition).record(Op::schema);
    }
    records += Fields()
                   .put(static_cast<uint16_t>(c))
                   .put(schema)
                   .text(channel.topic)
                   .text("cdr")
                   .nested(Fields())
                   .record(Op::channel);
  }
  return records;
}

void McapWriter::write(size_t channel, int64_t time_us, std::string_view message) {
  check(channel < channels_.size() && time_us >= 0, "a message has a channel and a time");
  const auto id = static_cast<uint16_t>(channel);
  const uint64_t time_ns = static_cast<uint64_t>(time_us) * 1000;
  if (chunk_.empty()) open_.begin_ns = open_.end_ns = time_ns;
  open_.begin_ns = std::min(open_.begin_ns, time_ns);
  open_.end_ns = std::max(open_.end_ns, time_ns);
  entries_[id][time_ns].push_back(chunk_.size());
  const auto sequence = static_cast<uint32_t>(message_counts_[id]++);
  chunk_ += Fields().put(id).put(sequence).put(time_ns).put(time_ns).raw(message).record(Op::message);
  if (chunk_.size() >= kChunkBytes) finish_chunk();
}

void McapWriter::finish_chunk() {
  if (chunk_.empty()) return;
  const std::string compressed = zstd_compressed(chunk_);
  open_.offset = offset_;
  open_.compressed = compressed.size();
  open_.uncompressed = chunk_.size();
  append(Fields()
             .put(open_.begin_ns)
             .put(open_.end_ns)
             .put(open_.uncompressed)
             .put(static_cast<uint32_t>(crc_of(0, chunk_)))
             .text("zstd")
             .put(open_.compressed)
             .raw(compressed)
             .record(Op::chunk));
  open_.length = offset_ - open_.offset;
  const uint64_t begin = offset_;
  for (const auto& [channel, times] : entries_) {
    Fields messages;
    for (const auto& [time_ns, places] : times)
      for (const uint64_t place : places) messages.put(time_ns).put(place);
    open_.message_indexes[channel] = offset_;
    append(Fields().put(channel).nested(messages).record(Op::message_index));
  }
  open_.message_indexes_length = offset_ - begin;
  chunks_.push_back(std::move(open_));
  open_ = {};
  entries_.clear();
  chunk_.clear();
}

std::string McapWriter::statistics() const {
  uint64_t messages = 0, begin_ns = 0, end_ns = 0;
  for (const auto& [channel, count] : message_counts_) messages += count;
  if (!chunks_.empty()) begin_ns = std::ranges::min(chunks_, {}, &ChunkIndex::begin_ns).begin_ns;
  for (const ChunkIndex& chunk : chunks_) end_ns = std::max(end_ns, chunk.end_ns);
  std::vector<std::string> schemas;
  for (const McapChannel& channel : channels_) schemas.push_back(channel.schema);
  std::ranges::sort(schemas);
  const auto end = std::unique(schemas.begin(), schemas.end());
  constexpr uint32_t kAttachments = 0, kMetadata = 1;
  return Fields()
      .put(messages)
      .put(static_cast<uint16_t>(end - schemas.begin()))
      .put(static_cast<uint32_t>(channels_.size()))
      .put(kAttachments)
      .put(kMetadata)
      .put(static_cast<uint32_t>(chunks_.size()))
      .put(begin_ns)
      .put(end_ns)
      .nested(map_of(message_counts_))
      .record(Op::statistics);
}

void McapWriter::finish(const McapMetadata& metadata) {
  finish_chunk();
  const uint64_t metadata_offset = offset_;
  append(Fields().text("glovebench").nested(map_of(metadata)).record(Op::metadata));
  const uint64_t metadata_length = offset_ - metadata_offset;
  append(Fields().put(static_cast<uint32_t>(crc_)).record(Op::data_end));

  const uint64_t summary = offset_;
  crc_ = 0;
  append(schemas_and_channels() + statistics());
  for (const ChunkIndex& chunk : chunks_)
    append(Fields()
               .put(chunk.begin_ns)
               .put(chunk.end_ns)
               .put(chunk.offset)
               .put(chunk.length)
               .nested(map_of(chunk.message_indexes))
               .put(chunk.message_indexes_length)
               .text("zstd")
               .put(chunk.compressed)
               .put(chunk.uncompressed)
               .record(Op::chunk_index));
  append(Fields().put(metadata_offset).put(metadata_length).text("glovebench").record(Op::metadata_index));
  // The CRC covers the summary and the footer up to itself.
  constexpr uint64_t kNoSummaryOffsets = 0;
  const Fields places = Fields().put(summary).put(kNoSummaryOffsets);
  constexpr uint32_t kUnknown = 0;
  const std::string footer = Fields(places).put(kUnknown).record(Op::footer);
  const unsigned long crc = crc_of(crc_, std::string_view(footer).substr(0, footer.size() - sizeof(uint32_t)));
  append(Fields(places).put(static_cast<uint32_t>(crc)).record(Op::footer));
  append(kMcapMagic);
  file_.commit();
}

}  // namespace glovebench::eval
