#include "problem/surface_state.h"

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "geometry/surface_fit.h"

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
    // Without prescribed normals (G0) the boundary's come from the surface itself.
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

Points conormals(const Patch& patch, const Points& fixed_points, const Points& normals) {
    Points result = Points::Zero(3, fixed_points.cols());
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[static_cast<std::size_t>(e)][1] != none) continue;
        const auto [from, to] = patch.edge_ends[static_cast<std::size_t>(e)];
        const int a = from - patch.free_count;
        const int b = to - patch.free_count;
        const Vector3 edge = fixed_points.col(b) - fixed_points.col(a);
        const Vector3 at_a = edge.cross(Vector3(normals.col(a)));
        const Vector3 at_b = edge.cross(Vector3(normals.col(b)));
        result.col(a) += at_a / 3.0 + at_b / 6.0;
        result.col(b) += at_b / 3.0 + at_a / 6.0;
    }
    return result;
}

Points mixed_curvature_vectors(const Patch& patch, const Stiffness& stiffness, const Points& points,
                               const Points& conormals) {
    Points h = -0.5 * stiffness.apply(patch, points, patch.vertex_count());
    h.rightCols(conormals.cols()) += conormals;
    return h;
}

VectorX mixed_mean_curvature(const Points& curvature_vectors, const Stiffness& stiffness, const Points& normals) {
    return curvature_vectors.cwiseProduct(normals).colwise().sum().transpose().cwiseQuotient(2.0 * stiffness.mass);
}

double willmore_energy(const Points& curvature_vectors, const Stiffness& stiffness) {
    return (curvature_vectors.colwise().squaredNorm().transpose().cwiseQuotient(stiffness.mass)).sum();
}

namespace {

// Adds −∂/∂x [Σ_k cot_k ⟨x_a − x_b, y_a − y_b⟩] with y held, and −Σ |y_i|² ∂M_i/∂x, of one triangle.
void add_triangle_gradient(const Eigen::Matrix3d& x, const Eigen::Matrix3d& y, Eigen::Matrix3d& gradient) {
    const Vector3 cross = Vector3(x.col(1) - x.col(0)).cross(Vector3(x.col(2) - x.col(0)));
    const double twice_area = cross.norm();
    if (!(twice_area > 0.0)) return;
    const Vector3 n = cross / twice_area;
    Eigen::Matrix3d area_gradient;  // of twice the area
    for (int k = 0; k < 3; ++k) area_gradient.col(k) = n.cross(Vector3(x.col((k + 2) % 3) - x.col((k + 1) % 3)));
    for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3;
        const int b = (k + 2) % 3;
        const Vector3 to_a = x.col(a) - x.col(k);
        const Vector3 to_b = x.col(b) - x.col(k);
        const double cotangent = to_a.dot(to_b) / twice_area;
        const Vector3 dy = y.col(a) - y.col(b);
        const double product = (to_a - to_b).dot(dy);
        gradient.col(a) -= cotangent * dy + product / twice_area * (to_b - cotangent * area_gradient.col(a));
        gradient.col(b) -= -cotangent * dy + product / twice_area * (to_a - cotangent * area_gradient.col(b));
        gradient.col(k) += product / twice_area * (to_a + to_b + cotangent * area_gradient.col(k));
    }
    gradient -= y.colwise().squaredNorm().sum() / 6.0 * area_gradient;
}

}  // namespace

Points willmore_gradient(const Patch& patch, const Stiffness& stiffness, const Points& points,
                         const Points& curvature_vectors) {
    const Points y = curvature_vectors.array().rowwise() / stiffness.mass.transpose().array();
    Points gradient = Points::Zero(3, patch.vertex_count());
    for (const auto triangle : patch.triangles.colwise()) {
        Eigen::Matrix3d corners;
        Eigen::Matrix3d values;
        for (int k = 0; k < 3; ++k) {
            corners.col(k) = points.col(triangle[k]);
            values.col(k) = y.col(triangle[k]);
        }
        Eigen::Matrix3d local = Eigen::Matrix3d::Zero();
        add_triangle_gradient(corners, values, local);
        for (int k = 0; k < 3; ++k) gradient.col(triangle[k]) += local.col(k);
    }
    return gradient.leftCols(patch.free_count);
}

}  // namespace fairing
