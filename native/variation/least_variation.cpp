#include "variation/least_variation.h"

#include "base/limits.h"
#include "base/stopwatch.h"
#include "geometry/self_intersection.h"
#include "geometry/surface_fit.h"
#include "geometry/vertex_normal.h"
#include "operators/biharmonic_operator.h"
#include "operators/normal_operator.h"
#include "placement/place.h"
#include "problem/free_slopes.h"
#include "problem/surface_state.h"
#include "proxy/proxy_solver.h"
#include "start/clamped_fill.h"
#include "start/swept_start.h"
#include "variation/lift.h"

namespace fairing {

namespace {

// Edges begin with the boundary's own and grow by `growth` per distance (proxy/proxy_mesh.h), up to `range_of_edges`
// times a share of its mean edge; less where the surface turns by more than `turn` radians along them. Coarse meshes
// need not resolve the boundary, only how the surface turns: their longest edges are those of loops of `most_around`.
// On rougher coarse meshes, and coarser ones (coarse_edge), free slopes converge elsewhere.
struct Fineness {
    double growth;
    double turn;
};
constexpr Fineness as_fine{0.3, 0.26};   // 24 edges around a tube
constexpr Fineness as_rough{0.6, 0.35};  // see above
constexpr int most_around = 24;          // see above
constexpr double range_of_edges = 4.0;   // the proxy's own: edges that turn stop at a quarter of the longest ones
constexpr double shortest = 0.05;        // of the longest edges
constexpr double longest = 0.5;          // units of D
constexpr int most_coarse = 1200;        // free vertices
constexpr int most_fine_steps = 100;     // most of those that converge take 30 at most, a thin U of 180° takes 85

struct Beginning {
    double share;    // of the boundary's mean edge
    double damping;  // at first
};
constexpr Beginning rough_beginning{1.4, raised_damping};  // from any start

// From a surface that is near: elbows take half the steps that they take with the first beginning, or undamped.
// The fine mesh mends what a rough end leaves: finer and sharper ones cost a third more.
constexpr Beginning near_beginning{1.8, 1e-2};
constexpr double near_damping = 1e-6;  // on the next mesh

Workspace make_workspace(const Problem& problem, const Progress& progress) {
    return {std::make_unique<BiharmonicOperator>(problem.patch),
            make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress)};
}

bool has_free_slopes(const Patch& patch) {
    return std::any_of(patch.pin.begin(), patch.pin.end(), [](char is_pin) { return is_pin != 0; });
}

// The step within the surface by uniform weights on the user's mesh: its factor is made once, for the fill and for the
// placement, and is null before.
using UniformStep = std::unique_ptr<TangentialStep>;

// A bulge that meets the boundary's tangent planes, its collapsed tubes opened: arms that meet need it.
Points start_of(const Problem& problem, UniformStep& within, const Progress& progress) {
    const Problem given = on_patch(problem, problem.patch);
    Workspace work = make_workspace(given, progress.here());
    const Problem uniform = with_slopes_carried_on(given, membrane(given, work));
    const Points fill = best_fill(uniform, work, progress.here());
    within = std::move(work.tangential);
    return problem.patch.loop_count() > 1 ? inflated(uniform, fill, progress) : fill;
}

// The interior needs the boundary's resolution only where it bends.
Sizing sizing_of(double edge, const Fineness& fineness, int most) {
    return {fineness.growth, std::clamp(range_of_edges * edge, shortest, longest), most, fineness.turn, true};
}

double coarse_edge(const Problem& problem) {
    if (has_free_slopes(problem.patch)) return mean_boundary_edge(problem);
    const auto around = static_cast<double>(problem.fixed_points.cols()) / std::max(1, problem.patch.loop_count());
    return mean_boundary_edge(problem) * std::max(1.0, around / most_around);
}

// On a coarse mesh from a rough start; the mesh is made anew in between, for vertices move along normals only. Given up
// where the merit is far above `most`.
SolvedSheet solve_coarse(ProxyMesh& mesh, const Problem& problem, const Beginning& beginning, const Progress& progress,
                         double most = HUGE_VAL) {
    constexpr int most_rounds = 8;            // a bound: meshes are made anew until the solve converges
    constexpr double tolerance = 1e-3;        // units of D; the fine mesh does the rest
    constexpr double enough = 1e-3;           // from one step to the next
    constexpr double enough_for_fine = 0.01;  // likewise, on the last of the coarse meshes
    constexpr double hopeless = 1000.0;       // times what is too much: two meshes have shown it
    const Sizing sizing = sizing_of(beginning.share * coarse_edge(problem),
                                    has_free_slopes(problem.patch) ? as_fine : as_rough, most_coarse);
    std::optional<SolvedSheet> last;
    for (int k = 0; k < most_rounds; ++k) {
        mesh.adapt(sizing);
        NewtonLimits limits{tolerance, k == 0 ? 30 : 15, k == 0 ? beginning.damping : near_damping, 0.05};
        limits.least_fall = enough;
        last.emplace(solve_on(mesh, problem, last, Measure::plain, limits, progress.range(0.1 * k, 0.1 * (k + 1))));
        if (last->result.converged) break;
        if (k > 0 && !(last->result.merit <= hopeless * most)) return std::move(*last);
    }
    mesh.adapt(sizing);
    NewtonLimits limits{tolerance, 30, near_damping};
    limits.least_fall = enough_for_fine;
    return solve_on(mesh, problem, last, Measure::scale_free, limits, progress.range(0.8, 1.0));
}

struct FineStart {
    double damping = 0.0;
    double most_merit = HUGE_VAL;  // given up where it stays above
    int most_steps = most_fine_steps;
};

SolvedSheet solve_fine(ProxyMesh& mesh, const Problem& problem, const SolvedSheet& coarse, const FineStart& begin,
                       const Progress& progress) {
    mesh.adapt(sizing_of(mean_boundary_edge(problem), as_fine, free_limit(problem.patch.free_count)));
    NewtonLimits limits{problem.options.tolerance, std::min(problem.options.max_iterations, begin.most_steps)};
    limits.damping = begin.damping;
    limits.most_merit = begin.most_merit;
    return solve_on(mesh, problem, coarse, Measure::scale_free, limits, progress);
}

Termination ending(const NewtonResult& result, const Problem& problem) {
    if (result.converged) return Termination::converged;
    return result.steps >= problem.options.max_iterations ? Termination::iteration_limit : Termination::stalled;
}

// The problem's own, or the uniform one where that is the same.
std::unique_ptr<TangentialStep> step_within(const Problem& problem, UniformStep uniform, const Progress& progress) {
    if (!uniform || *problem.weights)
        return make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress);
    uniform->hold(problem.fixed_points);
    return uniform;
}

// The user's vertices on the solved surface.
Solution projected(const Problem& given, const ProxyMesh& mesh, const SolvedSheet& solved, UniformStep within,
                   const Progress& progress) {
    Problem problem = given;
    problem.fixed_points = solved.sheet.points.rightCols(given.fixed_points.cols());  // a free edge has moved
    const Termination end = ending(solved.result, problem);
    const TargetSurface target(solved.mesh.patch, solved.sheet.points, solved.sheet.normals);
    const auto tangential = step_within(problem, std::move(within), progress.here());
    const Projected best = place(problem, *tangential, mesh, solved.mesh, target);
    const Placement& placement = best.placement;
    const SurfaceState state = measured_surface(on_patch(problem, solved.mesh.patch), solved.sheet.points);
    Solution solution;
    solution.termination = end;
    solution.points = placement.points;
    const Lift lift(solved.mesh.patch, solved.sheet);
    for (int v = 0; v < problem.patch.free_count; ++v)
        solution.points.col(v) = lift.sample(target, placement.where[v]).point;
    solution.mean_curvature = carried_over(placement, target, state.curvature.mean, problem);
    solution.boundary_normals = one_sided_normals(solved.mesh.patch, solved.sheet.points);
    solution.polished = false;
    solution.crosses = !crossing_triangles(solved.mesh.patch.triangles, solved.sheet.points).empty();
    if (end == Termination::converged) refuse_folds(problem, best, solution);
    return solution;
}

struct Attempt {
    ProxyMesh mesh;
    SolvedSheet fine;
    double coarse_gradient;
    int coarse_vertices;

    [[nodiscard]] bool is_better_than(const Attempt& other) const {
        if (fine.result.converged != other.fine.result.converged) return fine.result.converged;
        return fine.result.merit < other.fine.result.merit;
    }
};

struct Begun {
    ProxyMesh mesh;
    SolvedSheet coarse;

    // NaN is not, too.
    [[nodiscard]] bool is_within(double most) const { return !std::isfinite(most) || coarse.result.merit <= most; }
};

Begun begun(const Problem& problem, const Points& start, const Progress& progress) {
    ProxyMesh mesh(problem.patch, start);
    SolvedSheet coarse = solve_coarse(mesh, problem, rough_beginning, progress);
    return {std::move(mesh), std::move(coarse)};
}

Attempt ended(const Problem& problem, Begun begun, const Progress& progress) {
    SolvedSheet fine = solve_fine(begun.mesh, problem, begun.coarse, {}, progress);
    return {std::move(begun.mesh), std::move(fine), begun.coarse.result.gradient,
            begun.coarse.mesh.patch.vertex_count()};
}

Solution solution_of(const Problem& problem, const Attempt& attempt, UniformStep within, const Progress& progress) {
    Solution solution = projected(problem, attempt.mesh, attempt.fine, std::move(within), progress);
    solution.iterations = attempt.fine.result.steps;
    solution.residual = attempt.fine.result.gradient;
    solution.initial_residual = attempt.coarse_gradient;
    solution.levels = {attempt.coarse_vertices, attempt.fine.mesh.patch.vertex_count()};
    return solution;
}

// A surface as it is. Near ones have Max's normals: those that suit them better take as long as six steps.
SolvedSheet unsolved(const ProxyMesh& mesh, const Problem& problem) {
    ProxyMesh::Snapshot snapshot = mesh.snapshot();
    Sheet sheet{snapshot.points, max_normals(snapshot.patch, snapshot.points, problem.fixed_normals)};
    return {std::move(snapshot), std::move(sheet), {}};
}

// A surface as it is, with the normals that suit it.
SolvedSheet well_suited(const ProxyMesh& mesh, const Problem& problem, const Progress& progress) {
    ProxyMesh::Snapshot snapshot = mesh.snapshot();
    const Problem here = on_patch(problem, snapshot.patch);
    Sheet sheet{snapshot.points, fitted_normals(here, snapshot.points, Measure::scale_free, progress.here())};
    return {std::move(snapshot), std::move(sheet), {}};
}

// On one fine mesh: there elbows end in 11 to 46 steps, from a coarse mesh many of them nowhere.
std::optional<Attempt> attempted_on_tube(const Problem& problem, const Points& tube, double most,
                                         const Progress& progress) {
    ProxyMesh mesh(problem.patch, tube);
    SolvedSheet fine =
        solve_fine(mesh, problem, well_suited(mesh, problem, progress), {raised_damping, most}, progress);
    if (std::isfinite(most) && !(fine.result.merit <= most)) return std::nullopt;
    const double gradient = fine.result.gradient;
    const int count = fine.mesh.patch.vertex_count();
    return Attempt{std::move(mesh), std::move(fine), gradient, count};
}

// One mesh, from a surface that is near.
std::optional<Solution> solve_nearby(const Problem& problem, const NearVariation& near, double most,
                                     const Progress& progress) {
    // Bridges, elbows and S-bends end in 40 at most; where they don't, along wide bends, 300 end nowhere, too, in 12 s.
    const FineStart begin{.damping = near_damping, .most_steps = most_iterations};
    Stopwatch watch;
    ProxyMesh mesh(problem.patch, near.points);
    SolvedSheet solved = near.roughly
                             ? solve_coarse(mesh, problem, near_beginning, progress.range(0.0, 0.9), most)
                             : solve_fine(mesh, problem, unsolved(mesh, problem), begin, progress.range(0.0, 0.5));
    if (std::isfinite(most) && !(solved.result.merit <= most)) return std::nullopt;
    if (near.roughly) solved.result.converged = true;  // near enough, whatever its last steps were
    const double solve_seconds = watch.lap();
    const double gradient = solved.result.gradient;
    const int count = solved.mesh.patch.vertex_count();
    Solution solution =
        solution_of(problem, {std::move(mesh), std::move(solved), gradient, count}, nullptr, progress.range(0.9, 1.0));
    solution.seconds = {{"iteration", solve_seconds}, {"placement", watch.lap()}};
    return solution;
}

// From the membrane, and between two loops from the tube: first where that bends, last where it is straight.
class Search {
public:
    Search(const Problem& problem, const VariationLimits& limits)
        : problem_(problem), limits_(limits), tube_(tube_between(problem)) {}

    // Over a coarse mesh elbows of 120° and more don't settle, and dense ones of 90° take 5 to 10 s on the fine one;
    // from the tube they end in one.
    std::optional<Attempt> run(const Progress& progress) {
        if (tube_ && tube_->turn() > wide_bend) try_tube(progress.range(0.0, 0.1));
        if (!has_ended() && !is_in_valley()) try_membrane(progress.range(0.1, 1.0));
        return std::move(best_);
    }
    [[nodiscard]] double start_seconds() const { return start_seconds_; }
    UniformStep step_within() { return std::move(within_); }

private:
    [[nodiscard]] bool has_ended() const { return best_ && best_->fine.result.converged; }

    // A descent that took all its steps: along wide bends the product falls to loops many radii off, which is where
    // the membrane leads to, too.
    [[nodiscard]] bool is_in_valley() const { return best_ && best_->fine.result.steps >= most_fine_steps; }

    void take(Attempt attempt) {
        if (!best_ || attempt.is_better_than(*best_)) best_ = std::move(attempt);
    }

    void try_tube(const Progress& progress) {
        if (!tube_) return;
        const auto start = swept_start(problem_, *tube_, progress.here());
        tube_.reset();  // once is enough
        if (!start) return;
        if (auto attempt = attempted_on_tube(problem_, *start, limits_.most_product, progress))
            take(std::move(*attempt));
    }

    void try_membrane(const Progress& progress) {
        Stopwatch watch;
        const Points start = start_of(problem_, within_, progress.range(0.0, 0.1));
        start_seconds_ = watch.lap();
        Begun first = begun(problem_, start, progress.range(0.1, 0.5));
        if (!first.coarse.result.converged) try_tube(progress.range(0.5, 0.6));
        if (has_ended() || !first.is_within(limits_.most_product)) return;
        take(ended(problem_, std::move(first), progress.range(0.6, 0.9)));
        if (!has_ended()) try_tube(progress.range(0.9, 1.0));
    }

    const Problem& problem_;
    const VariationLimits& limits_;
    std::optional<SweptTube> tube_;
    std::optional<Attempt> best_;
    UniformStep within_;
    double start_seconds_ = 0.0;
};

}  // namespace

Solution solve_least_variation(const Problem& problem, const Progress& progress) {
    return *solve_less_varying(problem, {}, progress);
}

std::optional<Solution> solve_less_varying(const Problem& problem, const VariationLimits& limits,
                                           const Progress& progress) {
    const Checkpoints checkpoints(progress);
    if (limits.near) return solve_nearby(problem, *limits.near, limits.most_product, progress);
    Stopwatch watch;
    Search search(problem, limits);
    const auto best = search.run(progress.range(0.0, 0.9));
    if (!best) return std::nullopt;
    const double solve_seconds = watch.lap() - search.start_seconds();
    Solution solution = solution_of(problem, *best, search.step_within(), progress.range(0.9, 1.0));
    solution.seconds = {{"fill", search.start_seconds()}, {"iteration", solve_seconds}, {"placement", watch.lap()}};
    return solution;
}

}  // namespace fairing
