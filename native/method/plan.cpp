#include "method/plan.h"

#include "accept/accept.h"
#include "boundary/low_passed_boundary.h"
#include "fairness/inner_weights.h"
#include "pins/spread_pins.h"
#include "problem/surface_state.h"
#include "proxy/proxy_solver.h"
#include "shape/girth.h"
#include "start/loft.h"

namespace fairing {

namespace {

// The low pass halves waves of this length. With 8, regions of an ear and a cheek kept flipped triangles; 32 moves the
// boundary farther.
constexpr double wave = 16.0;  // vertices
// Variation along the boundary (boundary/low_passed_boundary). Least variation was found over loops of pipes up to 6e3,
// never from 4e4 on; regions of scans with noise of a quarter edge have 4e6 to 2e9.
constexpr double smallest_jagged = 3e4;
// In 60 regions of scans with 10,000 to 100,000 vertices surfaces met boundaries of up to 1.7e9, a rim of 2,048 edges
// around half a sphere was met at 8e9; the 14 regions from here to 2.5e10 had none.
constexpr double largest_reached = 1e10;
// Free vertices from which levels pay between smooth loops.
constexpr int smallest_smooth = 500;

BoundaryData boundary_of(const Problem& problem) { return {problem.fixed_points, problem.fixed_normals}; }

// 3 × local vertices, of which the fixed ones count.
Points fixed_alone(const Problem& problem) {
    Points points = Points::Zero(3, problem.patch.vertex_count());
    points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    return points;
}

bool is_short(const Problem& problem) {
    return straight_length_between(problem.patch, fixed_alone(problem)) <= longest_single;
}

// Beyond, large moves wrinkle the fine mesh, and the proxy mesh is faster (hemispheres: 1.2 times slower at 20,000, 1.4
// times faster at 40,000; at 100,000 only it gets there).
constexpr int largest_direct = 25'000;

// Whether `direct` is tried after `levels`. Where a coarse level of a large disc fails, the whole mesh would fail
// later; but between smooth loops pipes and blends may have no surface on a coarse mesh and keep it on their own.
bool goes_on_directly(const Problem& problem, const Traits& traits) {
    const bool is_smooth = problem.patch.loop_count() > 1 && !traits.is_jagged;
    return !traits.is_large || (is_smooth && problem.patch.free_count <= largest_direct);
}

// Between real loops whose membrane is poor the old shape nearly always decides (see Traits::poor_share_of_membrane).
bool has_little_chance(const Traits& traits) {
    constexpr double most_poor = 0.02;  // of its triangles
    return traits.has_old_shape && traits.is_jagged && traits.poor_share_of_membrane() > most_poor;
}

std::vector<Step> equation_steps(const Problem& problem, const Traits& traits) {
    if (problem.options.equation == Equation::soap_film) return {Step::direct};
    if (problem.options.equation == Equation::least_variation) return {Step::least_variation};
    std::vector<Step> steps{traits.has_levels ? Step::levels : Step::direct};
    const bool is_hopeless = (traits.is_large && traits.is_beyond_reach) || has_little_chance(traits);
    if (!is_hopeless) steps.push_back(Step::proxy_mesh);
    if (traits.has_levels && goes_on_directly(problem, traits)) {
        const bool at_last = problem.options.equation == Equation::harmonic;  // the engine's mesh begins with that
        steps.insert(at_last ? steps.end() : steps.begin() + 1, Step::direct);
    }
    if (!is_uniform(problem.weights)) steps.push_back(Step::uniform_weights);
    if (traits.is_jagged && !traits.has_old_shape) steps.push_back(Step::low_passed);
    return steps;
}

// Between jagged loops no surface of least variation was found (570 random patches). Between loops that are not ends of
// tubes its search takes up to 17 s and may crumple, a loft a tenth of a second.
std::vector<Step> stand_ins(const Problem& problem, const Traits& traits) {
    const SolverOptions& options = problem.options;
    const bool wanted = options.otherwise == Otherwise::least_variation && options.equation != Equation::soap_film &&
                        options.equation != Equation::least_variation;
    std::vector<Step> steps;
    if (!wanted) return steps;
    const bool may_vary_least = problem.patch.loop_count() == 1 || traits.is_between_tubes;
    if (!traits.is_jagged && may_vary_least) steps.push_back(Step::least_variation);
    if (traits.has_old_shape) steps.push_back(Step::old_shape);
    if (problem.patch.loop_count() > 1) steps.push_back(Step::loft);
    if (isolated_pins(problem.patch).empty()) steps.push_back(Step::first_surface);  // else slivers, no better
    return steps;
}

std::string text_of(const std::vector<Step>& steps) {
    std::string text;
    for (const Step step : steps) text.append(text.empty() ? "" : ", ").append(name_of(step));
    return text;
}

}  // namespace

Traits::Traits(const Problem& problem)
    : is_large(problem.options.nested && problem.patch.free_count > smallest_large),
      is_tube(problem.patch.loop_count() == 2),
      is_between_tubes(fairing::is_between_tubes(problem.patch, fixed_alone(problem), problem.fixed_normals)),
      has_old_shape(joins_boundaries(problem) && problem.before->cols() == problem.patch.vertex_count()),
      poor_share_([&problem] { return share_of_poor_triangles(problem.patch, proxy_membrane(problem, Progress())); }),
      low_passed_([&problem] { return fairing::low_passed(problem); }) {
    const double roughness = boundary_variation(problem.patch, boundary_of(problem));
    is_jagged = roughness > smallest_jagged;
    is_beyond_reach = roughness > largest_reached;
    begins_small = problem.patch.loop_count() <= 2 && !is_jagged && is_short(problem);
    has_levels = is_large || (problem.options.nested && problem.patch.free_count > smallest_smooth && begins_small);
}

Problem low_passed(const Problem& problem) {
    const BoundaryData boundary = low_passed_boundary(problem.patch, boundary_of(problem), wave);
    Problem result = problem;
    result.fixed_points = boundary.points;
    result.fixed_normals = boundary.normals;
    return result;
}

double distance_of_low_passed(const Problem& problem) {
    return largest_length(problem.fixed_points - low_passed(problem).fixed_points);
}

const char* name_of(Step step) {
    switch (step) {
        case Step::levels: return "levels";
        case Step::direct: return "direct";
        case Step::proxy_mesh: return "proxy mesh";
        case Step::uniform_weights: return "uniform weights";
        case Step::low_passed: return "low-passed";
        case Step::least_variation: return "least variation";
        case Step::old_shape: return "old shape";
        case Step::loft: return "loft";
        case Step::first_surface: break;
    }
    return "first surface";
}

std::string text_of(const Plan& plan) { return text_of(plan.equation) + " | " + text_of(plan.stand_ins); }

Plan plan_for(const Problem& problem, const Traits& traits) {
    return {equation_steps(problem, traits), stand_ins(problem, traits)};
}

}  // namespace fairing
