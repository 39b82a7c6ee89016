#include "method/solve.h"

#include "accept/accept.h"
#include "base/errors.h"
#include "base/stopwatch.h"
#include "geometry/self_intersection.h"
#include "geometry/surface_fit.h"
#include "method/direct.h"
#include "method/nested.h"
#include "method/proxy_surface.h"
#include "problem/surface_state.h"
#include "shape/girth.h"
#include "stand_in/stand_in.h"
#include "variation/least_variation.h"

namespace fairing {

namespace {

using Found = std::optional<Solution>;

bool is_answer(const Solution& solution) { return end_of(solution) == Termination::converged; }

// Largest product of variation and area from which a descent is tried: 95 for an elbow of 150°, and none was seen to
// end from there on between several loops. Small discs ended well from up to 2.5e4; those of 600 random patches that
// did not, after four beginnings, had 4e5 and more.
constexpr double most_product = 1e3;
VariationLimits limits_for(const Problem& problem) {
    const bool is_patient = problem.patch.loop_count() == 1 && problem.patch.free_count <= coarsest_size;
    return {is_patient ? 1e5 : most_product};
}

Found least_variation(const Problem& problem, const VariationLimits& limits, const Progress& progress) {
    Found found;
    try {
        found = solve_less_varying(problem, limits, progress);
    } catch (const SolverError&) {
        return std::nullopt;  // then the other surfaces are left
    }
    if (found) found->provenance = Provenance::least_variation;
    return found;
}

Found solve_uniform_weights(const Problem& problem, const Progress& progress) {
    Problem uniform = problem;
    uniform.weights = uniform_weights(problem.patch);
    uniform.tolerated_folds = 0;
    Solution solution = solve_equation_alone(uniform, progress);
    if (solution.flaw != Flaw::absent) return std::nullopt;
    solution.uniform_weights = true;
    return solution;
}

// What is left open by a strategy that gave up early, and by a surface at given points.
void complete(const Problem& problem, Solution& solution) {
    if (solution.mean_curvature.size() > 0) return;
    const SurfaceState state = measured_surface(problem, solution.points);
    solution.mean_curvature = state.curvature.mean;
    if (stands_in(solution.provenance)) return;
    solution.residual = largest_residual(problem, state, outer_residual(problem, state));
    solution.boundary_normals = one_sided_normals(problem.patch, solution.points);
}

// Whether the caller's own limit ended the iteration.
bool has_run_out(const Problem& problem, const Solution& solution) {
    return problem.options.max_iterations < SolverOptions{}.max_iterations &&
           solution.termination == Termination::iteration_limit;
}

class PlanRun {
public:
    PlanRun(const Problem& problem, const Progress& progress)
        : problem_(problem), progress_(progress), traits_(problem), plan_(plan_for(problem, traits_)) {}

    // Between the loops as they are.
    Solution alone() {
        std::erase(plan_.equation, Step::low_passed);
        return equation();
    }

    Solution equation() {
        for (const Step step : plan_.equation) {
            if (!is_wanted(step)) continue;
            if (Found solution = attempt(step)) return finished(std::move(*solution));
            if (!attempts_.found.empty() && has_run_out(problem_, attempts_.found.back())) break;
        }
        return finished(best());
    }

    // `varied`: least variation was tried.
    Solution stand_in(Solution first, bool varied = false) {
        attempts_.log = first.strategies;
        const bool may_replace = !is_answer(first) && first.reached_load == 0.0 && !has_run_out(problem_, first);
        if (!may_replace) return first;
        const bool is_found = first.flaw == Flaw::folded;  // only its vertices fold: they would on another one, too
        attempts_.found.clear();
        attempts_.found.push_back(std::move(first));
        for (const Step step : plan_.stand_ins) {
            if ((is_found || varied) && step == Step::least_variation) continue;
            if (Found solution = attempt(step)) return finished(std::move(*solution));
            if (!attempts_.found.empty() && is_answer(attempts_.found.back())) break;
        }
        return finished(best());
    }

private:
    // Other weights help where vertices turned over.
    [[nodiscard]] bool is_wanted(Step step) const {
        if (step != Step::uniform_weights) return true;
        return std::any_of(attempts_.found.begin(), attempts_.found.end(),
                           [](const Solution& s) { return s.flaw == Flaw::folded || s.flaw == Flaw::crossing; });
    }

    // The solution of a step where it is accepted; kept aside otherwise.
    Found attempt(Step step) {
        const Stopwatch watch;
        const double begin = 1.0 - std::pow(0.5, static_cast<double>(attempts_.log.size()));
        Found solution = carried_out(step, progress_.range(begin, 1.0));
        attempts_.log.push_back({name_of(step), watch.seconds()});
        if (!solution) return std::nullopt;
        solution->flaw = flaw_of(problem_, *solution);
        if (is_final(problem_, *solution)) return solution;
        // One that folds says less of the boundary than what the equation has left.
        if (step == Step::first_surface && !is_answer(*solution)) return std::nullopt;
        attempts_.found.push_back(std::move(*solution));
        return std::nullopt;
    }

    Found carried_out(Step step, const Progress& progress) {
        switch (step) {
            case Step::levels: {
                Found solution = solve_nested(problem_, traits_, progress);
                const bool has_other = std::count(plan_.equation.begin(), plan_.equation.end(), Step::direct) > 0;
                return solution || has_other ? std::move(solution) : try_directly(problem_, progress);
            }
            case Step::direct: {
                const bool is_all = problem_.options.equation == Equation::soap_film;
                return is_all ? solve_directly(problem_, progress) : try_directly(problem_, progress);
            }
            case Step::proxy_mesh: return solve_on_proxy_mesh(problem_, traits_, attempts_, progress);
            case Step::uniform_weights: return solve_uniform_weights(problem_, progress);
            case Step::low_passed: return solve_low_passed(problem_, traits_, attempts_, progress);
            case Step::least_variation:
                if (problem_.options.equation == Equation::least_variation)
                    return solve_least_variation(problem_, progress);
                return least_variation(problem_, limits_for(problem_), progress);
            case Step::old_shape: return smoothed(problem_, progress);
            case Step::loft: return lofted(problem_, progress);
            case Step::first_surface: break;
        }
        return solution_at(problem_, first_surface(problem_, progress), Provenance::first_surface);
    }

    // Converged ones come first, by what is wrong with them.
    Solution best() {
        std::vector<Solution>& found = attempts_.found;
        const auto best = std::min_element(found.begin(), found.end(), [&](const Solution& a, const Solution& b) {
            if (a.flaw != b.flaw) return a.flaw < b.flaw;
            return a.flaw == Flaw::not_converged && less_bent(problem_, a, b);
        });
        Solution solution = std::move(*best);
        found.erase(best);
        return solution;
    }

    Solution finished(Solution solution) {
        complete(problem_, solution);
        solution.strategies = attempts_.log;
        return solution;
    }

    const Problem& problem_;
    const Progress& progress_;
    const Traits traits_;
    Plan plan_;
    Attempts attempts_;
};

Found answer(const Problem& problem, Found solution, const char* name, const Stopwatch& watch) {
    if (!solution) return std::nullopt;
    solution->flaw = flaw_of(problem, *solution);
    solution->strategies = {{name, watch.seconds()}};
    if (!is_answer(*solution)) return std::nullopt;
    complete(problem, *solution);
    return solution;
}

// How far a surface misses the girth of its ends, in what is bearable: a tenth thinner, four tenths thicker. Far more
// where it passes through itself, infinite where it is no answer.
double lost_girth(const Problem& problem, const Solution& solution) {
    constexpr double thinner = 0.1;         // a waist is seen from there on
    constexpr double thicker = 0.4;         // a swelling is kept sooner than a waist
    constexpr double for_crossings = 10.0;  // more than any girth costs
    if (!is_answer(solution)) return HUGE_VAL;
    const auto girth = girth_range(problem.patch, solution.points);
    const bool crosses = !crossing_triangles(problem.patch.triangles, solution.points).empty();
    const double lost = girth ? std::max((1.0 - girth->least) / thinner, (girth->largest - 1.0) / thicker) : 0.0;
    return crosses ? for_crossings + lost : lost;
}
constexpr double kept_girth = 0.1;  // lost girth of which no other surface need be sought

Found alone(const Problem& problem, const Progress& progress) {
    try {
        return solve_equation_alone(problem, progress);
    } catch (const SolverError&) {
        return std::nullopt;  // then the other surfaces are left
    }
}

}  // namespace

Solution solve(const Problem& problem, double pin_radius, const Progress& progress) {
    const bool is_lifted = pin_radius > 0.0 && !pins_to_spread(problem).empty();
    if (is_lifted) {
        if (Found lifted = lift_pins(problem, pin_radius, progress.range(0.0, 0.5))) return std::move(*lifted);
    }
    const Progress rest = progress.range(is_lifted ? 0.5 : 0.0, 1.0);
    PlanRun run(problem, rest);
    Solution solution = run.stand_in(run.equation());
    if (is_lifted && !stands_in(solution.provenance)) solution.pins = Pins::not_found;
    return solution;
}

Solution solve_automatically(Problem& problem, double pin_radius, const Near& near, const Progress& progress) {
    const Traits traits(problem);
    Found begun = near(problem, progress.range(0.0, 0.2));
    const Progress rest = progress.range(begun ? 0.2 : 0.0, 1.0);
    if (!traits.is_tube || !traits.is_between_tubes)
        return begun ? std::move(*begun) : solve(problem, pin_radius, rest);
    const Progress beginning = rest.range(0.0, 0.4);
    PlanRun harmonic(problem, beginning);
    Solution first = begun ? std::move(*begun) : harmonic.equation();
    Solution best = first;
    double least = lost_girth(problem, best);
    std::vector<StrategyTried> strategies = first.strategies;
    Problem other = problem;
    for (const Equation equation : {Equation::minimal_energy, Equation::least_variation}) {
        if (least <= kept_girth || has_run_out(problem, best)) break;
        if (equation == Equation::least_variation && traits.is_jagged) continue;
        other.options.equation = equation;
        const Progress part = rest.range(equation == Equation::minimal_energy ? 0.4 : 0.6, 0.8);
        Found found = near(other, part);
        if (!found) found = alone(other, part);
        if (!found) continue;
        strategies.insert(strategies.end(), found->strategies.begin(), found->strategies.end());
        const double lost = lost_girth(problem, *found);
        if (lost >= least) continue;
        least = lost;
        best = std::move(*found);
        problem.options.equation = equation;
    }
    if (least == HUGE_VAL) return harmonic.stand_in(std::move(first), true);
    best.strategies = std::move(strategies);
    return best;
}

Solution solve_equation_alone(const Problem& problem, const Progress& progress) {
    return PlanRun(problem, progress).alone();
}

std::optional<Solution> solve_stand_in(const Problem& problem, Provenance kind, const Progress& progress,
                                       const Points* near) {
    const Stopwatch watch;
    if (kind == Provenance::equation)
        return answer(problem, try_directly(problem, progress), name_of(Step::direct), watch);
    if (is_loft(kind)) return answer(problem, lofted(problem, progress), name_of(Step::loft), watch);
    if (kind == Provenance::old_shape)
        return answer(problem, smoothed(problem, progress), name_of(Step::old_shape), watch);
    if (kind == Provenance::first_surface) {
        const Points points = near ? *near : first_surface(problem, progress);
        Solution first = solution_at(problem, points, Provenance::first_surface);
        return answer(problem, std::move(first), name_of(Step::first_surface), watch);
    }
    if (Traits(problem).is_jagged) return std::nullopt;
    VariationLimits limits = limits_for(problem);
    limits.most_product = HUGE_VAL;  // it was asked for
    if (near) {
        VariationLimits close_by{HUGE_VAL};
        close_by.near = NearVariation{*near, false};
        Found found =
            answer(problem, least_variation(problem, close_by, progress), name_of(Step::least_variation), watch);
        if (found) return found;
        // Anew it took 20 s between several loops, for a loft.
        if (problem.patch.loop_count() > 1)
            return answer(problem, lofted(problem, progress), name_of(Step::loft), watch);
    }
    return answer(problem, least_variation(problem, limits, progress), name_of(Step::least_variation), watch);
}

std::optional<Solution> solve_stand_in_roughly(const Problem& problem, const Points& near, const Progress& progress) {
    const SolverOptions& options = problem.options;
    const bool wanted = options.equation == Equation::least_variation ||
                        (options.otherwise == Otherwise::least_variation && options.equation != Equation::soap_film);
    if (!wanted || Traits(problem).is_jagged) return std::nullopt;
    const Stopwatch watch;
    VariationLimits limits{most_product};
    limits.near = NearVariation{near, true};
    return answer(problem, least_variation(problem, limits, progress), name_of(Step::least_variation), watch);
}

}  // namespace fairing
