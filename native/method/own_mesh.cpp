#include "method/own_mesh.h"

#include "base/stopwatch.h"
#include "method/coarse_own_mesh.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

// A coarse level's vertices would lose which of a tube's surfaces a solved one is.
bool begins_coarse(const Traits& traits, const std::optional<OwnSurface>& guess) {
    return traits.is_large && !(traits.is_tube && guess && guess->solved);
}

std::optional<OwnSurface> left_by(const Attempts& attempts) {
    const Solution* own = attempts.own_connectivity();
    if (!own || !own->points.allFinite()) return std::nullopt;
    return OwnSurface{own->points, own->termination == Termination::converged};
}

// On a mesh made from the problem's own connectivity.
class FineOwnMesh {
public:
    FineOwnMesh(const Problem& problem, const Progress& progress)
        : problem_(problem),
          progress_(progress),
          membrane_(proxy_membrane(problem, progress)),
          start_(measured_surface(problem, membrane_)) {}

    Solution solved(const std::optional<OwnSurface>& guess) {
        std::optional<Points> own;
        if (guess) own = guess->points;
        const SolvedProxy proxy = solved_proxy(guess && guess->is_start(problem_) ? own : std::nullopt);
        const TargetSurface target(proxy.mesh.patch, proxy.mesh.points, proxy.normals);
        Workspace work{make_normal_operator(problem_), tangential_step()};
        const auto put = proxy.converged() ? place : place_roughly;
        const Placed placed =
            put(problem_, *work.tangential, {proxy.history, proxy.mesh, target}, own, progress_.range(0.6, 0.8));
        Solution solution = placed_solution(problem_, proxy, target, placed);
        seconds_["placement"] = watch_.lap();
        if (solution.termination == Termination::converged)
            solution = polished(problem_, work, std::move(solution), surface_of(proxy, target, placed.placement),
                                progress_.range(0.8, 1.0));
        seconds_["polish"] = watch_.lap();
        return finished(std::move(solution));
    }

    std::optional<Solution> placed_alone() {
        const SolvedProxy proxy = solved_proxy(std::nullopt);
        if (!proxy.converged()) return std::nullopt;
        const TargetSurface target(proxy.mesh.patch, proxy.mesh.points, proxy.normals);
        const auto tangential = tangential_step();
        const Placed placed =
            place(problem_, *tangential, {proxy.history, proxy.mesh, target}, std::nullopt, progress_.range(0.6, 0.8));
        return finished(placed_solution(problem_, proxy, target, placed));
    }

private:
    SolvedProxy solved_proxy(const std::optional<Points>& guess) {
        seconds_["fill"] = watch_.lap();
        SolvedProxy proxy =
            solve_proxy(problem_, guess, membrane_, problem_.patch.free_count, progress_.range(0.0, 0.6));
        seconds_["proxy"] = watch_.lap();
        return proxy;
    }

    [[nodiscard]] std::unique_ptr<TangentialStep> tangential_step() const {
        return make_tangential_step(problem_.patch, problem_.weights, problem_.fixed_points, progress_.here());
    }

    Solution finished(Solution solution) {
        solution.initial_residual = largest_residual(problem_, start_, outer_residual(problem_, start_));
        solution.seconds = std::move(seconds_);
        return solution;
    }

    const Problem& problem_;
    const Progress& progress_;
    Stopwatch watch_;
    std::map<std::string, double> seconds_;
    Points membrane_;
    SurfaceState start_;
};

// Found once for all steps.
const CoarseStart& start_of(const Problem& problem, const Traits& traits, Attempts& attempts,
                            const Progress& progress) {
    if (!attempts.start) attempts.start = std::make_shared<const CoarseStart>(problem, traits, progress);
    return *attempts.start;
}

}  // namespace

std::optional<Solution> solve_on_own_mesh(const Problem& problem, const Traits& traits, Attempts& attempts,
                                          const Progress& progress) {
    const auto guess = left_by(attempts);
    if (begins_coarse(traits, guess)) {
        const CoarseStart& start = start_of(problem, traits, attempts, progress);
        if (start.is_in_vain() && !attempts.found.empty()) return std::nullopt;
        if (auto solution = solve_on_coarse_own_mesh(problem, guess, start, progress)) return solution;
    }
    return FineOwnMesh(problem, progress).solved(guess);
}

std::optional<Solution> place_on_own_mesh(const Problem& problem, const Traits& traits, Attempts& attempts,
                                          const Progress& progress) {
    if (!traits.is_large) return FineOwnMesh(problem, progress).placed_alone();
    const CoarseStart& start = start_of(problem, traits, attempts, progress);
    return start.is_in_vain() ? std::nullopt : place_on_coarse_own_mesh(problem, start, progress);
}

}  // namespace fairing
