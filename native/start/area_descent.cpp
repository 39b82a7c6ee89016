#include "start/area_descent.h"

#include "problem/surface_state.h"
#include "start/globalisation.h"

namespace fairing {

Points descend_area(const Problem& problem, Workspace& work, const Points& start, const Progress& progress) {
    const Patch& patch = problem.patch;
    SurfaceState state;
    state.points = start;
    for (int k = 0; k < most_descent_steps; ++k) {
        progress.report(static_cast<double>(k) / most_descent_steps, "minimal start");
        state.measure_faces(patch);
        if (!work.normal->update(state.stiffness, progress.here())) break;
        const Points gradient = state.stiffness.apply(patch, state.points, patch.free_count);
        const Points d = -work.normal->solve(gradient.transpose()).transpose();
        if (!d.allFinite()) break;
        state.points.leftCols(patch.free_count) += d;
        if (largest_length(d) < descended) break;
    }
    return state.points;
}

}  // namespace fairing
