#include "problem/free_slopes.h"

#include <algorithm>

#include "geometry/vertex_normal.h"

namespace fairing {

namespace {

bool is_on_curve(const Patch& patch, int pin) {
    const RingView ring = patch.ring(pin);
    return !ring.closed() ||
           std::any_of(ring.vertices.begin(), ring.vertices.end(), [&](int v) { return !patch.is_free(v); });
}

// A loop of pins, and no other fixed vertex.
bool is_one_bare_loop(const Patch& patch) {
    for (int v = patch.free_count; v < patch.vertex_count(); ++v) {
        if (!patch.pin[v] || patch.ring(v).closed()) return false;
    }
    return patch.loop_count() == 1;
}

}  // namespace

Equation equation_for(const Patch& patch, Equation asked) {
    if (asked == Equation::minimal) return asked;
    bool curves = false;
    for (int v = patch.free_count; v < patch.vertex_count() && !curves; ++v)
        curves = patch.pin[v] && is_on_curve(patch, v);
    if (!curves) return asked;
    return is_one_bare_loop(patch) ? Equation::minimal : Equation::least_variation;
}

Problem with_slopes_of(const Problem& problem, const Points& points) {
    Problem result = problem;
    const Points normals = max_normals(problem.patch, points, problem.fixed_normals);
    for (int k = 0; k < result.fixed_normals.cols(); ++k) {
        const int v = problem.patch.free_count + k;
        if (problem.patch.pin[v]) result.fixed_normals.col(k) = normals.col(v);
    }
    return result;
}

}  // namespace fairing
