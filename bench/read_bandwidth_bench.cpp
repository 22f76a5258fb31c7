// How fast one core reads: what the time of a stage that does nothing but read could come to.

#include <algorithm>

#include "bench/bench_data.h"
#include "bench/speed_table.h"
#include "core/base/mapped_memory.h"

// This file is compiled once for each instruction set, but not for those whose vectors have no size in a program.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/read_bandwidth_bench.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glovebench::bench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Of all bytes, taken as numbers of eight bytes each; their number is a multiple of 1024.
uint64_t AddUp(const uint64_t* data, size_t count) {
  const hn::ScalableTag<uint64_t> tag;
  const size_t lanes = hn::Lanes(tag);
  auto a = hn::Zero(tag), b = a, c = a, d = a;  // independent: an addition does not wait for the one before
  for (size_t i = 0; i < count; i += 4 * lanes) {
    a = hn::Add(a, hn::Load(tag, data + i));
    b = hn::Add(b, hn::Load(tag, data + i + lanes));
    c = hn::Add(c, hn::Load(tag, data + i + 2 * lanes));
    d = hn::Add(d, hn::Load(tag, data + i + 3 * lanes));
  }
  return hn::GetLane(hn::SumOfLanes(tag, hn::Add(hn::Add(a, b), hn::Add(c, d))));
}

}  // namespace glovebench::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glovebench::bench {
namespace {
HWY_EXPORT(AddUp);

void read_bandwidth(benchmark::State& state, BytesTouched touched) {
  const auto bytes = static_cast<size_t>(touched.near + touched.far);
  MappedMemory memory = MappedMemory::zeros(bytes);
  std::ranges::fill(memory.writable(), uint8_t{1});  // pages that were never written may all be one
  const auto* data = reinterpret_cast<const uint64_t*>(memory.bytes().data());
  if (HWY_DYNAMIC_DISPATCH(AddUp)(data, bytes / 8) != bytes / 8 * 0x0101010101010101u)
    return state.SkipWithError("not every byte was read");
  for (auto _ : state) benchmark::DoNotOptimize(HWY_DYNAMIC_DISPATCH(AddUp)(data, bytes / 8));
  set_bytes_touched(state, touched);
  state.counters["bytes_s"] = benchmark::Counter(
      static_cast<double>(bytes), benchmark::Counter::kIsIterationInvariantRate, benchmark::Counter::kIs1000);
}

// The near bytes fit a core's own cache. The far ones are about as many as a look-up's rows or the frames here.
BENCHMARK_CAPTURE(read_bandwidth, near, BytesTouched{.near = 256 << 10})->Name(kNearBandwidth);
BENCHMARK_CAPTURE(read_bandwidth, far, BytesTouched{.far = 64 << 20})->Name(kFarBandwidth);

}  // namespace
}  // namespace glovebench::bench
#endif
