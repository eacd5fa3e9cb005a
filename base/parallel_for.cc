#include "base/parallel_for.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <exception>

namespace talus::base {

#ifdef _OPENMP

namespace {

// A millisecond or so: twenty times what it takes to start a thread.
constexpr double kLeastWork = 1e6;

void RunOnThreads(int num_threads, std::int64_t num_items,
                  const std::function<void(std::int64_t)>& body) {
  std::exception_ptr failure;
  std::int64_t failed = num_items;
#pragma omp parallel for schedule(dynamic) num_threads(num_threads)
  for (std::int64_t i = 0; i < num_items; ++i) {
    try {
      body(i);
    } catch (...) {
#pragma omp critical(talus_loop_failure)
      if (i < failed) {
        failed = i;
        failure = std::current_exception();
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

int MostLoopThreads() { return omp_get_max_threads(); }

void SetMostLoopThreads(int count) { omp_set_num_threads(std::max(1, count)); }

void ParallelFor(const LoopSize& size, const std::function<void(std::int64_t)>& body) {
  const auto num_threads =
      static_cast<int>(std::min<std::int64_t>(size.num_items, MostLoopThreads()));
  const bool small = static_cast<double>(size.num_items) * size.item_work < kLeastWork;
  if (num_threads > 1 && !small && omp_in_parallel() == 0) {
    RunOnThreads(num_threads, size.num_items, body);
    return;
  }
  for (std::int64_t i = 0; i < size.num_items; ++i) body(i);
}

#else  // the thread sanitizer does not see how OpenMP's threads meet

int MostLoopThreads() { return 1; }

void SetMostLoopThreads(int) {}

void ParallelFor(const LoopSize& size, const std::function<void(std::int64_t)>& body) {
  for (std::int64_t i = 0; i < size.num_items; ++i) body(i);
}

#endif

}  // namespace talus::base
