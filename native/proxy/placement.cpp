#include "proxy/placement.h"

#include <algorithm>
#include <limits>

#include "solver/surface_state.h"

namespace fairing {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

void put(Placement& placement, int vertex, const TargetSurface& target, const SurfacePoint& where) {
    placement.where[at(vertex)] = where;
    placement.points.col(vertex) = target.position(where);
}

Points normals_at(const Placement& placement, const TargetSurface& target) {
    Points normals(3, static_cast<Eigen::Index>(placement.where.size()));
    for (std::size_t v = 0; v < placement.where.size(); ++v) {
        normals.col(static_cast<Eigen::Index>(v)) = target.normal(placement.where[v]);
    }
    return normals;
}

}  // namespace

Placement first_placement(const Problem& problem, const std::vector<RemovedVertex>& removed, const Indices& number,
                          const TargetSurface& target) {
    const Patch& patch = problem.patch;
    Placement placement;
    placement.where.resize(at(patch.free_count));
    placement.points.resize(3, patch.vertex_count());
    placement.points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    Indices triangle(at(patch.vertex_count()), none);  // where a vertex that is placed already lies
    for (int v = 0; v < patch.vertex_count(); ++v) {
        if (number[at(v)] == none) continue;
        const SurfacePoint where = target.at_vertex(number[at(v)]);
        triangle[at(v)] = where.triangle;
        if (patch.is_free(v)) put(placement, v, target, where);
    }
    for (auto entry = removed.rbegin(); entry != removed.rend(); ++entry) {
        Vector3 mean = Vector3::Zero();
        for (int v : entry->ring) mean += placement.points.col(v) / static_cast<double>(entry->ring.size());
        // Walk from the neighbour that is nearest to the mean.
        int nearest = entry->ring.front();
        for (int v : entry->ring) {
            if ((placement.points.col(v) - mean).squaredNorm() < (placement.points.col(nearest) - mean).squaredNorm()) {
                nearest = v;
            }
        }
        const SurfacePoint where = target.project(mean, triangle[at(nearest)]);
        triangle[at(entry->vertex)] = where.triangle;
        put(placement, entry->vertex, target, where);
    }
    return placement;
}

void relax(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
           Placement& placement) {
    constexpr int most_steps = 40;
    constexpr double largest_step = 0.1;  // units of D
    constexpr double done = 1e-7;
    constexpr int most_halvings = 8;
    double energy = tangential.energy(placement.points);
    for (int step = 0; step < most_steps; ++step) {
        const Points d = tangential.displacement(placement.points, normals_at(placement, target));
        const double largest = largest_length(d);
        if (largest < done) break;
        double length = std::min(1.0, largest_step / largest);
        Placement trial = placement;
        bool better = false;
        for (int halving = 0; halving < most_halvings && !better; ++halving, length *= 0.5) {
            for (int v = 0; v < problem.patch.free_count; ++v) {
                const Vector3 wanted = placement.points.col(v) + length * d.col(v);
                put(trial, v, target, target.project(wanted, placement.where[at(v)].triangle));
            }
            const double reached = tangential.energy(trial.points);
            better = reached < energy;
            if (better) energy = reached;
        }
        if (!better) break;
        placement = std::move(trial);
        placement.last_step = largest;
    }
}

}  // namespace fairing
