// Where the proxies of large patches with a jagged outline begin.
#include <cmath>

#include <doctest/doctest.h>

#include "meshes.h"
#include "method/nested.h"
#include "method/one_level.h"
#include "method/proxy_start.h"

using namespace fairing;

namespace {

// More than 5,000 free vertices of a sphere, the normals of whose outline turn by up to `radians`.
struct Rough {
    test::Single single = test::single_patch(test::grid(74, 0.2, test::sphere));
    Problem problem;

    explicit Rough(double radians)
        : problem{single.patch(), fixed(), turned(fixed(), radians), uniform_weights(single.patch()), {}} {}

    [[nodiscard]] Points fixed() const {
        return single.points.rightCols(single.patch().vertex_count() - single.patch().free_count);
    }

    static Points turned(Points normals, double radians) {
        for (Eigen::Index k = 0; k < normals.cols(); ++k) {
            const double x = std::sin(12.9898 * static_cast<double>(k));
            const double y = std::sin(78.233 * static_cast<double>(k));
            normals.col(k) = (normals.col(k) + radians * Vector3(x, y, 0.0)).normalized();
        }
        return normals;
    }

    // As a way leaves it whose finest level has ended nowhere.
    [[nodiscard]] Situation led() const {
        Situation situation;
        Solution& left = situation.found.emplace_back();
        left.points = single.points;
        left.leads = true;
        return situation;
    }
};

double largest_off_sphere(const Points& points) { return (points.colwise().norm().array() - 1.0).abs().maxCoeff(); }

// A start that is none.
std::shared_ptr<const ProxyStart> none_found(const Rough& rough) {
    CoarseProxy far{ProxyMesh(rough.single.patch(), rough.single.points), CoarseEnd::far};
    return std::make_shared<const ProxyStart>(ProxyStart{std::move(far), rough.single.points, false});
}

}  // namespace

TEST_CASE("proxies begin where a coarse level of the mesh has led, once") {
    const Rough rough(0.6);
    Situation situation = rough.led();
    find_start(rough.problem, situation, Progress());
    REQUIRE(situation.start);
    CHECK(situation.start->led);
    REQUIRE(situation.start->found());
    const auto mesh = situation.start->proxy.mesh.snapshot();
    CHECK(mesh.patch.free_count < rough.problem.patch.free_count / 4);
    CHECK(largest_off_sphere(mesh.points) < 0.02);
    const auto before = situation.start;
    find_start(rough.problem, situation, Progress());
    CHECK(situation.start == before);
}

TEST_CASE("without a lead proxies begin over the eased outline, where that is jagged") {
    const Rough rough(0.6);
    Situation situation;
    find_start(rough.problem, situation, Progress());
    REQUIRE(situation.start);
    CHECK(!situation.start->led);
    REQUIRE(situation.start->found());
    CHECK(largest_off_sphere(situation.start->proxy.mesh.snapshot().points) < 0.02);
    Situation smooth;
    find_start(Rough(0.0).problem, smooth, Progress());
    CHECK(!smooth.start);
}

TEST_CASE("no proxy is solved where there is no start, if anything was found before") {
    const Rough rough(0.6);
    Situation situation = rough.led();
    situation.start = none_found(rough);
    CHECK(!on_proxy().solve(rough.problem, situation, Progress()));
    Situation empty;
    empty.start = none_found(rough);
    CHECK(on_proxy().solve(rough.problem, empty, Progress()));
}

TEST_CASE("a mesh leads whose finest level ends nowhere and a coarser one has the surface") {
    const Rough met(0.6);
    const Rough missed(2.0);
    const auto solution = solve_nested(met.problem, Progress());
    REQUIRE(solution);
    CHECK(solution->termination == Termination::converged);
    CHECK(!solution->leads);
    const auto left = solve_nested(missed.problem, Progress());
    REQUIRE(left);
    CHECK(left->termination == Termination::stalled);
    CHECK(left->leads);
    CHECK(largest_off_sphere(left->points) < 0.05);
}
