#include "proxy/placement.h"

#include <algorithm>

#include "linear/anderson.h"
#include "solver/surface_state.h"

namespace fairing {

namespace {

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

// Moves the vertices of a placement by `step` (3 × free count), along the surface.
Placement moved(const Placement& placement, const TargetSurface& target, const Points& step) {
    Placement result = placement;
    for (int v = 0; v < static_cast<int>(placement.where.size()); ++v) {
        put(result, v, target, target.project(placement.points.col(v) + step.col(v), placement.where[at(v)].triangle));
    }
    return result;
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

Placement near(const Placement& placement, const TargetSurface& target, const Points& points) {
    const auto count = static_cast<Eigen::Index>(placement.where.size());
    return moved(placement, target, points.leftCols(count) - placement.points.leftCols(count));
}

double relax(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
             Placement& placement) {
    constexpr int most_steps = 60;
    constexpr double largest_step = 0.1;  // units of D
    constexpr double done = 1e-7;
    constexpr int most_halvings = 8;
    constexpr int history_depth = 5;
    const auto merit_of = [&](const Placement& p) { return tangential.merit(p.points, normals_at(p, target)); };
    // Where the surface is curved, plain steps are too short by the same share each time: acceleration learns it.
    Anderson anderson(3L * problem.patch.free_count, history_depth);
    double merit = merit_of(placement);
    for (int step = 0; step < most_steps; ++step) {
        const Points d = tangential.displacement(placement.points, normals_at(placement, target));
        const double largest = largest_length(d);
        if (largest < done) break;
        const auto as_vector = [&](const auto& points) { return VectorX(points.reshaped()); };
        const VectorX far = anderson.step(as_vector(placement.points.leftCols(d.cols())), as_vector(d));
        bool better = false;
        double length = std::min(1.0, largest_step / largest);
        for (int attempt = 0; attempt <= most_halvings && !better; ++attempt) {
            Points move = Eigen::Map<const Points>(far.data(), 3, d.cols());
            if (attempt == 0) {
                move *= std::min(1.0, largest_step / largest_length(move));
            } else {
                move = length * d;
                length *= 0.5;
            }
            Placement trial = moved(placement, target, move);
            const double reached = merit_of(trial);
            better = reached < merit;
            if (!better) continue;
            merit = reached;
            placement = std::move(trial);
        }
        if (!better) break;
    }
    return merit;
}

double settle(const Problem& problem, const TangentialStep& tangential, const TargetSurface& target,
              Placement& placement, const Progress& progress) {
    if (const auto* rows = std::get_if<RowWeights>(&problem.weights)) {
        const auto symmetric = make_tangential_step(problem.patch, symmetrised(*rows), problem.fixed_points, progress);
        relax(problem, *symmetric, target, placement);
    }
    return relax(problem, tangential, target, placement);
}

Placement at_vertices(const Problem& problem, const TargetSurface& target, const Points& points) {
    Placement placement{{}, points};
    for (int v = 0; v < problem.patch.free_count; ++v) placement.where.push_back(target.at_vertex(v));
    return placement;
}

VectorX carried_over(const Placement& placement, const TargetSurface& target, const VectorX& values,
                     const Problem& problem) {
    VectorX result(problem.patch.vertex_count());
    for (int v = 0; v < problem.patch.free_count; ++v) {
        result[v] = target.interpolate(values, placement.where[at(v)]);
    }
    result.tail(problem.fixed_points.cols()) = values.tail(problem.fixed_points.cols());
    return result;
}

}  // namespace fairing
