#include "method/otherwise.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/stopwatch.h"
#include "geometry/self_intersection.h"
#include "method/accept.h"
#include "method/eased.h"
#include "method/ladder.h"
#include "method/lofted.h"
#include "method/sizes.h"
#include "method/smoothed.h"
#include "variation/least_variation.h"

namespace fairing {

namespace {

// Largest V · A from which a descent is tried. Between jagged outlines it reaches 10³ to 10⁵, and none was seen to end
// there. It is 95 for an elbow of 150°.
constexpr double most_to_try = 1000.0;
// Nor on larger patches with one outline, in 10 to 30 s each; small ones ended well from up to 2.5e4 on a coarse mesh.
// Those of 600 random patches that ended nowhere, after four beginnings, had 4e5 and more.
constexpr int largest_patient = 600;  // free vertices
constexpr double most_of_patient = 1e5;
constexpr double begin = 0.9;  // share of the progress; most solves end before

bool has_else(const Problem& problem) {
    const SolverOptions& options = problem.options;
    return options.otherwise == Otherwise::least_variation && options.equation != Equation::minimal &&
           options.equation != Equation::least_variation;
}

bool is_answer(const Solution& solution) { return end_of(solution) == Termination::converged; }

// On large patches the first attempt decides. Coarse meshes of those that end well show 1 to 10, of the others 2e4 and
// more.
VariationLimits limits_for(const Problem& problem, double most_product) {
    constexpr double most_of_large = 1e4;
    VariationLimits limits{most_product};
    if (!is_large(problem)) return limits;
    limits.most_product = std::min(most_product, most_of_large);
    limits.most_beginnings = 1;
    return limits;
}

VariationLimits limits_near(const Points& near, double most_product, bool roughly) {
    VariationLimits limits{most_product};
    limits.near = NearVariation{near, roughly};
    return limits;
}

// Solved as a way of its own, after those that the first solution tells of.
std::optional<Solution> least_variation(const Problem& problem, const Solution& first, const VariationLimits& limits,
                                        const Progress& progress) {
    // None was found between loops as jagged as those of scans: of 570 random patches it decides none.
    if (is_jagged(problem)) return std::nullopt;
    const Stopwatch watch;
    std::optional<Solution> even;
    try {
        even = solve_less_varying(problem, limits, progress);
    } catch (const SolverError&) {
        return std::nullopt;  // then the first one stays
    }
    if (!even) return std::nullopt;
    even->ways = first.ways;
    even->ways.push_back({"variation", watch.seconds()});
    even->provenance = Provenance::least_variation;
    even->flaw = flaw_of(problem, *even);
    return even;
}

// Of two that are not accepted, whatever is wrong with them.
bool is_better(const Problem& problem, const Solution& even, const Solution& first) {
    if (first.flaw != even.flaw) return even.flaw < first.flaw;
    const auto crossings = [&](const Solution& s) {
        return crossing_triangles(problem.patch.triangles, s.points).size();
    };
    const std::size_t before = crossings(first);
    const std::size_t after = crossings(even);
    if (before != after) return after < before;
    return !(variation_energy(problem, first.points) <= variation_energy(problem, even.points));
}

// Whether a descent that did not end is nearer to what is wanted than a loft: joints, and bends whose loft lies at
// their inner side. A tube swept along the bend is no farther from a torus than the place where descents stall, and is
// an answer.
bool is_evener(const Problem& problem, const Solution& even, const Solution& other) {
    if (!is_loft(other.provenance) || other.provenance == Provenance::swept_tube) return false;
    if (!crossing_triangles(problem.patch.triangles, even.points).empty()) return false;
    return variation_energy(problem, even.points) < variation_energy(problem, other.points);
}

// Over a jagged boundary a low-passed surface may cross itself at the loops where the shape before did not
// (method/accept).
bool is_crossing_beside(const Solution& solution) {
    return solution.provenance == Provenance::low_passed && solution.flaw == Flaw::crossing;
}

// The one place that decides what is handed out where no equation has a surface. `even`: a descent that did not end.
Solution handed_out(const Problem& problem, Solution first, std::optional<Solution> even,
                    std::optional<Solution> other) {
    if (other && !(even && is_evener(problem, *even, *other))) return std::move(*other);
    return even && is_better(problem, *even, first) ? std::move(*even) : std::move(first);
}

// Whether as many iterations as are usual were in vain, or the vertices fold: a loft costs little.
bool is_tried_enough(const Problem& problem, const Solution& solution) {
    constexpr int usual_iterations = 200;
    if (is_answer(solution) || solution.reached_load > 0.0) return false;
    return solution.termination != Termination::iteration_limit || problem.options.max_iterations >= usual_iterations;
}

// The shape before as smooth as it can be, where one is known, or a loft.
std::optional<Solution> without_equation(const Problem& problem, const Solution& first, const Progress& progress) {
    auto shape = smoothed(problem, first, progress);
    return shape ? std::move(shape) : lofted(problem, first, progress);
}

Solution instead_of_failure(const Problem& problem, Solution solution, const Progress& progress) {
    const bool is_patient = problem.patch.loop_count() == 1 && problem.patch.free_count <= largest_patient;
    const double most = is_patient ? most_of_patient : most_to_try;
    auto even = least_variation(problem, solution, limits_for(problem, most), progress);
    if (even && is_answer(*even)) return std::move(*even);
    if (even) solution.ways = even->ways;
    auto other = without_equation(problem, solution, progress);
    return handed_out(problem, std::move(solution), std::move(even), std::move(other));
}

}  // namespace

bool lacks_surface(const Solution& solution) {
    const bool cut_short = solution.termination == Termination::iteration_limit || solution.reached_load > 0.0;
    // Vertices that fold on the equation's surface would on another one, too: at 30,000 vertices the try cost 15 s.
    return !is_answer(solution) && !cut_short && solution.flaw != Flaw::folded;
}

Solution solve_or_else(const Problem& problem, const Progress& progress) {
    return or_else(problem, solve_global(problem, progress), progress);
}

Solution or_else(const Problem& problem, Solution solution, const Progress& progress) {
    if (!has_else(problem) || is_answer(solution)) return solution;
    const Progress rest = progress.range(begin, 1.0);
    if (is_crossing_beside(solution)) {
        auto shape = smoothed(problem, solution, rest);
        return shape ? std::move(*shape) : std::move(solution);
    }
    if (lacks_surface(solution)) return instead_of_failure(problem, std::move(solution), rest);
    auto other = is_tried_enough(problem, solution) ? without_equation(problem, solution, rest) : std::nullopt;
    return handed_out(problem, std::move(solution), std::nullopt, std::move(other));
}

std::optional<Solution> solve_else(const Problem& problem, Provenance kind, const Progress& progress,
                                   const Points* near) {
    if (is_loft(kind)) return lofted(problem, {}, progress);
    if (kind == Provenance::old_shape) return smoothed(problem, {}, progress);
    if (near) {
        auto even = least_variation(problem, {}, limits_near(*near, HUGE_VAL, false), progress);
        if (even && is_answer(*even)) return even;
    }
    if (near && problem.patch.loop_count() > 1) return lofted(problem, {}, progress);  // anew it took 20 s, for a loft
    auto even = least_variation(problem, {}, limits_for(problem, HUGE_VAL), progress);
    if (!even || !is_answer(*even)) return std::nullopt;
    return even;
}

std::optional<Solution> solve_else_roughly(const Problem& problem, const Points& near, const Progress& progress) {
    if (!has_else(problem) && problem.options.equation != Equation::least_variation) return std::nullopt;
    auto even = least_variation(problem, {}, limits_near(near, most_to_try, true), progress);
    if (!even || !is_answer(*even)) return std::nullopt;
    return even;
}

}  // namespace fairing
