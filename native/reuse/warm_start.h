// Repeated solves of one patch: from the last answer, moved along with the boundary.
#pragma once

#include "base/progress.h"
#include "operators/normal_operator.h"
#include "problem/problem.h"
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

// From positions that lie near the surface already.
struct NearStart {
    Points points;  // 3 × local vertices, units of D
    // The vertices sit within the surface as they should: they move along its normals only. So they do where the
    // weights are the conformal ones of these very positions.
    bool converged;
};

// The accepted surface that the iteration finds within a few steps from there; nothing where there is none, and the
// boundary alone has to decide. Throws Cancelled.
std::optional<Solution> solve_near(const Problem& problem, const NearStart& start, const Progress& progress);

// 3 × fixed count each, units of D; pins have no normal.
struct Boundary {
    Points points;
    Points normals;
};

Boundary boundary_of(const Problem& problem);

// The rotation that takes one boundary nearest to a later one (Kabsch 1976). Nothing where a point is then more than
// 0.05 D or a normal more than 45° away: the last answer says little about the next one.
std::optional<Eigen::Matrix3d> small_rotation(const Boundary& last, const Boundary& present);

}  // namespace fairing
