#include "method/traits.h"

#include "accept/accept.h"
#include "boundary/low_passed_boundary.h"
#include "problem/surface_state.h"
#include "proxy/proxy_solver.h"
#include "shape/girth.h"
#include "start/several_outlines.h"

namespace fairing {

namespace {

// Half of these waves of the loops is left. Eight vertices left regions of an ear and a cheek with turned triangles,
// 32 moved more.
constexpr double wave = 16.0;  // vertices
// Variation along the boundary (boundary/low_passed_boundary). Least variation was found over loops of pipes up to 6e3,
// never from 4e4 on; regions of scans with noise of a quarter edge have 4e6 to 2e9.
constexpr double smallest_jagged = 3e4;
// Of 60 regions of scans with 10,000 to 100,000 vertices surfaces met boundaries of up to 1.7e9, a rim of 2,048 edges
// around half a sphere was met at 8e9; the 14 regions from here to 2.5e10 had none.
constexpr double largest_reached = 1e10;
// Free vertices from which levels pay between smooth loops.
constexpr int smallest_smooth = 500;

OutlineData boundary_of(const Problem& problem) { return {problem.fixed_points, problem.fixed_normals}; }

// 3 × local vertices, of which the fixed ones count.
Points fixed_alone(const Problem& problem) {
    Points points = Points::Zero(3, problem.patch.vertex_count());
    points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    return points;
}

bool is_short(const Problem& problem) {
    return straight_length_between(problem.patch, fixed_alone(problem)) <= longest_single;
}

}  // namespace

Traits::Traits(const Problem& problem)
    : is_large(problem.options.nested && problem.patch.free_count > smallest_large),
      is_tube(problem.patch.loop_count() == 2),
      is_between_tubes(fairing::is_between_tubes(problem.patch, fixed_alone(problem), problem.fixed_normals)),
      has_old_shape(joins_outlines(problem) && problem.before->cols() == problem.patch.vertex_count()),
      poor_share_([&problem] { return share_of_poor_triangles(problem.patch, proxy_membrane(problem, Progress())); }),
      low_passed_([&problem] { return fairing::low_passed(problem); }) {
    const double roughness = outline_variation(problem.patch, boundary_of(problem));
    is_jagged = roughness > smallest_jagged;
    is_beyond_reach = roughness > largest_reached;
    begins_small = problem.patch.loop_count() <= 2 && !is_jagged && is_short(problem);
    has_levels = is_large || (problem.options.nested && problem.patch.free_count > smallest_smooth && begins_small);
}

Problem low_passed(const Problem& problem) {
    const OutlineData outline = low_passed_boundary(problem.patch, boundary_of(problem), wave);
    Problem result = problem;
    result.fixed_points = outline.points;
    result.fixed_normals = outline.normals;
    return result;
}

double distance_of_low_passed(const Problem& problem) {
    return largest_length(problem.fixed_points - low_passed(problem).fixed_points);
}

}  // namespace fairing
