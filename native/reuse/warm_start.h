// Repeated solves of one patch: from the last answer, moved along with the boundary.
#pragma once

#include <optional>

#include "base/progress.h"
#include "operators/workspace.h"
#include "problem/solution.h"

namespace fairing {

// Keeps the last answer with the factorisations that were made for it. One problem after the other, all of the same
// patch; boundary data and options may change, and λ after new_weights().
class WarmStart {
public:
    explicit WarmStart(const Patch& patch) : patch_(patch) {}

    // The next solve starts from this answer, if it is one to rely on: converged on the patch's own connectivity,
    // whose triangles are good. Factorises where nothing is factorised yet; throws Cancelled.
    void remember(const Problem& problem, const Solution& solution, const Progress& progress);
    void forget() { ready_ = false; }
    // λ of the next problem are others than those of the last one.
    void new_weights() { work_.tangential.reset(), history_.reset(); }

    // The converged solution near the last answer. Nothing where there is no such answer, the boundary has changed too
    // much, or the iteration is not there within a few steps: then a solve from the boundary alone has to decide.
    // The last answer stays what it was. Throws Cancelled.
    [[nodiscard]] std::optional<Solution> solve(const Problem& problem, const Progress& progress);

private:
    void choose_operator(const Problem& problem);
    [[nodiscard]] bool factorise(const Problem& problem, const Points& points, const Progress& progress);
    void hold(const Problem& problem, const Progress& progress);
    [[nodiscard]] std::optional<Points> moved_along(const Problem& problem) const;
    [[nodiscard]] Points continued(const Problem& problem, const Points& fixed_displacement,
                                   const Points& conormal_change) const;
    [[nodiscard]] Solution iterate_from(const Problem& problem, const Points& start, const Progress& progress);
    void watch_factor(int iterations);

    const Patch& patch_;
    Workspace work_;
    bool is_laplacian_ = false;          // `work_.normal`, and the last answer: of minimal surfaces
    Stiffness factorised_;               // what `work_.normal` holds the factor of
    int iterations_at_first_ = 0;        // of the first solve with that factor; 0: not known yet
    std::unique_ptr<Anderson> history_;  // of the iterations with that factor, up to the last answer
    bool ready_ = false;
    Points points_;   // 3 × local vertices, units of D
    Points normals_;  // 3 × fixed count
};

}  // namespace fairing
