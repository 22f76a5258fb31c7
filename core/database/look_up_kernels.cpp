#include "core/database/look_up_kernels.h"

#include <algorithm>

// This file is compiled once for each instruction set, but not for those whose vectors have no size in a program.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/database/look_up_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glovebench::HWY_NAMESPACE {

constexpr size_t kBlock = FieldRows::kBlock;
/// Chunks between two looks at the limit.
constexpr size_t kStride = 16;

#if HWY_TARGET == HWY_SCALAR
// The lowest that this Highway writes by hand is SSSE3; below it the compiler's own SSE2 does better than single
// lanes.

void add_block_unweighted(const uint8_t* block, const uint8_t* next, std::span<const WeightedRow> rows,
                          size_t rows_in_a_byte, uint16_t* sums, uint16_t* least) {
  std::fill_n(sums, kBlock, uint16_t{0});
  for (size_t first = 0; first < rows.size(); first += rows_in_a_byte) {
    const size_t last = std::min(rows.size(), first + rows_in_a_byte);
    uint8_t part[kBlock] = {};
    for (size_t r = first; r < last; ++r) {
      const uint8_t* const row = block + rows[r].row * kBlock;
      hwy::Prefetch(next + rows[r].row * kBlock);
      for (size_t i = 0; i < kBlock; ++i) part[i] = static_cast<uint8_t>(part[i] + row[i]);
    }
    for (size_t i = 0; i < kBlock; ++i) sums[i] = static_cast<uint16_t>(sums[i] + part[i]);  // exact: no overflow
  }
  *least = *std::min_element(sums, sums + kBlock);
}

void add_block_weighted(const uint8_t* block, const uint8_t* next, std::span<const WeightedRow> rows,
                        uint16_t* sums, uint16_t* least) {
  uint16_t total[kBlock] = {};
  for (const WeightedRow& weighted : rows) {
    const uint8_t* const row = block + weighted.row * kBlock;
    hwy::Prefetch(next + weighted.row * kBlock);
    for (size_t i = 0; i < kBlock; ++i) {
      const auto value = static_cast<uint16_t>(row[i] * weighted.weight);
      const auto sum = static_cast<uint16_t>(total[i] + value);
      total[i] = static_cast<uint16_t>(sum | -(sum < value));  // 65535 after an overflow
    }
  }
  std::copy_n(total, kBlock, sums);
  *least = *std::min_element(total, total + kBlock);
}

/// Of a whole chunk.
uint32_t add_chunk(const uint8_t* fields, const uint8_t* labels, const FieldChunk& chunk) {
  uint32_t sum = 0;
  for (size_t i = 0; i < QueryLabels::kChunk; ++i)
    sum += labels[chunk.pixels + i] == chunk.color ? fields[chunk.field + i] : uint8_t{0};
  return sum;
}

uint32_t add_stride(const uint8_t* fields, const uint8_t* labels, std::span<const FieldChunk> chunks,
                    const uint8_t* next) {
  uint32_t sum = 0;
  for (const FieldChunk& chunk : chunks) {
    if (next != nullptr) hwy::Prefetch(next + chunk.field);
    sum += add_chunk(fields, labels, chunk);
  }
  return sum;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<uint8_t> kBytes;
constexpr hn::ScalableTag<uint16_t> kWords;
constexpr hn::Half<decltype(kBytes)> kHalfBytes;
using Bytes = hn::VFromD<decltype(kBytes)>;
using Words = hn::VFromD<decltype(kWords)>;

constexpr size_t kByteVectors = kBlock / hn::MaxLanes(kBytes);
constexpr size_t kWordVectors = kBlock / hn::MaxLanes(kWords);

void store_sums(const Words (&total)[kWordVectors], uint16_t* sums, uint16_t* least) {
  Words minimum = total[0];
  for (size_t i = 0; i < kWordVectors; ++i) {
    hn::StoreU(total[i], kWords, sums + i * hn::Lanes(kWords));
    minimum = hn::Min(minimum, total[i]);
  }
  *least = hn::GetLane(hn::MinOfLanes(kWords, minimum));
}

/// Rows that all count once: as many as fit are added in bytes before they are widened.
void add_block_unweighted(const uint8_t* block, const uint8_t* next, std::span<const WeightedRow> rows,
                          size_t rows_in_a_byte, uint16_t* sums, uint16_t* least) {
  Words total[kWordVectors];
  for (Words& t : total) t = hn::Zero(kWords);
  for (size_t first = 0; first < rows.size(); first += rows_in_a_byte) {
    const size_t last = std::min(rows.size(), first + rows_in_a_byte);
    Bytes part[kByteVectors];
    for (Bytes& p : part) p = hn::Zero(kBytes);
    for (size_t r = first; r < last; ++r) {
      const uint8_t* const row = block + rows[r].row * kBlock;
      hwy::Prefetch(next + rows[r].row * kBlock);
      for (size_t i = 0; i < kByteVectors; ++i)
        part[i] = hn::Add(part[i], hn::Load(kBytes, row + i * hn::Lanes(kBytes)));
    }
    for (size_t i = 0; i < kByteVectors; ++i) {
      total[2 * i] = hn::SaturatedAdd(total[2 * i], hn::PromoteTo(kWords, hn::LowerHalf(kHalfBytes, part[i])));
      total[2 * i + 1] =
          hn::SaturatedAdd(total[2 * i + 1], hn::PromoteTo(kWords, hn::UpperHalf(kHalfBytes, part[i])));
    }
  }
  store_sums(total, sums, least);
}

void add_block_weighted(const uint8_t* block, const uint8_t* next, std::span<const WeightedRow> rows,
                        uint16_t* sums, uint16_t* least) {
  Words total[kWordVectors];
  for (Words& t : total) t = hn::Zero(kWords);
  for (const WeightedRow& weighted : rows) {
    const uint8_t* const row = block + weighted.row * kBlock;
    hwy::Prefetch(next + weighted.row * kBlock);
    const Words weight = hn::Set(kWords, weighted.weight);
    for (size_t i = 0; i < kWordVectors; ++i) {
      const Words values = hn::PromoteTo(kWords, hn::Load(kHalfBytes, row + i * hn::Lanes(kWords)));
      total[i] = hn::SaturatedAdd(total[i], hn::Mul(values, weight));
    }
  }
  store_sums(total, sums, least);
}

uint32_t add_stride(const uint8_t* fields, const uint8_t* labels, std::span<const FieldChunk> chunks,
                    const uint8_t* next) {
  constexpr hn::ScalableTag<uint64_t> kLongs;
  auto sums = hn::Zero(kLongs);
  for (const FieldChunk& chunk : chunks) {
    if (next != nullptr) hwy::Prefetch(next + chunk.field);
    const Bytes color = hn::Set(kBytes, chunk.color);
    for (size_t i = 0; i < QueryLabels::kChunk; i += hn::Lanes(kBytes)) {
      const auto is_read = hn::Eq(hn::Load(kBytes, labels + chunk.pixels + i), color);
      const Bytes read = hn::IfThenElseZero(is_read, hn::LoadU(kBytes, fields + chunk.field + i));
      sums = hn::Add(sums, hn::SumsOf8(read));
    }
  }
  return static_cast<uint32_t>(hn::GetLane(hn::SumOfLanes(kLongs, sums)));
}

#endif

void AddRows(const FieldRows& field_rows, std::span<const WeightedRow> rows, uint16_t* sums,
             uint16_t* block_minima) {
  const size_t rows_in_a_byte = 255 / std::max<size_t>(1, field_rows.largest_value());
  const size_t last = field_rows.block_count() - 1;
  for (size_t b = 0; b <= last; ++b) {
    const uint8_t* const block = field_rows.data() + b * field_rows.block_bytes();
    const uint8_t* const next = b < last ? block + field_rows.block_bytes() : block;
    if (field_rows.exact())
      add_block_unweighted(block, next, rows, rows_in_a_byte, sums + b * kBlock, block_minima + b);
    else
      add_block_weighted(block, next, rows, sums + b * kBlock, block_minima + b);
  }
}

uint32_t AddChunks(const uint8_t* fields, const uint8_t* labels, std::span<const FieldChunk> chunks, uint32_t limit,
                   const uint8_t* next) {
  uint32_t total = 0;
  while (!chunks.empty()) {
    const size_t count = std::min(chunks.size(), kStride);
    total += add_stride(fields, labels, chunks.first(count), next);
    if (total > limit) return total;
    chunks = chunks.subspan(count);
  }
  return total;
}

}  // namespace glovebench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "core/base/error.h"

namespace glovebench {
namespace {
HWY_EXPORT(AddRows);
HWY_EXPORT(AddChunks);
}  // namespace

void add_rows(const FieldRows& field_rows, std::span<const WeightedRow> rows, std::span<uint16_t> sums,
              std::span<uint16_t> block_minima) {
  check(sums.size() == field_rows.block_count() * FieldRows::kBlock &&
            block_minima.size() == field_rows.block_count() && !block_minima.empty(),
        "the sums of whole blocks");
  HWY_DYNAMIC_DISPATCH(AddRows)(field_rows, rows, sums.data(), block_minima.data());
}

uint32_t add_chunks(const uint8_t* fields, const QueryLabels& query, std::span<const FieldChunk> chunks,
                    uint32_t limit, const uint8_t* next) {
  return HWY_DYNAMIC_DISPATCH(AddChunks)(fields, query.labels, chunks, limit, next);
}

}  // namespace glovebench
#endif
