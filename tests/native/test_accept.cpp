#include <doctest/doctest.h>

#include "accept/accept.h"
#include "geometry/neighbourhood.h"
#include "meshes.h"
#include "placement/place.h"
#include "placement/tears.h"
#include "problem/solution.h"

using namespace fairing;

namespace {

// A patch of the unit sphere that counts as solved.
struct Solved {
    test::Single single = test::single_patch(test::grid(12, 0.0, test::sphere));
    Problem problem = make_problem();

    [[nodiscard]] const Patch& patch() const { return single.patch(); }
    [[nodiscard]] int fixed_count() const { return patch().vertex_count() - patch().free_count; }

    [[nodiscard]] Problem make_problem() const {
        const Points fixed = single.points.rightCols(fixed_count());
        return {patch(), fixed, fixed, uniform_weights(patch()), {}};
    }

    [[nodiscard]] Solution solution() const {
        Solution result;
        result.points = single.points;
        result.mean_curvature = VectorX::Constant(patch().vertex_count(), -1.0);
        result.boundary_normals = problem.fixed_normals;
        result.termination = Termination::converged;
        result.iterations = 10;
        return result;
    }

    // Moves an inner vertex beyond its ring, along the surface.
    static void fold(Solution& solution, const Patch& patch) {
        for (int v = 0; v < patch.free_count; ++v) {
            const auto ring = patch.ring(v).vertices;
            if (std::any_of(ring.begin(), ring.end(), [&](int w) { return !patch.is_free(w); })) continue;
            solution.points.col(v) = (2.2 * solution.points.col(ring[0]) - 1.2 * solution.points.col(v)).normalized();
            return;
        }
    }
};

}  // namespace

TEST_CASE("folds are a flaw and are named, unless the weights come from as many") {
    Solved solved;
    Solution solution = solved.solution();
    Solved::fold(solution, solved.patch());
    CHECK(flaw_of(solved.problem, solution) == Flaw::folded);
    CHECK(!solution.bad_triangles.empty());
    solved.problem.tolerated_folds = solution.bad_triangles.size();
    solution.crosses = true;
    CHECK(flaw_of(solved.problem, solution) == Flaw::absent);
}

TEST_CASE("few triangles beside a low-passed boundary may be the boundary's own folds, many are a flaw") {
    const test::Single single = test::single_patch(test::grid(80, 0.0, test::sphere));
    const Patch& patch = single.patch();
    const Points fixed = single.points.rightCols(patch.vertex_count() - patch.free_count);
    const Problem problem{patch, fixed, fixed, uniform_weights(patch), {}};
    for (const int folds : {1, 12}) {
        Solution solution;
        solution.points = single.points;
        test::push_beyond_boundary(patch, folds, solution.points);
        solution.boundary_normals = fixed;
        solution.mean_curvature = VectorX::Constant(patch.vertex_count(), -1.0);
        solution.termination = Termination::converged;
        solution.polished = false;
        solution.provenance = Provenance::low_passed;
        CHECK(torn_triangles(patch, solution.points).size() >= static_cast<std::size_t>(folds));
        CHECK(flaw_of(problem, solution) == (folds == 1 ? Flaw::absent : Flaw::folded));
        CHECK(solution.bad_triangles.empty() == (folds == 1));
    }
}

TEST_CASE("crossings are a flaw where the surface itself has none") {
    const Solved solved;
    Solution solution = solved.solution();
    // One vertex is drawn over a spike that another one makes, three edges away.
    const Patch& patch = solved.patch();
    const double edge = mean_edge(patch, solution.points);
    const auto nearest = [&](double x) {
        int found = 0;
        for (int v = 0; v < patch.free_count; ++v) {
            const auto away = [&](int w) {
                return (solved.single.points.col(w).head<2>() - Eigen::Vector2d(x, 0)).norm();
            };
            if (away(v) < away(found)) found = v;
        }
        return found;
    };
    const int spike = nearest(0.0);
    solution.points.col(spike) += Vector3(0.0, 0.0, 3.0 * edge);
    solution.points.col(nearest(3.0 * edge)) = solution.points.col(spike) - Vector3(edge, 0.0, 1.5 * edge);
    Problem lenient = solved.problem;
    lenient.tolerated_folds = 1000;
    CHECK(flaw_of(lenient, solution) == Flaw::crossing);
    CHECK(!solution.bad_triangles.empty());
    solution.crosses = true;
    CHECK(flaw_of(lenient, solution) == Flaw::absent);
    solution.provenance = Provenance::least_variation;  // of what was asked for: no reason to pass through itself
    CHECK(flaw_of(lenient, solution) == Flaw::crossing);
}

TEST_CASE("a surface without area and one that meets its boundary from behind are no answers") {
    const Solved solved;
    Solution behind = solved.solution();
    behind.boundary_normals = -behind.boundary_normals;
    CHECK(flaw_of(solved.problem, behind) == Flaw::behind);
    Solution collapsed = solved.solution();
    collapsed.points = Vector3(0.1, 0.2, 0.3).replicate(1, collapsed.points.cols());
    CHECK(flaw_of(solved.problem, collapsed) == Flaw::collapsed);
}

TEST_CASE("triangles that can't carry the equation are a flaw of the user's mesh only") {
    const Solved solved;
    Solution solution = solved.solution();
    solution.points.row(0) *= 0.05;
    const Points squeezed = solution.points;
    solution.crosses = true;
    CHECK(has_poor_triangles(solved.patch(), squeezed));
    CHECK(flaw_of(solved.problem, solution) == Flaw::poor_triangles);
    solution.polished = false;
    CHECK(flaw_of(solved.problem, solution) == Flaw::absent);
}

namespace {

// The solved surface, as one of edges of that length.
struct ProjectedSurface {
    const Solved& solved;
    Solution solution = solved.solution();
    TargetSurface target{solved.patch(), solution.points, solution.points};
    std::vector<SurfacePoint> where = at_vertices(solved.problem, target, solution.points).where;
    double mean = mean_edge(solved.patch(), solution.points);

    [[nodiscard]] bool agrees(const Solution& own, double edge) const {
        return agree(solved.problem, own, {target, solution.mean_curvature, edge, where});
    }
};

}  // namespace

TEST_CASE("two surfaces agree within their errors, or within the coarser one's edges") {
    const Solved solved;
    const ProjectedSurface projected{solved};
    const double fine = 0.5 * projected.mean;
    Solution own = projected.solution;
    own.points.col(0) *= 1.0 + 1e-4;
    CHECK(projected.agrees(own, fine));
    own.points.col(0) *= 1.0 + 1e-3;
    CHECK(!projected.agrees(own, fine));
    CHECK(projected.agrees(own, 4.0 * fine));
    own.points.col(0) *= 1.0 + 4.0 * fine;
    CHECK(!projected.agrees(own, 4.0 * fine));
    own.points = projected.solution.points;
    own.mean_curvature *= 1.3;
    CHECK(!projected.agrees(own, fine));
}
