#include "placement/place.h"

#include "base/parallel.h"
#include "placement/first_placement.h"
#include "placement/relax.h"
#include "placement/tears.h"
#include "placement/untangle.h"

namespace fairing {

bool Projection::try_relaxed(Placement placement) {
    const std::size_t folded = folds_of_placement(problem_, target_, placement).size();
    folded_by_springs_ = std::min(folded_by_springs_, folded);
    return try_as_is(std::move(placement));
}

bool Projection::try_as_is(Placement placement) {
    Indices folded = folds_of_placement(problem_, target_, placement);
    while (!folded.empty()) {
        const std::size_t before = folded.size();
        untangle(problem_, target_, placement);
        folded = folds_of_placement(problem_, target_, placement);
        if (folded.size() > few_folds ? 2 * folded.size() > before : folded.size() >= before) break;
    }
    return keep(std::move(placement), std::move(folded));
}

bool Projection::keep(Placement placement, Indices folded) {
    const bool done = folded.empty();
    const double merit = tangential_.merit(placement.points);
    if (!best_ || folded.size() < best_->folded.size() || (folded.size() == best_->folded.size() && merit < merit_)) {
        best_ = Projected{std::move(placement), std::move(folded), 0};
        merit_ = merit;
    }
    return done;
}

Projected Projection::best() && {
    best_->folded_by_springs = folded_by_springs_;
    return std::move(*best_);
}

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

Projected place(const Problem& problem, const TangentialStep& tangential, const ProxyMesh& history,
                const ProxyMesh::Snapshot& snapshot, const TargetSurface& target) {
    Projection projection(problem, tangential, target);
    Placement start = by_history(problem, history, snapshot, target);
    Placement relaxed = start;
    relax(tangential, target, relaxed);
    if (!projection.try_relaxed(std::move(relaxed))) projection.try_as_is(std::move(start));
    return std::move(projection).best();
}

void refuse_folds(const Problem& problem, const Projected& projected, Solution& solution) {
    constexpr double tolerated_share = 0.05;  // of the triangles
    const bool senseless = !is_uniform(problem.weights) && static_cast<double>(projected.folded_by_springs) >
                                                               tolerated_share * problem.patch.triangle_count();
    if (!senseless && projected.folded.size() <= problem.tolerated_folds) return;
    solution.termination = Termination::folded;
    solution.bad_triangles = projected.folded;
}

}  // namespace fairing
