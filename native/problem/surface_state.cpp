#include "problem/surface_state.h"

#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "geometry/surface_fit.h"
#include "problem/willmore.h"

namespace fairing {

void SurfaceState::measure_faces(const Patch& patch) {
    normals.resize(3, 0);  // of other points by now; the new ones need the room
    curvature = {};
    faces.update(points, patch.triangles);
    stiffness.update(faces, patch);
    faces.cotangents.resize(3, 0);
    faces.areas.resize(0);
}

void SurfaceState::measure_curvature(const Problem& problem) {
    // Without prescribed normals (G0) the outline's come from the surface itself.
    const Points boundary = problem.options.equation == Equation::soap_film ? one_sided_normals(problem.patch, points)
                                                                            : problem.fixed_normals;
    normals = vertex_normals(problem.patch, points, faces, boundary, problem.options.normals);
    curvature = patch_curvature(problem.patch, points, std::exchange(faces, {}), normals, problem.options.normals);
}

SurfaceState measured_surface(const Problem& problem, const Points& points) {
    SurfaceState state;
    state.points = points;
    state.measure_faces(problem.patch);
    state.measure_curvature(problem);
    return state;
}

double willmore_energy(const Problem& problem, const Points& points) {
    SurfaceState state;
    state.points = points;
    state.measure_faces(problem.patch);
    const Points boundary = conormals(problem.patch, problem.fixed_points, problem.fixed_normals);
    return willmore_energy(mixed_curvature_vectors(problem.patch, state.stiffness, points, boundary), state.stiffness);
}

double curvature_variation(const Problem& problem, const Points& points) {
    const SurfaceState state = measured_surface(problem, points);
    const VectorX& H = state.curvature.mean;
    const VectorX half_difference = (H.cwiseAbs2() - state.curvature.gaussian()).cwiseMax(0.0).cwiseSqrt();
    double sum = 0.0;
    for (int e = 0; e < problem.patch.edge_count(); ++e) {
        const auto [i, j] = problem.patch.edge_ends[static_cast<std::size_t>(e)];
        const Eigen::Vector2d difference(H[i] - H[j], half_difference[i] - half_difference[j]);
        // Clipped, for it to be a measure on any mesh.
        sum += std::max(state.stiffness.weights[e], 0.0) * difference.squaredNorm();
    }
    return sum;
}

Points SurfaceState::moves(Points within, const VectorX& heights) const {
    for_ranges(static_cast<int>(within.cols()), coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const Vector3 n = normals.col(i);
            within.col(i) += (heights[i] + curvature.fit(i).rise(n, within.col(i))) * n;
        }
    });
    return within;
}

namespace {

// ∇u at a vertex in the plane across its normal, by least squares over its ring.
Vector3 gradient(const RingView& ring, const SurfaceState& state, const VectorX& heights, int vertex) {
    const Frame frame(state.normals.col(vertex));
    NormalEquations<2> equations;
    for (const int j : ring.vertices) {
        const Vector3 d = state.points.col(j) - state.points.col(vertex);
        const double rise = (j < heights.size() ? heights[j] : 0.0) - heights[vertex];
        equations.add({frame.u.dot(d), frame.v.dot(d)}, rise, 1.0);
    }
    equations.add_to_diagonal(1e-9 * equations.trace() + 1e-300);
    const Eigen::Vector2d slope = equations.solve();
    return slope.x() * frame.u + slope.y() * frame.v;
}

}  // namespace

Raised raised(const Patch& patch, const SurfaceState& state, const VectorX& heights) {
    const int count = static_cast<int>(heights.size());
    Raised result{state.points, Points(3, count)};
    for_ranges(count, fine_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const Vector3 n = state.normals.col(i);
            result.points.col(i) += heights[i] * n;
            result.normals.col(i) = (n - gradient(patch.ring(i), state, heights, i)).normalized();
        }
    });
    return result;
}

double largest_length(const Points& field) { return std::sqrt(field.colwise().squaredNorm().maxCoeff()); }

VectorX harmonic_residual(const Problem& problem, const SurfaceState& state) {
    Eigen::RowVectorXd H = state.curvature.mean.transpose();
    return state.stiffness.apply(problem.patch, H, problem.patch.free_count).transpose();
}

VectorX outer_residual(const Problem& problem, const SurfaceState& state) {
    const int count = problem.patch.free_count;
    const auto mass = state.stiffness.mass.head(count).array();
    const auto H = state.curvature.mean.head(count).array();
    switch (problem.options.equation) {
        case Equation::harmonic:
        case Equation::automatic:
        case Equation::least_variation: break;
        case Equation::soap_film: return 4.0 * mass * H;
        case Equation::constant: return harmonic_residual(problem, state).array() + 2.0 * mass * problem.options.load;
        case Equation::minimal_energy: {
            const auto K = state.curvature.gaussian().head(count).array().eval();
            return harmonic_residual(problem, state).array() - 4.0 * mass * H * (H.square() - K);
        }
    }
    return harmonic_residual(problem, state);
}

double largest_residual(const Problem& problem, const SurfaceState& state, const VectorX& residual) {
    const double factor = problem.options.equation == Equation::soap_film ? 4.0 : 2.0;
    return residual.cwiseAbs().cwiseQuotient(factor * state.stiffness.mass.head(residual.size())).maxCoeff();
}

}  // namespace fairing
