// Runs what a drawn trial has left to do without a process of its own: a fork and an exec would
// take longer than all the rest of it. What needs a program, to sleep or to die, gets one.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiments/campaign/make_parts.h"
#include "tests/experiments/fake_engine.h"

namespace talus::campaign {

class DrawnRunner : public runners::Runner {
 public:
  explicit DrawnRunner(std::unique_ptr<runners::Runner> programs)
      : programs_(std::move(programs)) {}

  int Capacity() const override { return programs_->Capacity(); }
  bool JobsOutliveUs() const override { return programs_->JobsOutliveUs(); }

  std::vector<std::string> Submit(std::span<const runners::Job> jobs) override {
    std::vector<std::string> names;
    for (const runners::Job& job : jobs) {
      if (job.command != FakeEngine::Shown()) {
        names.push_back(programs_->Submit(std::span(&job, 1))[0]);
        continue;
      }
      std::filesystem::rename(job.folder / job.command[1], job.folder / job.command[2]);
      constexpr double kDuration = 0.02;  // as with a process
      drawn_.push_back({.id = job.id,
                        .reason = "exit status 0",
                        .duration = kDuration,
                        .cpu_time = kDuration,
                        .host = "drawn"});
      names.emplace_back();
    }
    return names;
  }
  bool Adopt(const runners::Job& job, const std::string& name) override {
    return programs_->Adopt(job, name);
  }
  std::vector<runners::FinishedJob> Wait(double seconds) override {
    std::vector<runners::FinishedJob> finished = std::exchange(drawn_, {});
    const auto others = programs_->Wait(finished.empty() ? seconds : 0);
    finished.insert(finished.end(), others.begin(), others.end());
    return finished;
  }
  void Cancel(std::int64_t id) override { programs_->Cancel(id); }

 private:
  std::unique_ptr<runners::Runner> programs_;
  std::vector<runners::FinishedJob> drawn_;
};

// On this machine; a queue's jobs are left to the queue.
inline std::unique_ptr<runners::Runner> MakeDrawnRunner(const CampaignSpec& spec,
                                                        const std::filesystem::path& folder) {
  auto runner = MakeRunner(spec, folder);
  if (spec.runner.kind != RunnerKind::kLocal) return runner;
  return std::make_unique<DrawnRunner>(std::move(runner));
}

}  // namespace talus::campaign
