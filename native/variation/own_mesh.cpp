#include "variation/own_mesh.h"

#include "variation/lift.h"

namespace fairing {

namespace {

// Vertex of a snapshot by its number in the mesh, `none` for numbers that are not there.
class VertexByNumber {
public:
    explicit VertexByNumber(const Patch& patch) {
        for (int v = 0; v < patch.vertex_count(); ++v) {
            const auto number = static_cast<std::size_t>(patch.to_input[v]);
            if (number >= vertex_.size()) vertex_.resize(number + 1, none);
            vertex_[number] = v;
        }
    }
    [[nodiscard]] int operator()(int number) const {
        return static_cast<std::size_t>(number) < vertex_.size() ? vertex_[number] : none;
    }

private:
    Indices vertex_;
};

// A triangle of the solved mesh near each vertex of the later one: of the vertex itself, or of the nearest that was
// there before.
Indices triangles_nearby(const SolvedSheet& solved, const Patch& later, const TargetSurface& target) {
    const VertexByNumber before(solved.mesh.patch);
    Indices triangle(later.vertex_count(), none);
    Indices queue;
    for (int v = 0; v < later.vertex_count(); ++v) {
        const int old = before(later.to_input[v]);
        if (old == none) continue;
        triangle[v] = target.at_vertex(old).triangle;
        queue.push_back(v);
    }
    for (std::size_t k = 0; k < queue.size(); ++k) {
        for (int u : later.ring(queue[k]).vertices) {
            if (triangle[u] != none) continue;
            triangle[u] = triangle[queue[k]];
            queue.push_back(u);
        }
    }
    return triangle;
}

// A free edge rises along normals that are known only in the end, and has drifted within the surface by then: it begins
// each mesh at the point of its tangent plane above or below the curve that was given.
void undo_drift(const Problem& problem, Sheet& sheet) {
    if (problem.free_edge.empty()) return;
    for (Eigen::Index k = 0; k < problem.fixed_points.cols(); ++k) {
        if (!problem.free_edge[static_cast<std::size_t>(k)]) continue;
        auto point = sheet.points.col(problem.patch.free_count + k);
        const Vector3 given = problem.fixed_points.col(k);
        const Vector3 normal = sheet.normals.col(problem.patch.free_count + k);
        point = given + normal.dot(point - given) * normal;
    }
}

}  // namespace

Problem on_patch(const Problem& problem, const Patch& patch) {
    return {patch, problem.fixed_points,   problem.fixed_normals, uniform_weights(patch), problem.options,
            0,     problem.normal_weights, problem.free_edge};
}

Sheet resampled(const SolvedSheet& solved, const ProxyMesh::Snapshot& later) {
    const TargetSurface target(solved.mesh.patch, solved.sheet.points, solved.sheet.normals);
    const Lift lift(solved.mesh.patch, solved.sheet);
    const Indices triangle = triangles_nearby(solved, later.patch, target);
    Sheet sheet{later.points, Points(3, later.patch.vertex_count())};
    const Eigen::Index fixed = later.patch.vertex_count() - later.patch.free_count;
    sheet.normals.rightCols(fixed) = solved.sheet.normals.rightCols(fixed);
    for (int v = 0; v < later.patch.free_count; ++v) {
        const SurfaceSample sample = lift.sample(target, target.project(later.points.col(v), triangle[v]));
        sheet.points.col(v) = sample.point;
        sheet.normals.col(v) = sample.normal;
    }
    return sheet;
}

SolvedSheet solve_on(ProxyMesh& mesh, const Problem& problem, const std::optional<SolvedSheet>& last, Measure measure,
                     const NewtonLimits& limits, const Progress& progress) {
    auto snapshot = mesh.snapshot();
    const Problem here = on_patch(problem, snapshot.patch);
    Sheet sheet = last ? resampled(*last, snapshot)
                       : Sheet{snapshot.points, fitted_normals(here, snapshot.points, measure, progress.here())};
    undo_drift(here, sheet);
    const VariationEnergy energy(here, Moving::points_and_normals, measure);
    const NewtonResult result = minimise(energy, sheet, limits, progress);
    mesh.read_back(snapshot.patch, sheet.points);
    return {std::move(snapshot), std::move(sheet), result};
}

}  // namespace fairing
