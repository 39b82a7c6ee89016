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

Placement first_placement(const Problem& problem, const ProxyMesh& mesh, const ProxyMesh::Snapshot& snapshot,
                          const TargetSurface& target) {
    const Patch& patch = problem.patch;
    // Of every vertex that the proxy mesh ever had; known where the triangle is.
    Points points(3, mesh.number_count());
    std::vector<SurfacePoint> where(at(mesh.number_count()), SurfacePoint{none, Vector3::Zero()});
    const auto put_number = [&](int number, const SurfacePoint& place) {
        where[at(number)] = place;
        points.col(number) = target.position(place);
    };
    for (int v = 0; v < snapshot.patch.vertex_count(); ++v)
        put_number(snapshot.patch.to_input[at(v)], target.at_vertex(v));
    for (auto entry = mesh.removed().rbegin(); entry != mesh.removed().rend(); ++entry) {
        Vector3 mean = Vector3::Zero();
        for (int v : entry->ring) mean += points.col(v) / static_cast<double>(entry->ring.size());
        // Walk from the neighbour that is nearest to the mean.
        const int nearest = *std::min_element(entry->ring.begin(), entry->ring.end(), [&](int a, int b) {
            return (points.col(a) - mean).squaredNorm() < (points.col(b) - mean).squaredNorm();
        });
        put_number(entry->vertex, target.project(mean, where[at(nearest)].triangle));
    }
    Placement placement;
    placement.points.resize(3, patch.vertex_count());
    placement.points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    placement.where.resize(at(patch.free_count));
    for (int v = 0; v < patch.free_count; ++v) put(placement, v, target, where[at(v)]);
    return placement;
}

void relax(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
           Placement& placement) {
    constexpr int most_steps = 40;
    constexpr double largest_step = 0.1;  // units of D
    constexpr double done = 1e-7;
    constexpr int most_halvings = 8;
    double merit = tangential.merit(placement.points, normals_at(placement, target));
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
            const double reached = tangential.merit(trial.points, normals_at(trial, target));
            better = reached < merit;
            if (better) merit = reached;
        }
        if (!better) break;
        placement = std::move(trial);
        placement.last_step = largest;
    }
}

}  // namespace fairing
