// A call that is cancelled at any of its checkpoints: every one asks, and the callback says no at its k-th call, for
// each k there is. Under the address and the thread sanitizer too.
#include <doctest/doctest.h>

#include <chrono>
#include <functional>

#include "api/fair_solver.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "meshes.h"
#include "method/nested.h"

using namespace fairing;

namespace {

constexpr std::chrono::milliseconds always{0};

// Whether the run is cancelled by a no at the k-th call; after it there is no other one.
bool is_cancelled(int k, const std::function<void(const ProgressCallback&)>& run) {
    int calls = 0;
    bool cancelled = false;
    try {
        run(ProgressCallback([&](double, std::string_view) { return ++calls < k; }, always));
    } catch (const Cancelled&) {
        cancelled = true;
    }
    REQUIRE(calls <= k);
    REQUIRE(cancelled == (calls == k));
    return cancelled;
}

// How often the run can be cancelled.
int cancel_everywhere(const std::function<void(const ProgressCallback&)>& run) {
    int k = 1;
    while (is_cancelled(k, run)) ++k;
    return k - 1;
}

bool same_bits(const Points& one, const Points& other) {
    return one.cols() == other.cols() && one.cwiseEqual(other).all();
}

}  // namespace

// More threads than cores: the caller waits for helpers that have begun and don't run.
TEST_CASE("threads: a nested solve is cancelled at every checkpoint") {
    const test::Single single = test::single_patch(test::grid(19, 0.2, test::sphere));
    const Patch& patch = single.patch();
    const Points fixed = single.points.rightCols(patch.vertex_count() - patch.free_count);
    const Problem problem{patch, fixed, fixed, uniform_weights(patch), {}};
    Points wanted;
    const auto solve = [&](const ProgressCallback& stop) {
        const Progress progress(stop);
        const Checkpoints checkpoints(progress);
        const auto solution = solve_nested(problem, Traits(problem), progress);
        REQUIRE(solution);
        REQUIRE(solution->levels.size() > 1);
        if (wanted.cols() == 0) wanted = solution->points;
        CHECK(same_bits(solution->points, wanted));
    };
    for (const int threads : {1, 4}) {
        const Threads team(threads);
        const int places = cancel_everywhere(solve);
        CHECK(places > 100);
    }
}

TEST_CASE("threads: a Solver that was cancelled at any checkpoint goes on as if it had not been asked") {
    const test::Mesh cap = test::grid(5, 0.2, test::sphere);
    Points moved = cap.points;
    moved.row(0) *= 1.05;
    FairOptions options;
    options.threads = 2;
    const auto after = [&](const std::function<void(FairSolver&)>& between) {
        FairSolver solver(cap.triangles, {}, {}, options);
        solver.solve(cap.points, {}, {}, {}, {});
        between(solver);
        return solver.solve(moved, {}, {}, {}, {}).vertices;
    };
    const Points wanted = after([](FairSolver&) {});
    int k = 0;
    bool cancelled = true;
    while (cancelled) {
        ++k;
        const auto cancel = [&](FairSolver& solver) {
            cancelled = is_cancelled(k, [&](const ProgressCallback& stop) { solver.solve(moved, {}, {}, {}, stop); });
        };
        const Points found = after(cancel);
        if (cancelled) REQUIRE(same_bits(found, wanted));
    }
    CHECK(k > 10);
}
