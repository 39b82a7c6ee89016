#include "method/pinned.h"

#include "accept/accept.h"
#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "method/solve.h"
#include "pins/led_pins.h"
#include "pins/released.h"
#include "pins/sharp_pins.h"
#include "pins/spread_pins.h"

namespace fairing {

namespace {

Solution with_pins(Solution solution, Pins pins) {
    solution.pins = pins;
    return solution;
}

bool is_of_fourth_order(const Problem& problem, const Solution& solution) {
    const Equation equation = problem.options.equation;
    return equation != Equation::soap_film && equation != Equation::least_variation && !stands_in(solution.provenance);
}

bool are_close(const Problem& problem, const Indices& pins, double distance) {
    for (std::size_t k = 0; k < pins.size(); ++k) {
        for (std::size_t l = 0; l < k; ++l) {
            if ((problem.fixed_points.col(pins[k]) - problem.fixed_points.col(pins[l])).norm() < distance) return true;
        }
    }
    return false;
}

Solution judged(const Problem& problem, Solution found) {
    found.from_surface = true;
    found.pins = Pins::spread;
    found.flaw = flaw_of(problem, found);
    return found;
}

Solution spread_from(const Problem& problem, double radius, const Points& start, const Progress& progress) {
    Solution found = spread_pins(problem, radius, start, progress);
    found.boundary_normals = one_sided_normals(problem.patch, found.points);
    return judged(problem, std::move(found));
}

}  // namespace

Indices pins_to_spread(const Problem& problem) {
    Indices pins = isolated_pins(problem.patch);
    if (static_cast<Eigen::Index>(pins.size()) == problem.fixed_points.cols()) pins.clear();
    return pins;
}

std::optional<Solution> lift_pins(const Problem& problem, double radius, std::optional<Points> guess,
                                  const Progress& progress) {
    const Released free = released(problem.patch, isolated_pins(problem.patch));
    const Solution without = solve_equation_alone(on_released(problem, free), progress.range(0.0, 0.5));
    if (end_of(without) != Termination::converged) return std::nullopt;
    const Points start = without.points(Eigen::all, free.to);
    Solution found = spread_from(problem, radius, start, progress.range(0.5, 0.6));
    if (found.flaw != Flaw::absent) {
        auto led = lead_pins(problem, radius, {start, std::move(guess)}, progress.range(0.6, 1.0));
        if (!led) return std::nullopt;
        found = judged(problem, std::move(*led));
        if (found.flaw != Flaw::absent) return std::nullopt;
    }
    found.initial_residual = without.initial_residual;
    found.seconds = without.seconds;
    return found;
}

Solution with_spread_pins(const Problem& problem, double radius, Solution sharp, const Progress& progress) {
    if (!(radius > 0.0) || !is_of_fourth_order(problem, sharp) || sharp.pins == Pins::spread) return sharp;
    const Indices all = isolated_pins(problem.patch);
    if (all.empty()) return sharp;
    if (end_of(sharp) != Termination::converged) return with_pins(std::move(sharp), Pins::no_surface);
    const Indices pins = pins_to_spread(problem);
    if (pins.empty()) return with_pins(std::move(sharp), Pins::no_outline);
    const Stopwatch watch;
    Solution found = spread_from(problem, radius, sharp.points, progress);
    if (found.flaw != Flaw::absent) {
        if (auto other = lift_pins(problem, radius, sharp.points, progress)) found = std::move(*other);
    }
    const double seconds = watch.seconds();
    sharp.seconds["pins"] = seconds;
    sharp.ways.push_back({"pins", seconds});
    if (found.flaw != Flaw::absent) {
        const bool close = are_close(problem, pins, 2.0 * radius);
        return with_pins(std::move(sharp), close ? Pins::too_close : Pins::not_found);
    }
    found.initial_residual = sharp.initial_residual;
    found.levels = sharp.levels;
    found.seconds = sharp.seconds;
    found.ways = sharp.ways;
    found.uniform_weights = sharp.uniform_weights;
    return found;
}

}  // namespace fairing
