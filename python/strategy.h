// Ask–tell of every strategy, with parameters by name and in their own units.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "optimizer/space/parameter_space.h"
#include "optimizer/strategy/make_strategy.h"
#include "python/arrays.h"

namespace talus::python {

class Strategy {
 public:
  // `parameters`: dictionaries of optimizer::Parameter; `options`: of optimizer::StrategyOptions.
  // `target`: the measured image, for evaluations that bring images, or None; `pixel_area` makes
  // the sum of absolute differences an area.
  Strategy(const pybind11::list& parameters, const pybind11::dict& options, std::uint64_t seed,
           const pybind11::object& target, double pixel_area);

  pybind11::list Ask(int count);
  // `value` and `image` may be None.
  void Tell(const pybind11::dict& values, const pybind11::object& value,
            const pybind11::object& image, bool failed);
  // In words: the strategy's own reason, that it has no more to propose, or that whatever is told
  // fails.
  std::optional<std::string> StopReason();
  pybind11::dict Answer();

 private:
  pybind11::dict Named(const Eigen::VectorXd& point) const;
  Eigen::VectorXd PointOf(const pybind11::dict& values) const;
  void Learn(optimizer::Observation observation);

  // Other Python threads run while the strategy works; it does one thing at a time.
  template <class Work>
  auto Asleep(Work&& work) {
    const pybind11::gil_scoped_release release;
    const std::lock_guard lock(working_);
    return work();
  }

  optimizer::ParameterSpace space_;
  std::optional<optimizer::FieldObjective> field_;
  std::unique_ptr<optimizer::Strategy> strategy_;
  std::vector<Eigen::VectorXd> pending_;  // asked for and not told yet
  bool is_exhausted_ = false;             // it was asked for more than it had
  int num_failed_ = 0;
  int num_succeeded_ = 0;
  std::mutex working_;
};

}  // namespace talus::python
