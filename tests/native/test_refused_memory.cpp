// A call one of whose requests for memory fails, the k-th for each k there is, on whatever thread: it ends in bad_alloc
// or SolverError, and nothing is left behind.
#include <doctest/doctest.h>

#include <functional>
#include <new>

#include "api/fair_solver.h"
#include "base/background_task.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "meshes.h"
#include "method/nested.h"
#include "refused_memory.h"

using namespace fairing;
using test::Refused;
using test::RefusedMemory;

namespace {

// run() gives the surface. A request may fail that has another way out: then it is the same to the bit.
int refuse_everywhere(const std::function<Points()>& run, Refused refused) {
    const Points wanted = run();
    for (int k = 1;; ++k) {
        const std::int64_t before = test::held_blocks();
        bool has_failed = false;
        bool has_refused = false;
        bool is_same = true;
        {
            const RefusedMemory memory(k, refused);
            try {
                const Points found = run();
                is_same = found.cols() == wanted.cols() && (found.array() == wanted.array()).all();
            } catch (const std::bad_alloc&) {
                has_failed = true;
            } catch (const SolverError&) {
                has_failed = true;
            }
            has_refused = memory.has_refused();
        }
        REQUIRE(test::held_blocks() == before);
        REQUIRE(is_same);
        if (!has_refused) {
            REQUIRE_FALSE(has_failed);
            return k - 1;
        }
    }
}

FairOptions with_threads(int threads) {
    FairOptions options;
    options.threads = threads;
    return options;
}

}  // namespace

TEST_CASE("refused memory is seen by operator new and by Eigen") {
    const auto make = [] { return Points(Points::Zero(3, 50)); };
    CHECK(refuse_everywhere(make, Refused::one) >= 1);
    const std::int64_t before = test::held_blocks();
    const std::vector<int> numbers(10, 1);
    CHECK(test::held_blocks() == before + 1);
    const RefusedMemory memory(1, Refused::one);
    bool has_failed = false;
    try {
        const std::vector<int> more(10, 1);
    } catch (const std::bad_alloc&) {
        has_failed = true;
    }
    CHECK(has_failed);
}

TEST_CASE("a small solve whose k-th request for memory fails, and one from there on without any") {
    const test::Mesh mesh = test::grid(4, 0.2, test::sphere);
    for (const int threads : {1, 2}) {
        for (const Refused refused : {Refused::one, Refused::all_later}) {
            const auto solve = [&] {
                return fair({mesh.points, mesh.triangles, {}, {}}, {}, with_threads(threads), {}).vertices;
            };
            const int requests = refuse_everywhere(solve, refused);
            CHECK(requests > 100);
        }
    }
}

TEST_CASE("a Solver whose k-th request for memory fails solves on") {
    const test::Mesh mesh = test::grid(4, 0.2, test::sphere);
    FairSolver solver(mesh.triangles, {}, {}, with_threads(2));
    const auto solve = [&] { return solver.solve(mesh.points, {}, {}, {}, {}).vertices; };
    const Points wanted = solve();
    bool has_refused = true;
    for (int k = 1; has_refused; ++k) {
        {
            const RefusedMemory memory(k, Refused::one);
            try {
                solve();
            } catch (const std::bad_alloc&) {
            } catch (const SolverError&) {
            }
            has_refused = memory.has_refused();
        }
        const Points found = solve();
        REQUIRE((found - wanted).norm() < 1e-6);
    }
}

TEST_CASE("helpers that get no memory: to begin, for a place in the queue, within a loop, within their work") {
    const auto work = [] {
        const Threads team(3);
        Points result = Points::Zero(3, 64);
        Points other;
        BackgroundTask task([&] { other = Points::Ones(3, 64); });
        run_pieces(64, [&](int k) { result.col(k) = Points(Points::Constant(3, k + 1, k)).col(k); });
        task.finish();
        return Points(result + other);
    };
    for (const Refused refused : {Refused::one, Refused::all_later}) CHECK(refuse_everywhere(work, refused) > 64);
}
