// Which strategies a patch is solved by.
#include <doctest/doctest.h>

#include "meshes.h"
#include "method/plan.h"
#include "pipes.h"

using namespace fairing;

namespace {

// A patch of a sphere, or with noise in the normals of its boundary.
struct Asked {
    test::Single single;
    Problem problem;

    explicit Asked(int side, double radians = 0.0)
        : single(test::single_patch(test::grid(side, 0.2, test::sphere))),
          problem{single.patch(), fixed(), turned(fixed(), radians), uniform_weights(single.patch()), {}} {}

    [[nodiscard]] Points fixed() const {
        return single.points.rightCols(single.patch().vertex_count() - single.patch().free_count);
    }

    static Points turned(Points normals, double radians) {
        for (Eigen::Index k = 0; k < normals.cols(); ++k) {
            const double x = std::sin(12.9898 * static_cast<double>(k));
            normals.col(k) = (normals.col(k) + radians * Vector3(x, 0.5 * x, 0.0)).normalized();
        }
        return normals;
    }

    [[nodiscard]] std::string plan(bool lifts_pins = false) const {
        return text_of(plan_for(problem, Traits(problem), lifts_pins));
    }
};

}  // namespace

TEST_CASE("a small disc is solved on its own mesh before the engine's") {
    CHECK(Asked(12).plan() == "direct, own mesh | least variation, first surface");
}

TEST_CASE("a large disc is solved from coarse to fine") {
    CHECK(Asked(50).plan() == "levels, own mesh | least variation, first surface");
    Asked single_level(50);
    single_level.problem.options.nested = false;
    CHECK(single_level.plan() == "direct, own mesh | least variation, first surface");
}

TEST_CASE("between jagged loops the low-passed ones are next, and least variation never stands in") {
    CHECK(Asked(12, 2.0).plan() == "direct, own mesh, low-passed | first surface");
    CHECK(Asked(50, 2.0).plan() == "levels, own mesh, low-passed | first surface");
}

TEST_CASE("weights that are not uniform are given up before the boundary is") {
    Asked other(12, 2.0);
    other.problem.weights = RowWeights();
    CHECK(other.plan() == "direct, own mesh, uniform weights, low-passed | first surface");
}

TEST_CASE("pins that may have a radius are lifted before anything stands in") {
    CHECK(Asked(12).plan(true) == "direct, own mesh, lifted pins | least variation, first surface");
}

TEST_CASE("another equation than the harmonic one has a strategy of its own, and stop has no stand-in") {
    Asked asked(12);
    asked.problem.options.equation = Equation::soap_film;
    CHECK(asked.plan() == "direct | ");
    asked.problem.options.equation = Equation::least_variation;
    CHECK(asked.plan() == "least variation | ");
    asked.problem.options.equation = Equation::harmonic;
    asked.problem.options.otherwise = Otherwise::stop;
    CHECK(asked.plan() == "direct, own mesh | ");
}

TEST_CASE("between several loops the shape before stands in, and a loft where there is none") {
    test::Pipe pipe(8);
    const auto plan = [&] { return text_of(plan_for(pipe.problem, Traits(pipe.problem), false)); };
    CHECK(plan() == "direct, own mesh | least variation, loft, first surface");
    pipe.problem.before = pipe.single.points;
    CHECK(plan() == "direct, own mesh | least variation, old shape, loft, first surface");
    pipe.problem.fixed_normals = Asked::turned(pipe.problem.fixed_normals, 2.0);
    CHECK(plan() == "direct, own mesh | old shape, loft, first surface");
}

TEST_CASE("between loops that are no tubes' ends least variation does not stand in") {
    test::Pipe steep(8, 1.2);  // a ball between two small caps
    CHECK(text_of(plan_for(steep.problem, Traits(steep.problem), false)) == "direct, own mesh | loft, first surface");
    steep.problem.before = steep.single.points;
    CHECK(text_of(plan_for(steep.problem, Traits(steep.problem), false)) ==
          "direct, own mesh | old shape, loft, first surface");
}

TEST_CASE("between jagged loops far apart, whose membrane is poor, no mesh of the engine's own is made") {
    test::Pipe pipe(200);
    pipe.problem.before = pipe.single.points;
    pipe.problem.fixed_normals = Asked::turned(pipe.problem.fixed_normals, 2.0);
    const Traits traits(pipe.problem);
    CHECK(traits.poor_share_of_membrane() > 0.1);
    CHECK(text_of(plan_for(pipe.problem, traits, false)) == "levels | old shape, loft, first surface");
}

TEST_CASE("what coarse levels refuse between smooth loops the whole mesh may keep") {
    const test::Pipe pipe(60);
    CHECK(text_of(plan_for(pipe.problem, Traits(pipe.problem), false)) ==
          "levels, direct, own mesh | least variation, loft, first surface");
}
