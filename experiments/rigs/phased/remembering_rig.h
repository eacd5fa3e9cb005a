// A rig with a memory of its own: a struct of what it has measured so far, with a Visit list.
#pragma once

#include <string>
#include <utility>

#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/rigs/phased/rig.h"

namespace talus::rigs {

struct NoMemory {
  template <class Self, class Visitor>
  static void Visit(Self&, Visitor&&) {}
};

template <class Memory>
class RememberingRig : public Rig {
 public:
  struct State {
    RigState common;
    Memory memory;

    TALUS_FIELDS(common, memory);
  };

  static State ParseState(const std::string& line) {
    return base::LoadOptions<State>(base::ParseJson(line, "checkpoint"));
  }
  std::string StateLine() const override {
    return base::JsonText(base::ToJson(State{.common = state(), .memory = memory_}));
  }
  const Memory& memory() const { return memory_; }

  // What the rig's own options cannot see by themselves: nothing.
  static void Validate(const Case&, base::Problems&) {}

 protected:
  RememberingRig(const Case& rig_case, const Vessel& vessel, State state,
                 engine::Simulation simulation)
      : Rig(rig_case, vessel, std::move(state.common), std::move(simulation)),
        memory_(std::move(state.memory)) {}

  Memory& memory() { return memory_; }

 private:
  Memory memory_;
};

}  // namespace talus::rigs
