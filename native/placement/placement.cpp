#include "placement/placement.h"

#include "base/parallel.h"

namespace fairing {

Placement at_vertices(const Problem& problem, const TargetSurface& target, const Points& points) {
    Placement placement{{}, points};
    for (int v = 0; v < problem.patch.free_count; ++v) placement.where.push_back(target.at_vertex(v));
    return placement;
}

Placement placed_at(const Problem& problem, const TargetSurface& target, std::vector<SurfacePoint> where) {
    Placement placement{std::move(where), Points(3, problem.patch.vertex_count())};
    placement.points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    for (int v = 0; v < problem.patch.free_count; ++v) put(placement, v, target, placement.where[v]);
    return placement;
}

void put(Placement& placement, int vertex, const TargetSurface& target, const SurfacePoint& where) {
    placement.where[vertex] = where;
    placement.points.col(vertex) = target.position(where);
}

Points normals_at(const Placement& placement, const TargetSurface& target) {
    Points normals(3, static_cast<Eigen::Index>(placement.where.size()));
    for_ranges(static_cast<int>(placement.where.size()), coarse_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) normals.col(v) = target.normal(placement.where[v]);
    });
    return normals;
}

Placement moved(const Placement& placement, const TargetSurface& target, const Points& step) {
    Placement result = placement;
    for_ranges(static_cast<int>(placement.where.size()), fine_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) {
            const Vector3 wanted = placement.points.col(v) + step.col(v);
            put(result, v, target, target.project(wanted, placement.where[v].triangle));
        }
    });
    return result;
}

VectorX carried_over(const Placement& placement, const TargetSurface& target, const VectorX& values,
                     const Problem& problem) {
    VectorX result(problem.patch.vertex_count());
    for (int v = 0; v < problem.patch.free_count; ++v) {
        result[v] = target.interpolate(values, placement.where[v]);
    }
    result.tail(problem.fixed_points.cols()) = values.tail(problem.fixed_points.cols());
    return result;
}

}  // namespace fairing
