#include "start/membrane.h"

namespace fairing {

Points membrane(const Problem& problem, const Workspace& work) {
    Points points(3, problem.patch.vertex_count());
    points << work.tangential->harmonic_positions(), problem.fixed_points;
    return points;
}

}  // namespace fairing
