// Several threads at once; `scripts/test --sanitize` runs these under the thread sanitizer.
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "api/fair.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "linear/sparse_cholesky.h"
#include "meshes.h"
#include "method/nested.h"

using namespace fairing;

namespace {

// A dented grid whose border is held; some of it round and so with a curvature to find.
struct DentedCap {
    explicit DentedCap(int n) : mesh(test::grid(n, 0.2, test::sphere)), input{mesh.points, mesh.triangles, {}, {}} {}
    test::Mesh mesh;
    MeshInput input;
};

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
    const DentedCap shared(8);
    const DentedCap other(6);
    const std::array<const MeshInput*, 4> inputs{&shared.input, &shared.input, &shared.input, &other.input};
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

TEST_CASE("threads: a loop runs every piece once, also within another loop") {
    for (const int threads : {1, 2, 5}) {
        const Threads team(threads);
        std::vector<int> calls(1000, 0);
        run_pieces(10, [&](int outer) { run_pieces(100, [&](int k) { ++calls[100 * outer + k]; }); });
        CHECK(calls == std::vector<int>(1000, 1));
        run_pieces(0, [&](int) { FAIL("there is no piece"); });
    }
}

TEST_CASE("threads: ranges cover all indices and sums don't depend on the threads") {
    std::vector<double> values(10001);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = 1.0 / static_cast<double>(k + 1);
    const auto sum = [&] {
        return sum_over_ranges(static_cast<int>(values.size()), 100, [&](int begin, int end) {
            return std::accumulate(values.begin() + begin, values.begin() + end, 0.0);
        });
    };
    const double alone = sum();
    CHECK(alone == doctest::Approx(std::accumulate(values.begin(), values.end(), 0.0)).epsilon(1e-14));
    for (const int threads : {1, 2, 3}) {
        const Threads team(threads);
        CHECK(sum() == alone);
    }
}

TEST_CASE("threads: the exception of a piece comes through and the next loop runs") {
    const Threads team(3);
    for (int round = 0; round < 20; ++round) {
        std::atomic<int> calls = 0;
        CHECK_THROWS_AS(run_pieces(50,
                                   [&](int k) {
                                       ++calls;
                                       if (k == 7) throw std::runtime_error("piece 7");
                                   }),
                        std::runtime_error);
        CHECK(calls >= 8);
        std::atomic<int> sum = 0;
        run_pieces(50, [&](int k) { sum += k; });
        CHECK(sum == 49 * 25);
    }
}
