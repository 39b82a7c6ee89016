// Several threads at once; `scripts/test --sanitize` runs these under the thread sanitizer.
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <thread>

#include "api/fair.h"
#include "meshes.h"

using namespace fairing;

namespace {

// A dented grid whose border is held; some of it round and so with a curvature to find.
MeshInput dented_cap(int n) {
    const test::Mesh mesh = test::grid(n, 0.2, test::sphere);
    return {mesh.points, mesh.triangles, {}, {}};
}

FairOptions options(Method method) {
    FairOptions result;
    result.method = method;
    return result;
}

bool same_bits(const FairResult& one, const FairResult& other) {
    return one.vertices.cwiseEqual(other.vertices).all() && one.iterations == other.iterations;
}

}  // namespace

TEST_CASE("threads: calls at the same time on the same arrays give what they give alone") {
    const MeshInput shared = dented_cap(8);
    const MeshInput other = dented_cap(6);
    const std::array<const MeshInput*, 4> inputs{&shared, &shared, &shared, &other};
    const std::array methods{Method::global, Method::global, Method::paper, Method::paper};
    std::array<FairResult, 4> results;
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        threads.emplace_back([&, k] { results[k] = fair(*inputs[k], {}, options(methods[k]), {}); });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        CHECK(same_bits(results[k], fair(*inputs[k], {}, options(methods[k]), {})));
    }
}

TEST_CASE("threads: a run is watched and stopped from another thread") {
    const MeshInput input = dented_cap(8);
    std::atomic<bool> stop = false;
    std::atomic<double> seen = -1.0;
    std::atomic<bool> cancelled = false;
    std::thread worker([&] {
        try {
            for (;;) {
                fair(input, {}, options(Method::global), [&](double fraction, std::string_view) {
                    seen = fraction;
                    return !stop;
                });
            }
        } catch (const Cancelled&) {
            cancelled = true;
        }
    });
    while (seen <= 0.0) std::this_thread::yield();
    stop = true;
    worker.join();
    CHECK(cancelled);
}
