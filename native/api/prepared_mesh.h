// What a call makes of the mesh before it solves; repeated calls keep it.
#pragma once

#include "api/component_solver.h"
#include "base/progress.h"

namespace fairing {

struct PreparedMesh {
    CheckedMesh mesh;
    bool finite;                           // all coordinates; where one is not, the topology depends on which
    std::vector<Patch> patches;            // all that have free and fixed vertices
    bool is_all_patches;                   // no triangle lies outside of these
    Diagnostics closed_components;         // those that are left alone
    std::vector<ComponentSolver> solvers;  // one for each patch; they refer to patches and options
};

// Throws what check_mesh throws, NO_FREE_VERTICES, NO_BOUNDARY. The options must outlive what comes back.
std::unique_ptr<PreparedMesh> prepare(const MeshInput& input, const FairOptions& options);

// One call. `prepared`: of an earlier call with the same triangles, fixed vertices and options, or null; it is made
// where it is missing or not of this input. `reference`: M0; the input's vertices where it is left out. Releases the
// input's triangles and the cut mesh where no call follows.
FairResult run_call(MeshInput& input, const std::optional<View<Points>>& reference, const FairOptions& options,
                    std::unique_ptr<PreparedMesh>& prepared, const ProgressCallback& callback, const Preview& preview);

}  // namespace fairing
