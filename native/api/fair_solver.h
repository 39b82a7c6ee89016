// Repeated calls for one mesh, each beginning at the last one's answer.
#pragma once

#include <memory>

#include "api/fair.h"
#include "base/progress.h"

namespace fairing {

struct PreparedMesh;

// One call at a time. The constructor throws what check_mesh (connectivity) and prepare throw, where the numbering has
// no great gaps; otherwise the first solve does.
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

}  // namespace fairing
