#include "problem/free_slopes.h"

#include <Eigen/Geometry>

#include "geometry/surface_fit.h"
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

// The direction of the border at each vertex of a closed loop: that of the chord between its neighbours.
Vector3 chord(const Points& points, const Indices& loop, std::size_t k) {
    const std::size_t n = loop.size();
    return (points.col(loop[(k + 1) % n]) - points.col(loop[(k + n - 1) % n])).normalized();
}

// By how much the normals given turn about the border away from the surface's, carried on linearly along a loop where
// none are given. A loop without given ones keeps the surface's.
void turn_along(const Indices& loop, const Problem& problem, const Points& points, const Points& normals,
                Points& turned) {
    const int free = problem.patch.free_count;
    const std::size_t n = loop.size();
    std::vector<std::size_t> given;
    for (std::size_t k = 0; k < n; ++k) {
        if (!problem.patch.pin[loop[k]]) given.push_back(k);
    }
    if (given.empty() || given.size() == n) return;
    const auto angle = [&](std::size_t k) {
        const Vector3 own = normals.col(loop[k] - free);
        const Vector3 wanted = problem.fixed_normals.col(loop[k] - free);
        return std::atan2(own.cross(wanted).dot(chord(points, loop, k)), own.dot(wanted));
    };
    for (std::size_t g = 0; g < given.size(); ++g) {
        const std::size_t from = given[g];
        const std::size_t gap = (given[(g + 1) % given.size()] + n - from - 1) % n + 1;
        const double first = angle(from), last = angle((from + gap) % n);
        for (std::size_t k = 1; k < gap; ++k) {
            const std::size_t at = (from + k) % n;
            const double share = static_cast<double>(k) / static_cast<double>(gap);
            const Eigen::AngleAxisd turn((1 - share) * first + share * last, chord(points, loop, at));
            turned.col(loop[at] - free) = turn * normals.col(loop[at] - free);
        }
    }
}

}  // namespace

Equation equation_for(const Patch& patch, Equation asked) {
    if (asked == Equation::soap_film) return asked;
    bool curves = false;
    for (int v = patch.free_count; v < patch.vertex_count() && !curves; ++v)
        curves = patch.pin[v] && is_on_curve(patch, v);
    if (!curves) return asked;
    return is_one_bare_loop(patch) ? Equation::soap_film : Equation::least_variation;
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

Problem with_slopes_carried_on(const Problem& problem, const Points& points) {
    Problem result = with_slopes_of(problem, points);
    const Points normals = one_sided_normals(problem.patch, points);
    for (const Indices& loop : problem.patch.loops()) turn_along(loop, problem, points, normals, result.fixed_normals);
    return result;
}

}  // namespace fairing
