#include "engine/run/scaling_json.h"

namespace talus::engine {

nlohmann::ordered_json ScalingJson(const ScalingEstimate& estimate) {
  nlohmann::ordered_json json = {{"chunks", estimate.num_chunks},
                                 {"shared_work", estimate.parallel_share},
                                 {"longest_chunk_over_mean", estimate.imbalance}};
  for (const auto& [cores, factor] : estimate.speed_ups) {
    json["speed_up_" + std::to_string(cores) + "_cores"] = factor;
  }
  return json;
}

}  // namespace talus::engine
