#include "start/quick_surface.h"

#include <cmath>

#include "base/errors.h"
#include "operators/biharmonic_operator.h"
#include "operators/workspace.h"
#include "problem/free_slopes.h"
#include "problem/surface_state.h"
#include "problem/willmore.h"
#include "start/clamped_fill.h"
#include "start/globalisation.h"
#include "start/several_outlines.h"
#include "start/shape_before.h"

namespace fairing {

namespace {

// Each takes as long as a fill. The first one takes most of the way: caps of 90° are .15 D off before it, .05 behind
// it, .04 behind the second.
constexpr int descent_steps = 2;

std::optional<Points> harmonic_map(const Problem& problem, const Progress& progress) {
    Points points = Points::Zero(3, problem.patch.vertex_count());
    points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    return harmonic_between(problem.patch, std::move(points), progress);
}

class Fills {
public:
    Fills(const Problem& problem, const Progress& progress)
        : problem_(problem),
          progress_(progress),
          conormals_(conormals(problem.patch, problem.fixed_points, problem.fixed_normals)) {
        work_.normal = std::make_unique<BiharmonicOperator>(problem.patch);
    }

    void add(const Stiffness& stiffness) {
        const Patch& patch = problem_.patch;
        Points points(3, patch.vertex_count());
        try {
            const Fill fill =
                clamped_fill(patch, stiffness, problem_.fixed_points, conormals_, *work_.normal, progress_.here());
            points << fill.flat + fill.bulge, problem_.fixed_points;
        } catch (const SolverError&) {
            return;
        }
        add(std::move(points));
    }

    // All of the shape before is smoothed, and only what is shorter than half or a quarter of D: limbs keep their
    // girth, which a fill between their ends would draw to a thread.
    void add_low_passed(ShapeBefore shape) {
        for (const double wavelength : {HUGE_VAL, 0.5, 0.25}) {
            const VectorX everywhere = VectorX::Constant(problem_.patch.vertex_count(), wavelength);
            if (auto points = shape.smoothed(everywhere, progress_.here())) add(std::move(*points));
        }
    }

    // The best one of all, further down; nothing where there is none.
    std::optional<Points> descended() {
        for (int k = 0; k < descent_steps && best_.points.cols() > 0; ++k)
            keep_better(descent_step(problem_, work_, best_.points, progress_.here()));
        if (best_.points.cols() == 0 || !best_.points.allFinite()) return std::nullopt;
        return best_.points;
    }

private:
    void add(Points points) {
        const double energy = willmore_energy(problem_, points);
        keep_better({std::move(points), 0.0, energy});
    }

    void keep_better(DescentStep found) {
        if (found.energy < best_.energy) best_ = std::move(found);
    }

    const Problem& problem_;
    const Progress& progress_;
    Points conormals_;
    Workspace work_;
    DescentStep best_{{}, 0.0, HUGE_VAL};
};

std::optional<Points> least_bent_fill(const Problem& given, const std::optional<Points>& before,
                                      const Progress& progress) {
    std::optional<Points> slopes = given.patch.has_pins() ? before : std::nullopt;
    if (given.patch.has_pins() && !slopes) slopes = harmonic_map(given, progress);
    const Problem problem = slopes ? with_slopes_of(given, *slopes) : given;
    Fills fills(problem, progress);
    fills.add(uniform_stiffness(problem.patch));
    auto shape = joins_outlines(problem) ? ShapeBefore::of(problem, progress) : std::nullopt;
    if (shape) {
        fills.add_low_passed(std::move(*shape));
    } else if (before) {
        fills.add(bounded_stiffness(problem.patch, *before));
    }
    return fills.descended();
}

}  // namespace

std::optional<Points> quick_surface(const Problem& problem, const Progress& progress) {
    if (problem.options.equation == Equation::soap_film) return harmonic_map(problem, progress);
    return least_bent_fill(problem, shape_before(problem, progress), progress);
}

}  // namespace fairing
