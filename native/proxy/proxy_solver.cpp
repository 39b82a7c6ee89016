#include "proxy/proxy_solver.h"

#include "iteration/continuation.h"
#include "operators/biharmonic_operator.h"
#include "operators/normal_operator.h"
#include "problem/surface_state.h"
#include "start/clamped_fill.h"
#include "start/globalisation.h"

namespace fairing {

namespace {

constexpr double finest_growth = 0.15;   // of edge lengths per distance from the boundary
constexpr double longest_coarse = 0.15;  // units of D
constexpr double longest_fine = 0.03;    // likewise

// Iterations of fine proxies. Of 191 over regions of scans that converged none stayed far from a surface so long, of 96
// that did not 73; of 800 small patches one lost its surface, which took 131 steps.
constexpr int soon = 8;

bool is_small(int shown) { return shown <= smallest_large; }

// Small patches with one boundary nearly always have a solution, and all patience pays.
bool pays_patience(const Problem& problem, int shown) { return problem.patch.loop_count() == 1 && is_small(shown); }

// Limits are counted at the default tolerance, and steps shrink geometrically: tighter ones take as many again.
int most_iterations_to(double tolerance, int usual) {
    constexpr double first_step = 1e-2;  // units of D
    const double decades = std::log10(first_step / tolerance) / std::log10(first_step / SolverOptions{}.tolerance);
    return static_cast<int>(usual * std::max(decades, 1.0));
}

// Whether what a proxy comes to says what others would.
bool tells(const Problem& problem, int shown) { return shown >= smallest_telling && problem.patch.loop_count() == 1; }

// Among regions of scans with one boundary and 5,000 free vertices or more whose coarse proxy did not converge, those
// with a step of 2e-5 to 3e-4 D were found on the fine one, those of 7e-4 to .3 were not. One of 2,800, whose coarse
// proxy has 300, was found from 7e-3.
CoarseEnd end_of(const Solution& solution, const Problem& problem, int shown) {
    if (solution.termination == Termination::converged) return CoarseEnd::converged;
    return tells(problem, shown) && solution.least_step > near_step ? CoarseEnd::far : CoarseEnd::near;
}

// A problem on the proxy's own connectivity: uniform weights, the same boundary data.
Problem proxy_problem(const Problem& problem, int shown, const Patch& patch) {
    Problem result{patch, problem.fixed_points, problem.fixed_normals, uniform_weights(patch), problem.options};
    if (pays_patience(problem, shown)) return result;
    result.conduct.limits = brisk;
    result.conduct.limits.steps = most_iterations_to(problem.options.tolerance, brisk.steps);
    return result;
}

// Only a start is wanted from the coarse proxy: the harmonic surface, whatever the equation.
Problem coarse_problem(const Problem& problem, int shown, const Patch& patch) {
    Problem result = proxy_problem(problem, shown, patch);
    result.options.equation = Equation::harmonic;
    result.options.tolerance = SolverOptions{}.tolerance;
    return result;
}

Workspace make_workspace(const Problem& problem, const Progress& progress) {
    return {std::make_unique<BiharmonicOperator>(problem.patch),
            make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())};
}

struct Fineness {
    double growth;
    double share_of_boundary;  // longest edge of the fine proxy, in edges of the boundary
};

// Between several loops the second one alone: others find 4 of 129 in as much time again as all else takes. The first
// one is the most accurate: its interior is fine, whatever the boundary. Of 153 patches it leads to a surface
// on 104, the second one on these and eleven more, the third one on thirteen of the others.
constexpr Fineness first_fineness{0.5, 0.0};
constexpr Fineness second_fineness{0.5, 0.35};  // likewise
constexpr Fineness third_fineness{0.12, 0.35};  // likewise

class ProxySolve {
public:
    ProxySolve(const Problem& problem, int shown, const Progress& progress)
        : problem_(problem), shown_(shown), progress_(progress), free_limit_(free_limit(shown)) {}

    std::optional<SolvedProxy> from_surface(const Points& surface) {
        return solve_fine(ProxyMesh(problem_.patch, surface), fine_sizing(shown_), true);
    }

    // Lengths that grow slowly need more vertices but resolve more. Where the boundary is coarse, the slivers between
    // it and a fine interior may keep the iteration from converging: then the interior is coarse, too. Meshes whose
    // edges grow alike begin with one coarse proxy. Where that ends nowhere the finest interior is left out: of 20
    // small patches it led on to a surface on seven, and so did the next one on these.
    std::optional<SolvedProxy> from_coarse(std::optional<CoarseProxy> begun, const Points& membrane) {
        if (!begun) begun = coarse(membrane, first_fineness);
        if (begun->end == CoarseEnd::far) return std::nullopt;  // a fine one would not be found
        const std::vector<Fineness> meshes = tried();
        for (std::size_t k = 0; k < meshes.size(); ++k) {
            if (k > 0 && meshes[k].growth != meshes[k - 1].growth) begun = coarse(membrane, meshes[k]);
            const bool is_next_alike = k + 1 < meshes.size() && meshes[k + 1].growth == meshes[k].growth;
            if (is_next_alike && begun->end != CoarseEnd::converged) continue;
            if (auto proxy = fine(*begun, meshes[k])) return proxy;
        }
        return std::nullopt;
    }

    // A start for the fine proxy: the harmonic surface where the iteration finds it, the least bent one otherwise.
    // Pipes that a descent would lead away from have been solved on the user's own mesh (method/direct).
    CoarseProxy coarse(const Points& membrane, const Fineness& fineness) {
        const Sizing sizing{fineness.growth, longest_coarse, free_limit_};
        ProxyMesh mesh(problem_.patch, membrane);
        mesh.adapt(sizing);
        descend(mesh);
        mesh.adapt(sizing);
        auto snapshot = mesh.snapshot();
        const Problem problem = coarse_problem(problem_, shown_, snapshot.patch);
        Workspace work = make_workspace(problem, progress_);
        const Points start = globalise(problem, work, snapshot.points, progress_.here());
        const Solution solution = solve_equation(problem, work, start, progress_.here());
        const CoarseEnd end = end_of(solution, problem_, shown_);
        mesh.read_back(snapshot.patch, end == CoarseEnd::converged ? solution.points : start);
        return {std::move(mesh), end};
    }

    std::optional<SolvedProxy> fine(const CoarseProxy& coarse, const Fineness& fineness) {
        ProxyMesh mesh = coarse.mesh;
        lay_over_boundary(mesh);
        const Sizing sizing{std::min(fineness.growth, finest_growth), longest_of(fineness), free_limit_};
        return solve_fine(std::move(mesh), sizing, coarse.end == CoarseEnd::converged);
    }

private:
    [[nodiscard]] double longest_of(const Fineness& fineness) const {
        return std::clamp(fineness.share_of_boundary * mean_boundary_edge(problem_), longest_fine, longest_coarse);
    }

    // Beside a fine boundary the first two are the same mesh. Of large patches none needed another one, and each is
    // dearer.
    [[nodiscard]] std::vector<Fineness> tried() const {
        if (problem_.patch.loop_count() != 1) return {second_fineness};
        if (!is_small(shown_)) return {first_fineness};
        if (longest_of(second_fineness) == longest_fine) return {first_fineness, third_fineness};
        return {first_fineness, second_fineness, third_fineness};
    }

    void lay_over_boundary(ProxyMesh& mesh) const {
        auto snapshot = mesh.snapshot();
        snapshot.points.rightCols(problem_.fixed_points.cols()) = problem_.fixed_points;
        mesh.read_back(snapshot.patch, snapshot.points);
    }

    void descend(ProxyMesh& mesh) {
        for (int k = 0; k < most_descent_steps; ++k) {
            progress_.report(0.4 * k / most_descent_steps, "descent");
            const auto snapshot = mesh.snapshot();
            const Problem problem = coarse_problem(problem_, shown_, snapshot.patch);
            Workspace work = make_workspace(problem, progress_);
            const DescentStep step = descent_step(problem, work, snapshot.points, progress_.here());
            mesh.read_back(snapshot.patch, step.points);
            mesh.remesh(3, 3);
            if (step.length < descended) return;
        }
    }

    std::optional<SolvedProxy> solve_fine(ProxyMesh mesh, const Sizing& sizing, bool from_converged) {
        mesh.adapt(sizing);
        auto snapshot = mesh.snapshot();
        Problem problem = proxy_problem(problem_, shown_, snapshot.patch);
        problem.conduct.nears_within = soon;
        Workspace work = make_workspace(problem, progress_);
        Solution solution;
        if (from_converged) solution = solve_equation(problem, work, snapshot.points, progress_.range(0.5, 0.8));
        // In 17 regions of scans that did not converge from a coarse one's surface, a descent and another
        // iteration found two, both from a step below this. Small patches have all patience.
        const bool ends_far = problem_.patch.loop_count() == 1 && solution.least_step > near_step;
        const bool hopeless = from_converged && ends_far && !is_small(shown_);
        // The Willmore descent leads away from straight pipes: only where it is needed.
        if (solution.termination != Termination::converged && !hopeless) {
            const Points start = globalise(problem, work, snapshot.points, progress_.range(0.4, 0.5));
            solution = solve_equation(problem, work, start, progress_.range(0.5, 0.8));
        }
        if (solution.termination != Termination::converged) return std::nullopt;
        const SurfaceState state = measured_surface(problem, solution.points);
        solution.mean_curvature = state.curvature.mean;
        solution.residual = largest_residual(problem, state, outer_residual(problem, state));
        return SolvedProxy{
            std::move(mesh), {std::move(snapshot.patch), state.points}, std::move(solution), state.normals};
    }

    const Problem& problem_;
    const int shown_;
    const Progress& progress_;
    int free_limit_;
};

}  // namespace

int free_limit(int shown) {
    constexpr int least = 3000;      // vertices
    constexpr int largest = 20'000;  // likewise
    constexpr int per_vertex = 3;    // of the user's
    return std::clamp(per_vertex * shown, least, largest);
}

Sizing fine_sizing(int shown) { return {finest_growth, longest_fine, free_limit(shown)}; }

double mean_boundary_edge(const Problem& problem) {
    const auto place = [&](int v) { return problem.fixed_points.col(v - problem.patch.free_count); };
    double sum = 0.0;
    std::size_t count = 0;
    for (const Indices& loop : problem.patch.loops()) {
        for (std::size_t k = 0; k < loop.size(); ++k)
            sum += (place(loop[k]) - place(loop[(k + 1) % loop.size()])).norm();
        count += loop.size();
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

std::optional<SolvedProxy> solve_proxy(const Problem& problem, std::optional<CoarseProxy> coarse,
                                       const Points& membrane, int shown, const Progress& progress) {
    return ProxySolve(problem, shown, progress).from_coarse(std::move(coarse), membrane);
}

std::optional<SolvedProxy> solve_proxy_near(const Problem& problem, const Points& near, int shown,
                                            const Progress& progress) {
    return ProxySolve(problem, shown, progress).from_surface(near);
}

CoarseProxy solve_coarse_proxy(const Problem& problem, const Points& membrane, int shown, const Progress& progress) {
    return ProxySolve(problem, shown, progress).coarse(membrane, first_fineness);
}

Points proxy_membrane(const Problem& problem, const Progress& progress) {
    const Problem uniform = proxy_problem(problem, problem.patch.free_count, problem.patch);
    const Workspace work = make_workspace(uniform, progress);
    return membrane(uniform, work);
}

}  // namespace fairing
