#include <doctest/doctest.h>

#include <cmath>

#include "meshes.h"
#include "paper/convergence.h"
#include "paper/level_update.h"

using namespace fairing;

TEST_CASE("what remains of a geometric sequence is not underestimated, nor by much overestimated") {
    for (const double contraction : {0.81, 0.9, 0.99}) {
        RemainingChange remaining;
        double step = 1.0;
        for (int k = 0; k < 20; ++k) remaining.add(step *= contraction);
        const double tail = step * contraction / (1.0 - contraction);
        CHECK(remaining.estimate() >= tail);
        // The step is the largest of the last three.
        CHECK(remaining.estimate() == doctest::Approx(tail / (contraction * contraction)));
    }
}

TEST_CASE("nothing is said about what remains before there are four steps") {
    RemainingChange remaining;
    for (int k = 0; k < 3; ++k) {
        remaining.add(1e-12);
        CHECK(std::isinf(remaining.estimate()));
    }
    remaining.add(0.0);
    CHECK(std::isfinite(remaining.estimate()));
}

TEST_CASE("the share that is done grows from 0 to 1 as the estimate falls to the tolerance") {
    RemainingChange remaining;
    double last = 0.0;
    double step = 1.0;
    for (int k = 0; k < 60; ++k) {
        remaining.add(step *= 0.7);
        CHECK(remaining.share_done(1e-6) >= last - 1e-12);
        last = remaining.share_done(1e-6);
    }
    CHECK(last == 1.0);
}

TEST_CASE("two updates that undo each other are no convergence") {
    ProgressWatch watch(true);
    Verdict verdict = Verdict::fair;
    for (int k = 0; k < 5; ++k) verdict = watch.judge({1e-2, 1e-8, 1e-2});
    CHECK(verdict == Verdict::alternating);
}

TEST_CASE("a plain iteration whose residual grows or rests alternates, one that falls does not") {
    const auto last_verdict = [](double factor) {
        ProgressWatch watch(false);
        double residual = 1.0;
        Verdict verdict = Verdict::fair;
        for (int k = 0; k < 40 && verdict != Verdict::alternating; ++k) {
            verdict = watch.judge({1e-3, 1e-3, residual *= factor});
        }
        return verdict;
    };
    CHECK(last_verdict(1.1) == Verdict::alternating);
    CHECK(last_verdict(0.9999) == Verdict::alternating);
    CHECK(last_verdict(0.9) == Verdict::better);
}

TEST_CASE("what is not finite is lost") {
    ProgressWatch watch(true);
    CHECK(watch.judge({1.0, 1.0, std::nan("")}) == Verdict::lost);
}

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
