// Threads that share a task, thousands of times a second.
//
// Who waits spins for a moment and then sleeps: between two steps the wait is shorter than falling
// asleep takes. But where there are more threads than free cores, the member waited for may not be
// running at all, and spinning keeps it from running; so who has spun in vain spins less often.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace talus::engine {

// Whether spinning has been of use to one member lately.
class alignas(64) Patience {
 public:
  // Whether to spin this time: always, or after n spins in vain every 2ⁿth time.
  bool SpinNow();
  void Spun(bool in_vain) { num_skips_ = in_vain ? std::min(2 * num_skips_ + 1, kMostSkips) : 0; }

 private:
  static constexpr int kMostSkips = 15;
  int num_skips_ = 0;
  int num_skipped_ = 0;
};

// A number that only grows, and that one thread raises for others to wait on.
class Milestone {
 public:
  void Reach(std::int64_t number);
  // What was written before Reach(number) is visible afterwards.
  void Await(std::int64_t number, Patience& patience);

 private:
  bool Spin(std::int64_t number) const;  // whether the number was reached
  void Sleep(std::int64_t number);

  alignas(64) std::atomic<std::int64_t> reached_ = 0;
  std::atomic<int> num_sleepers_ = 0;
  std::mutex mutex_;
  std::condition_variable raised_;
};

// What a member does of things in a row.
struct Share {
  std::int64_t begin, end;
};

class Team {
 public:
  // `size` >= 1, the calling thread among them. Throws base::Error when the machine gives fewer.
  explicit Team(int size);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const { return static_cast<int>(halves_.size()); }

  // Calls task(member) of members 0 … size − 1 at once, the first on this thread, and returns when
  // all are done. The task must not throw.
  template <class Task>
  void Run(const Task& task) {
    RunPlain([](const void* whole, int member) { (*static_cast<const Task*>(whole))(member); },
             &task);
  }

  // The member's part of `count` things in a row: the first member has the first ones.
  Share ShareOf(int member, std::int64_t count) const {
    return {count * member / size(), count * (member + 1) / size()};
  }

  // Calls part(begin, end) of the members' shares of `count` things; the shares begin at multiples
  // of `unit`. Few things are not worth waking anybody.
  template <class Part>
  void ForParts(std::int64_t count, std::int64_t unit, const Part& part) {
    constexpr std::int64_t kWorthSharing = 16384;
    if (count < kWorthSharing) return part(std::int64_t{0}, count);
    const std::int64_t num_units = (count + unit - 1) / unit;
    Run([&](int member) {
      const Share share = ShareOf(member, num_units);
      const std::int64_t begin = unit * share.begin, end = std::min(unit * share.end, count);
      if (begin < end) part(begin, end);
    });
  }

  // Within a task: the member is through its first part; wait until all before `member` are.
  void FinishFirstPart(int member) { halves_[member].Reach(num_tasks_); }
  void AwaitFirstPartsBefore(int member);

 private:
  using PlainTask = void (*)(const void* task, int member);

  void RunPlain(PlainTask call, const void* task);
  void Work(int member);
  void BreakUp();  // ends the threads

  PlainTask call_ = nullptr;  // null: the team breaks up
  const void* task_ = nullptr;
  std::int64_t num_tasks_ = 0;
  Milestone given_;                 // number of the last task
  std::vector<Milestone> halves_;   // of each member, the last task that it did the first part of
  std::vector<Milestone> done_;     // … and that it did
  std::vector<Patience> patience_;  // of each member
  std::vector<std::thread> threads_;
};

}  // namespace talus::engine
