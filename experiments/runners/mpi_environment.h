// What Open MPI must be told where several trials share a machine: it would bind the ranks of each
// to the machine's first cores, and the threads of a rank to one of them. Others bind nothing by
// themselves.
#pragma once

#include <array>
#include <utility>

namespace talus::runners {

inline constexpr std::array kUnboundRanks{
    std::pair{"OMPI_MCA_hwloc_base_binding_policy", "none"},     // up to version 4
    std::pair{"PRTE_MCA_hwloc_default_binding_policy", "none"},  // from version 5 on
};

}  // namespace talus::runners
