#include "api/component_solver.h"

#include "accept/accept.h"
#include "api/diagnose.h"
#include "base/errors.h"
#include "base/stopwatch.h"
#include "boundary/fair_border.h"
#include "continuity/joined.h"
#include "detail/skin.h"
#include "geometry/flips.h"
#include "geometry/surface_fit.h"
#include "method/direct.h"
#include "method/nested.h"
#include "method/solve.h"
#include "problem/free_slopes.h"
#include "start/swept_start.h"

namespace fairing {

namespace {

bool reads_reference(InnerFairness kind) { return kind != InnerFairness::uniform && kind != InnerFairness::custom; }

// The warm start of a component this large would cost more than it saves: one factorisation takes longer than a solve.
constexpr int largest_warm = 50000;

// Moves can't be told from rounding below: an iteration that waits for less ends by luck or not at all.
constexpr double least_tolerance = 1e-15;

void warn_of_even_weights(Diagnostics& warnings) {
    warnings.push_back({Code::flipped_triangles,
                        "the inner fairness asked for turns triangles over; uniform inner fairness was used",
                        {},
                        ElementKind::triangle,
                        {}});
}

// D of a component must be a number above 0.
Normalisation checked_unit(const Patch& patch, const Points& fixed_points) {
    const auto fixed = fixed_vertices(patch);
    const Normalisation unit = normalise(fixed_points);
    if (!unit.centre.allFinite() || std::isinf(unit.diameter)) {
        throw MeshError({Code::nonfinite,
                         "coordinates this large overflow when they are added: scale the mesh down",
                         Indices(fixed.begin(), fixed.end()),
                         ElementKind::vertex,
                         {{"largest_coordinate", fixed_points.cwiseAbs().maxCoeff()}}});
    }
    if (!(unit.diameter > 0.0)) {
        throw MeshError({Code::no_boundary,
                         "a component is held in one point only: put more in `fixed`",
                         Indices(fixed.begin(), fixed.end()),
                         ElementKind::vertex,
                         {{"points", 1}}});
    }
    return unit;
}

// In units of D⁻³, for a component's fixed points in units of D.
double load_in_units(const Patch& patch, const Points& fixed_points, double diameter, const FairOptions& options) {
    double load = 0.0;
    if (options.solver.load != 0.0) load = options.solver.load * std::pow(diameter, 3);
    if (options.bulge != 0.0) load += 8.0 * options.bulge / std::pow(boundary_radius(patch, fixed_points), 3);
    return load;
}

// Open borders that become fair do so as curves; the surface then moves them along its normals.
void hold_border(const std::vector<char>& faired, Problem& problem) {
    const Patch& patch = problem.patch;
    std::vector<char> edge;
    for (int v : fixed_vertices(patch)) edge.push_back(faired[v]);
    if (std::find(edge.begin(), edge.end(), 1) == edge.end()) return;
    problem.free_edge = std::move(edge);
    for (Indices& loop : patch.loops()) {
        for (int& v : loop) v -= patch.free_count;
        fair_border(loop, problem.free_edge, problem.fixed_points);
    }
}

}  // namespace

ComponentSolver::ComponentSolver(const Patch& patch, const FairOptions& options)
    : patch_(patch), options_(options), skin_(patch), warm_(patch) {}

bool ComponentSolver::keeps() const {
    return options_.repeated && options_.method == Method::global && patch_.free_count <= largest_warm;
}

ComponentAnswer ComponentSolver::solve(const ComponentData& data, const Progress& progress) {
    const bool wants_skin = options_.detail.share > 0.0;
    if (!wants_skin) return solve_between(data, boundary_as_given(data), progress);
    skin_.read(data, options_.detail.size, progress);
    const BaseBoundary boundary = skin_.found() ? skin_.boundary(data) : boundary_as_given(data);
    ComponentAnswer answer = solve_between(data, boundary, progress);
    if (boundary.moved && end_of(answer.solution) != Termination::converged) {
        const BaseBoundary rough = boundary_as_given(data);
        ComponentAnswer other = solve_between(data, rough, progress);
        if (end_of(other.solution) == Termination::converged) return dressed(std::move(other), data, rough, progress);
    }
    return dressed(std::move(answer), data, boundary, progress);
}

BaseBoundary ComponentSolver::boundary_as_given(const ComponentData& data) const {
    const auto fixed = fixed_vertices(patch_);
    return {gather(data.vertices, fixed), data.normals.gather(fixed)};
}

Points ComponentSolver::first_surface(const ComponentData& data, const Progress& progress) {
    const ComponentAnswer answer = posed(data, boundary_as_given(data));
    return answer.unit.from_unit(fairing::first_surface(answer.problem, progress));
}

ComponentAnswer ComponentSolver::posed(const ComponentData& data, const BaseBoundary& boundary) {
    const Normalisation unit = checked_unit(patch_, boundary.points);
    SolverOptions solver = options_.solver;
    solver.tolerance = std::max(solver.tolerance, least_tolerance);
    ComponentAnswer answer{unit, {patch_, unit.to_unit(boundary.points), boundary.normals, {}, solver}, {}, {}, {}};
    answer.problem.options.equation = equation_of(answer.problem, data);
    answer.problem.options.load = load_in_units(patch_, answer.problem.fixed_points, unit.diameter, options_);
    if (data.curvatures.size() > 0 && answer.problem.options.equation == Equation::harmonic) {
        answer.problem.fixed_curvatures = unit.diameter * data.curvatures(fixed_vertices(patch_));
    }
    hold_border(data.faired, answer.problem);
    warn_of_precision(patch_, data.vertices, {unit.diameter, solver.tolerance}, answer.warnings);
    const auto before = [&patch = patch_, reference = data.reference, unit] {
        return unit.to_unit(gather(reference, patch.to_input));
    };
    answer.problem.before = Deferred<Points>(before);
    read_reference(data.reference, unit);
    answer.problem.weights = lambda_;
    answer.warnings.insert(answer.warnings.end(), reference_warnings_.begin(), reference_warnings_.end());
    return answer;
}

ComponentAnswer ComponentSolver::solve_between(const ComponentData& data, const BaseBoundary& boundary,
                                               const Progress& progress) {
    ComponentAnswer answer = posed(data, boundary);
    answer.solution = options_.method == Method::paper ? solve_by_paper(answer.problem, progress)
                                                       : solve_globally(answer, data, progress);
    return answer;
}

Equation ComponentSolver::equation_of(const Problem& problem, const ComponentData& data) {
    const Equation asked = problem.options.equation;
    chooses_ = false;
    if (asked != Equation::automatic) return equation_for(patch_, asked);
    // The paper's method has one equation for tubes, and one surface alone continues a curvature.
    const bool harmonic_alone = options_.method == Method::paper || data.curvatures.size() > 0;
    const bool stays = keeps() && chosen_ && small_rotation(chosen_->boundary, boundary_of(problem));
    const Equation chosen = equation_for(patch_, stays && !harmonic_alone ? chosen_->equation : Equation::harmonic);
    chooses_ = !harmonic_alone && !stays && chosen == Equation::harmonic;
    return chosen;
}

// λ stays as long as what it is read off does, which one call does not change.
void ComponentSolver::read_reference(const View<Points>& input, const Normalisation& unit) {
    const bool reads = reads_reference(options_.inner_fairness);
    if (reference_read_ && (!reads || !options_.repeated)) return;
    Points reference = reads ? gather(input, patch_.to_input) : Points();
    if (reference_read_ && reference == given_reference_) return;
    reference_read_ = false;
    if (reads) reference_ = unit.to_unit(reference);
    reference_warnings_.clear();
    usable_ = !reads || is_usable_reference(patch_, reference_, reference_warnings_);
    lambda_ = make_lambda(patch_, reference_, fairness(), options_);
    warm_.new_weights();
    if (reads && options_.repeated) given_reference_ = std::move(reference);
    reference_read_ = true;
}

ComponentAnswer ComponentSolver::dressed(ComponentAnswer answer, const ComponentData& data,
                                         const BaseBoundary& boundary, const Progress& progress) {
    answer.warnings.insert(answer.warnings.end(), skin_.warnings().begin(), skin_.warnings().end());
    if (!skin_.found()) return answer;
    const Stopwatch watch;
    Points& points = answer.solution.points;
    points = relaid(answer.problem, points, skin_.base(), progress.here());
    answer.solution.crossings.reset();
    answer.solution.flipped.reset();
    Points base = answer.unit.from_unit(points);
    base.rightCols(boundary.points.cols()) = boundary.points;
    answer.dressed = skin_.put_back(data, base);
    if (!answer.dressed->detail.allFinite()) throw SolverError("the detail is not finite; nothing was changed");
    answer.dressed->detail *= options_.detail.share;
    warn_of_folded_detail(patch_, answer.dressed->turned_over, answer.warnings);
    answer.solution.seconds["detail"] = skin_.take_seconds() + watch.seconds();
    return answer;
}

Solution ComponentSolver::solve_by_paper(const Problem& problem, const Progress& progress) const {
    const Stopwatch watch;
    Solution solution = solve_paper(problem, options_.paper, progress);
    solution.boundary_normals = one_sided_normals(patch_, solution.points);
    solution.strategies = {{"paper", watch.seconds()}};
    solution.flaw = flaw_of(problem, solution);
    return solution;
}

// Conformal weights of the vertices given leave them where they are within the surface.
std::optional<NearStart> ComponentSolver::given_start(const ComponentAnswer& answer, const ComponentData& data) const {
    const Start kind = options_.start;
    const bool is_given = kind == Start::given || kind == Start::kept;
    const bool meets_normals = options_.solver.equation != Equation::soap_film;
    if (kind != Start::least_variation && !(is_given && meets_normals)) return std::nullopt;
    const Points start = answer.unit.to_unit(gather(data.vertices, patch_.to_input));
    return NearStart{start, fairness() == InnerFairness::conformal && reference_ == start};
}

Solution ComponentSolver::solve_globally(ComponentAnswer& answer, const ComponentData& data, const Progress& progress) {
    Problem& problem = answer.problem;
    problem.tolerated_folds = tolerated_folds();
    const bool joins = problem.fixed_curvatures.size() > 0;
    const std::optional<NearStart> start = given_start(answer, data);
    Solution solution = solve_tangent(problem, start, joins ? progress.range(0.0, 0.5) : progress);
    if (solution.uniform_weights) warn_of_even_weights(answer.warnings);
    solution = with_spread_pins(problem, options_.pin_radius, std::move(solution), progress.here());
    if (!joins) return solution;
    return joined(problem, std::move(solution), progress.range(0.5, 1.0));
}

Solution ComponentSolver::solve_tangent(Problem& problem, const std::optional<NearStart>& start,
                                        const Progress& progress) {
    std::optional<Solution> near = keeps() && !chooses_ ? solve_near_last(problem, progress) : std::nullopt;
    const auto from_start = [&](const Problem& given, const Progress& part) { return solve_from(given, start, part); };
    const bool varies = options_.start == Start::given || options_.start == Start::kept;  // others are one surface
    if (!near && !(chooses_ && varies)) near = from_start(problem, progress);
    if (!near && chooses_) {
        const auto nowhere = [](const Problem&, const Progress&) { return std::optional<Solution>(); };
        near = solve_automatically(problem, options_.pin_radius, varies ? Near(from_start) : Near(nowhere), progress);
    }
    Solution solution = near ? std::move(*near) : fairing::solve(problem, options_.pin_radius, progress);
    if (options_.start == Start::kept && end_of(solution) == Termination::converged) {
        solution.bad_triangles = folded_triangles(patch_, solution.points);
        if (!solution.bad_triangles.empty()) solution.flaw = Flaw::folded;
    }
    if (!keeps()) return solution;
    chosen_ = Chosen{boundary_of(problem), problem.options.equation};
    replaced_.reset();
    if (stands_in(solution.provenance) && end_of(solution) == Termination::converged)
        replaced_ = Replaced{boundary_of(problem), solution.provenance};
    // Other weights than those asked for were used: the next solve has to try again.
    if (solution.uniform_weights) {
        warm_.forget();
    } else {
        warm_.remember(problem, solution, progress.here());
    }
    return solution;
}

// The surface that the caller wants to begin with.
std::optional<Solution> ComponentSolver::solve_from(const Problem& problem, const std::optional<NearStart>& start,
                                                    const Progress& progress) const {
    switch (options_.start) {
        case Start::given: return start ? solve_near(problem, *start, progress.range(0.0, 0.4)) : std::nullopt;
        case Start::kept: {
            if (!start) return std::nullopt;
            auto found = solve_near(problem, *start, progress.range(0.0, 0.4));
            const auto bends = [&] { return !found || !folded_triangles(patch_, found->points).empty(); };
            if (bends()) found = solve_stand_in(problem, Provenance::equation, progress);
            if (bends()) found = solve_stand_in(problem, Provenance::first_surface, progress, &start->points);
            return bends() ? std::nullopt : found;
        }
        case Start::least_variation:
            return solve_stand_in(problem, Provenance::least_variation, progress, &start->points);
        case Start::loft: return solve_stand_in(problem, Provenance::loft, progress);
        case Start::smoothed: return solve_stand_in(problem, Provenance::old_shape, progress);
        default: return std::nullopt;
    }
}

// The kind of surface stays what it was while an boundary is dragged.
std::optional<Solution> ComponentSolver::solve_near_last(const Problem& problem, const Progress& progress) {
    if (!replaced_ || !small_rotation(replaced_->boundary, boundary_of(problem))) return warm_.solve(problem, progress);
    return solve_stand_in(problem, replaced_->kind, progress);
}

// Slivers across a curvature count as turned over in the reference already.
std::size_t ComponentSolver::tolerated_folds() const {
    return reads_reference(fairness()) ? flipped_by_solution(patch_, reference_).size() : 0;
}

}  // namespace fairing
