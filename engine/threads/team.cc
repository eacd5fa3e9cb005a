#include "engine/threads/team.h"

#include <immintrin.h>

#include <cassert>
#include <chrono>
#include <exception>
#include <string>

#include "base/error.h"

namespace talus::engine {

namespace {

// Longer than what members of a team usually wait for each other in a step, and short beside the
// slices of time that the machine gives to others.
constexpr std::chrono::microseconds kSpinTime{50};
constexpr int kSpinsPerLook = 16;  // between two looks at the clock

}  // namespace

bool Patience::SpinNow() {
  if (num_skipped_ < num_skips_) {
    ++num_skipped_;
    return false;
  }
  num_skipped_ = 0;
  return true;
}

void Milestone::Reach(std::int64_t number) {
  // Either this sees the sleeper or the sleeper sees the number: both are in one order.
  reached_.store(number, std::memory_order_seq_cst);
  if (num_sleepers_.load(std::memory_order_seq_cst) == 0) return;
  { const std::lock_guard lock(mutex_); }
  raised_.notify_all();
}

bool Milestone::Spin(std::int64_t number) const {
  const auto give_up = std::chrono::steady_clock::now() + kSpinTime;
  do {
    for (int k = 0; k < kSpinsPerLook; ++k) {
      if (reached_.load(std::memory_order_acquire) >= number) return true;
      _mm_pause();
    }
  } while (std::chrono::steady_clock::now() < give_up);
  return false;
}

void Milestone::Await(std::int64_t number, Patience& patience) {
  if (reached_.load(std::memory_order_acquire) >= number) return;
  if (patience.SpinNow()) {
    const bool reached = Spin(number);
    patience.Spun(!reached);
    if (reached) return;
  }
  Sleep(number);
}

void Milestone::Sleep(std::int64_t number) {
  std::unique_lock lock(mutex_);
  num_sleepers_.fetch_add(1, std::memory_order_seq_cst);
  raised_.wait(lock, [&] { return reached_.load(std::memory_order_seq_cst) >= number; });
  num_sleepers_.fetch_sub(1, std::memory_order_relaxed);
}

Team::Team(int size) : halves_(size), done_(size), patience_(size) {
  assert(size >= 1);
  try {
    for (int member = 1; member < size; ++member) {
      threads_.emplace_back([this, member] { Work(member); });
    }
  } catch (const std::exception& error) {
    const std::size_t num_started = threads_.size() + 1;
    BreakUp();
    throw base::Error("the machine gives " + std::to_string(num_started) + " of " +
                      std::to_string(size) + " threads (" + error.what() +
                      "); take fewer threads, or raise the limits of processes and memory "
                      "(ulimit -u, ulimit -v)");
  }
}

Team::~Team() { BreakUp(); }

void Team::BreakUp() {
  call_ = nullptr;
  given_.Reach(num_tasks_ + 1);
  for (std::thread& thread : threads_) thread.join();
}

void Team::RunPlain(PlainTask call, const void* task) {
  call_ = call;
  task_ = task;
  ++num_tasks_;
  given_.Reach(num_tasks_);
  call(task, 0);
  for (int member = 1; member < size(); ++member) done_[member].Await(num_tasks_, patience_[0]);
}

void Team::Work(int member) {
  for (std::int64_t task = 1;; ++task) {
    given_.Await(task, patience_[member]);
    if (call_ == nullptr) return;
    call_(task_, member);
    done_[member].Reach(task);
  }
}

void Team::AwaitFirstPartsBefore(int member) {
  for (int other = 0; other < member; ++other) halves_[other].Await(num_tasks_, patience_[member]);
}

}  // namespace talus::engine
