// A loop over independent items, on all the threads that OpenMP may use: photographs, views,
// candidates, draws.
//
// Each item writes what is its own only, so the result has the same bits for any number of threads.
// Between two loops the threads sleep where OMP_WAIT_POLICY=passive stands in the environment when
// the program starts, as `talus` sees to; else they spin for some milliseconds.
#pragma once

#include <cstdint>
#include <functional>

namespace talus::base {

struct LoopSize {
  std::int64_t num_items = 0;
  double item_work = 0;  // about how many multiplications an item takes; small loops get one thread
};

// Calls body(i) of each item i once, in any order. Inside the body of another loop, on its thread.
// Where several bodies throw, the exception of the smallest i leaves the loop.
void ParallelFor(const LoopSize& size, const std::function<void(std::int64_t)>& body);

// The most threads of a loop that this thread starts; at first OMP_NUM_THREADS, else all the cores
// that the process may use.
int MostLoopThreads();
void SetMostLoopThreads(int count);

}  // namespace talus::base
