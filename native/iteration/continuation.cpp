#include "iteration/continuation.h"

namespace fairing {

namespace {

Solution iterate_with_load(const Problem& problem, Workspace& work, const Points& start, double share,
                           const Progress& progress) {
    Problem stage = problem;
    stage.options.load *= share;
    if (share < 1.0) stage.options.tolerance = std::max(problem.options.tolerance, start_tolerance);
    return iterate(stage, work, start, progress);
}

Solution continue_load(const Problem& problem, Workspace& work, const Points& start, const Progress& progress) {
    Points reached = start;
    double share = 0.0;
    double increment = 1.0;
    Solution solution;
    // Share 0 is the harmonic surface, where every load begins.
    for (double wanted = 0.0;;) {
        solution = iterate_with_load(problem, work, reached, wanted, progress.range(share, wanted));
        if (solution.termination == Termination::converged) {
            if (wanted >= 1.0) return solution;
            reached = solution.points;
            share = wanted;
        } else {
            if (wanted == 0.0 || increment <= smallest_increment) break;
            increment *= 0.5;
        }
        wanted = std::min(1.0, share + increment);
    }
    // The last surface that was reached, with the residual of the whole load.
    Problem whole = problem;
    whole.options.max_iterations = 1;
    Solution given_up = iterate(whole, work, reached, progress);
    given_up.iterations = solution.iterations;
    given_up.termination = Termination::stalled;
    given_up.reached_load = share;
    return given_up;
}

}  // namespace

Solution solve_equation(const Problem& problem, Workspace& work, const Points& start, const Progress& progress) {
    if (problem.options.equation != Equation::constant || problem.options.load == 0.0) {
        return iterate(problem, work, start, progress);
    }
    return continue_load(problem, work, start, progress);
}

}  // namespace fairing
