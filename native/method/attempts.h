// What the steps of a plan have come to so far.
#pragma once

#include <memory>
#include <vector>

#include "problem/solution.h"

namespace fairing {

class CoarseStart;  // method/coarse_own_mesh

struct Attempts {
    std::vector<Solution> found;  // none of them accepted
    std::vector<WayTaken> log;
    std::shared_ptr<const CoarseStart> start = {};  // of a large patch on the engine's own mesh, once it is known

    // The latest surface on the user's own connectivity, or none.
    [[nodiscard]] const Solution* own_connectivity() const {
        for (std::size_t k = found.size(); k-- > 0;) {
            if (found[k].polished) return &found[k];
        }
        return nullptr;
    }
};

}  // namespace fairing
