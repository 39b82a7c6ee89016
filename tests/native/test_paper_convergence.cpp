#include <doctest/doctest.h>

#include <cmath>

#include "meshes.h"
#include "paper/convergence.h"
#include "paper/level_update.h"

using namespace fairing;

namespace {

// A jittered spherical patch with exact normals on its border, scaled to D = 1.
struct Setting {
    test::Single single = test::single_patch(test::grid(8, 0.2, test::sphere));
    Points normals = single.points.rightCols(single.patch().vertex_count() - single.patch().free_count);
    SolverOptions solver;
    PaperOptions paper;

    [[nodiscard]] LevelProblem level(bool completed) const {
        return {
            single.patch(), normals, solver, paper, row_weights(single.patch(), single.points, InnerFairness::uniform),
            completed};
    }
};

}  // namespace

TEST_CASE("virtual points join at valence 3 and 4, at fixed vertices, and elsewhere where asked for") {
    const Setting s;
    const Patch& patch = s.single.patch();
    for (int i = 0; i < patch.vertex_count(); ++i) {
        CHECK(s.level(true).disk(i).completed);
        CHECK(s.level(false).disk(i).completed == (patch.ring(i).valence() < 5 || !patch.is_free(i)));
    }
}

TEST_CASE("updates smooth the curvature and leave fixed vertices alone") {
    const Setting s;
    const LevelProblem level = s.level(true);
    Points noisy = s.single.points;
    for (int i = 0; i < s.single.patch().free_count; ++i) noisy.col(i) *= 1.0 + 0.01 * std::sin(37.0 * i);
    LevelUpdate update(level, noisy);
    const double before = update.measure();
    for (int k = 0; k < 4; ++k) {
        update.local(0.5);
        update.measure();
    }
    CHECK(update.measure() < 0.2 * before);
    const auto fixed = s.normals.cols();
    CHECK(update.points().rightCols(fixed) == noisy.rightCols(fixed));
}
