// Repeated calls for one mesh, each beginning at the last one's answer.
#pragma once

#include "api/component_solver.h"
#include "api/fair.h"
#include "base/progress.h"

namespace fairing {

struct PreparedMesh;

// One call at a time. The constructor throws what check_mesh (connectivity) and prepare throw; where vertex numbers
// have great gaps, the first solve does.
class FairSolver {
public:
    FairSolver(Triangles triangles, std::optional<Indices> fixed, HeldInside held, FairOptions options);
    FairSolver(const FairSolver&) = delete;
    FairSolver& operator=(const FairSolver&) = delete;
    ~FairSolver();

    // What fair() gives: the first time bit for bit, then to the tolerance. Throws the same; the solver stays usable.
    FairResult solve(Points vertices, std::optional<Points> fixed_normals, std::optional<VectorX> fixed_curvatures,
                     const std::optional<View<Points>>& reference, const ProgressCallback& progress,
                     const Preview& preview = {});

    // Sets other options from the next solve on. Keeps what does not depend on them, and the last answer.
    void change(FairOptions options);

private:
    Points vertices_;  // of the last call
    MeshInput input_;  // with its normals
    FairOptions options_;
    std::unique_ptr<PreparedMesh> prepared_;
};

// The mesh prepared for solving; repeated calls keep it.
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
