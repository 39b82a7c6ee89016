#include "method/pinned.h"

#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "method/accept.h"
#include "pins/spread_pins.h"

namespace fairing {

namespace {

Solution with_pins(Solution solution, Pins pins) {
    solution.pins = pins;
    return solution;
}

bool is_of_fourth_order(const Problem& problem, const Solution& solution) {
    const Equation equation = problem.options.equation;
    return equation != Equation::minimal && equation != Equation::least_variation && !solution.instead;
}

bool are_close(const Problem& problem, const Indices& pins, double distance) {
    for (std::size_t k = 0; k < pins.size(); ++k) {
        for (std::size_t l = 0; l < k; ++l) {
            if ((problem.fixed_points.col(pins[k]) - problem.fixed_points.col(pins[l])).norm() < distance) return true;
        }
    }
    return false;
}

}  // namespace

Solution with_spread_pins(const Problem& problem, double radius, Solution sharp, const Progress& progress) {
    if (!(radius > 0.0) || !is_of_fourth_order(problem, sharp)) return sharp;
    const Indices pins = isolated_pins(problem.patch);
    if (pins.empty()) return sharp;
    if (end_of(sharp) != Termination::converged) return with_pins(std::move(sharp), Pins::no_surface);
    // Nothing but pins holds the patch: without them there is no surface that they could lift.
    if (static_cast<Eigen::Index>(pins.size()) == problem.fixed_points.cols())
        return with_pins(std::move(sharp), Pins::no_outline);
    const Stopwatch watch;
    Solution found = spread_pins(problem, radius, sharp.points, progress);
    const double seconds = watch.seconds();
    sharp.seconds["pins"] = seconds;
    sharp.ways.push_back({"pins", seconds});
    found.boundary_normals = one_sided_normals(problem.patch, found.points);
    found.from_surface = true;
    found.flaw = flaw_of(problem, found);
    if (found.flaw != Flaw::absent) {
        const bool close = are_close(problem, pins, 2.0 * radius);
        return with_pins(std::move(sharp), close ? Pins::too_close : Pins::not_found);
    }
    found.initial_residual = sharp.initial_residual;
    found.levels = sharp.levels;
    found.seconds = sharp.seconds;
    found.ways = sharp.ways;
    found.even_weights = sharp.even_weights;
    found.pins = Pins::spread;
    return found;
}

}  // namespace fairing
