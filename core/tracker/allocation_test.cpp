// What a tracker asks of the heap once it has seen such frames: nothing.

#include <gmock/gmock.h>

#include <cerrno>
#include <functional>
#include <thread>
#include <vector>

#include "core/base/sanitizers.h"
#include "core/kinect/disparity.h"
#include "core/methods/method.h"
#include "core/tracker/test_scene.h"

// The sanitizers put functions of their own in the place of these.
#if !defined(GLOVEBENCH_ADDRESS_SANITIZER) && !defined(GLOVEBENCH_THREAD_SANITIZER)

namespace {
thread_local bool counting = false;
thread_local int requests = 0;

void count() {
  if (counting) ++requests;
}
}  // namespace

// The C library's functions, in front of its own: they count, and pass on.
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(size_t number, size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* memory, size_t size) {
  count();
  return __libc_realloc(memory, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, size_t alignment, size_t size) {
  count();
  *memory = __libc_memalign(alignment, size);
  return *memory != nullptr ? 0 : ENOMEM;
}
}

namespace glovebench {
namespace {

int requests_of(const std::function<void()>& work) {
  requests = 0;
  counting = true;
  work();
  counting = false;
  return requests;
}

/// A hand on its way through the view, that opens and closes; with disparity or depth.
const std::vector<DeviceFrame>& frames() {
  static const std::vector<DeviceFrame> shot = [] {
    std::vector<DeviceFrame> frames;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Isometry3d T_camera_hand = render::test_pose({0.02 * i - 0.05, 0.03, 0.8 - 0.05 * i});
      frames.push_back(shoot(T_camera_hand, i % 2 == 0 ? Posture(Posture::Zero()) : power_posture()).frame);
      if (i % 3 != 2) continue;
      frames.back().depth = depth_of(frames.back(), {});
      frames.back().raw_disparity = {};
    }
    return frames;
  }();
  return shot;
}

/// A hand on its way out of the image.
std::vector<DeviceFrame> leaving() {
  std::vector<DeviceFrame> frames;
  for (int i = 0; i < 6; ++i) frames.push_back(shoot(render::test_pose({0.25 + 0.01 * i, 0, 0.6})).frame);
  return frames;
}

/// The requests in each frame when a method sees `frames` for the third time.
std::vector<int> requests_a_frame(const TrackerConfig& config, const std::vector<DeviceFrame>& frames) {
  const std::unique_ptr<Method> method = find_method(config.method)
                                             .make({config, synthetic_calibration(), borrowed(render::test_hand()),
                                                    borrowed(test_database()), borrowed(test_color_table())});
  std::vector<TrackResult> previous;
  std::vector<int> counts(frames.size());
  for (int round = 0; round < 3; ++round) {
    previous.clear();
    for (size_t i = 0; i < frames.size(); ++i) {
      std::optional<TrackResult> result;
      counts[i] = requests_of([&] { result = method->track(frames[i], previous); });
      EXPECT_EQ(result->status, TrackStatus::tracked);
      previous.push_back(*result);
    }
  }
  return counts;
}

TEST(Allocation, is_seen) {
  std::vector<int>* volatile made = nullptr;
  EXPECT_EQ(requests_of([&] { made = new std::vector<int>(100); }), 2) << "the vector and what it holds";
  delete made;
}

TEST(Allocation, happens_in_the_first_frame) {
  // On a thread that has no memory yet.
  int first = 0;
  std::thread([&] {
    Tracker tracker = make_tracker();
    first = requests_of([&] { tracker.track(frames()[0]); });
  }).join();
  EXPECT_GT(first, 0);
}

/// Asks twice for memory of one size when its thread ends.
struct Late {
  int* requests = nullptr;
  ~Late() {
    *requests = requests_of([] {
      for (int i = 0; i < 2; ++i) give_memory(take_memory(1000), 1000);
    });
  }
};

TEST(Allocation, happens_each_time_where_a_thread_has_thrown_away_what_it_kept) {
  int at_the_end = 0;
  std::thread([&] {
    thread_local Late late;  // made before what the thread keeps, it goes after that
    late.requests = &at_the_end;
    give_memory(take_memory(1000), 1000);
    EXPECT_EQ(requests_of([] { give_memory(take_memory(1000), 1000); }), 0);
  }).join();
  EXPECT_EQ(at_the_end, 2);
}

TEST(Allocation, does_not_happen_once_a_tracker_has_begun) {
  EXPECT_THAT(requests_a_frame({}, frames()), testing::Each(0));

  TrackerConfig robust;
  robust.icp.algorithm = "robust";
  robust.lookup.cascade = parse_cascade("exact:3");
  EXPECT_THAT(requests_a_frame(robust, frames()), testing::Each(0));

  TrackerConfig filtered;
  filtered.segmentation.majority_filter = true;
  filtered.segmentation.largest_component = true;
  filtered.icp.cull_each_iteration = true;
  EXPECT_THAT(requests_a_frame(filtered, frames()), testing::Each(0));

  TrackerConfig articulated;
  articulated.method = "articulated";
  EXPECT_THAT(requests_a_frame(articulated, frames()), testing::Each(0));
  ASSERT_EQ(make_tracker().track(leaving().back()).status, TrackStatus::cut_by_border);
  EXPECT_THAT(requests_a_frame(articulated, leaving()), testing::Each(0));
}

}  // namespace
}  // namespace glovebench

#endif
