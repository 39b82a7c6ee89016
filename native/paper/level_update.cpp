#include "paper/level_update.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "geometry/shape_operator.h"
#include "linear/conjugate_gradients.h"

namespace fairing {

namespace {

// H of a fixed neighbour answers to the vertex too, and H̃ follows it, which eq. 13 leaves out: the step is as much too
// long. Found by trial: 2 to 8 do. As published (no acceleration) all vertices have the same s.
constexpr double answer_of_fixed_neighbours = 4.0;

constexpr double exhausted = 1e-12;  // share of the defect, in the norm of the steps: round-off is left

VectorX damping_shares(const LevelProblem& level) {
    VectorX shares = VectorX::Ones(level.patch.free_count);
    if (level.paper.acceleration == Acceleration::plain) return shares;
    for (int i = 0; i < level.patch.free_count; ++i) {
        const auto neighbours = level.patch.ring(i).vertices;
        const auto fixed =
            std::count_if(neighbours.begin(), neighbours.end(), [&](int v) { return !level.patch.is_free(v); });
        shares[i] = 1.0 / (1.0 + answer_of_fixed_neighbours * static_cast<double>(fixed) /
                                     static_cast<double>(neighbours.size()));
    }
    return shares;
}

// w_j of H = Σ_j w_j κ_j (eq. 10, 11) for the directions from `centre` to the points around it: those of fit_curvature.
void curvature_weights(const Vector3& centre, std::span<const Vector3> around, const Vector3& normal,
                       std::span<double> weights) {
    const Frame frame(normal);
    const auto row = [&](const Vector3& p) -> Vector3 {
        const Vector3 d = p - centre;
        const double x = frame.u.dot(d);
        const double y = frame.v.dot(d);
        const double in_plane = x * x + y * y;
        if (!(in_plane > no_direction * d.squaredNorm())) return Vector3::Zero();
        return Vector3(x * x, x * y, y * y) / in_plane;
    };
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    for (const Vector3& p : around) matrix += row(p) * row(p).transpose();
    const double slight = 1e-9 * matrix.trace() + 1e-300;  // as CurvatureRows
    matrix.diagonal().array() += slight;
    const Vector3 mean = matrix.inverse() * Vector3(0.5, 0.0, 0.5);
    for (std::size_t k = 0; k < around.size(); ++k) weights[k] = mean.dot(row(around[k]));
}

// The input of one vertex update.
struct VertexTarget {
    Vector3 normal;                   // n_i, unit
    std::span<const double> weights;  // w_j: they belong to the directions alone, which stay along the normal
    Vector3 mean;                     // Σ_j λ_ij q_j
    double curvature;                 // H̃_i
    double damping;                   // s
};

// The new position of a vertex. First the weighted mean is projected on the tangent plane: q̃ = mean − ⟨Δq, n⟩ n. Then
// it moves by s t n, with H(q̃ + t n) = H̃ for the linearised curvature (eq. 13: κ_j(t) = κ_j − 2t/|d_j|²). t is limited
// to the distance of the points around (root mean square). Beyond, the linearisation says nothing.
Vector3 updated_position(const Vector3& present, std::span<const Vector3> around, const VertexTarget& target) {
    const Vector3& n = target.normal;
    const Vector3 start = target.mean - n.dot(target.mean - present) * n;
    double mean = 0.0;
    double slope = 0.0;
    double squares = 0.0;
    for (std::size_t k = 0; k < around.size(); ++k) {
        const Vector3 d = around[k] - start;
        const double squared = std::max(d.squaredNorm(), 1e-300);
        mean += 2.0 * target.weights[k] / squared * n.dot(d);
        slope -= 2.0 * target.weights[k] / squared;
        squares += squared;
    }
    if (!(std::abs(slope) > 0.0)) return start;
    const double limit = std::sqrt(squares / static_cast<double>(around.size()));
    const double t = std::clamp((target.curvature - mean) / slope, -limit, limit);
    return std::isfinite(t) ? Vector3(start + target.damping * t * n) : present;
}

}  // namespace

std::span<const Vector3> LevelState::around(const Patch& patch, int vertex) {
    ring_.gather(patch, points, vertex);
    return ring_.with_virtual(patch, vertex, [&](int edge) -> Vector3 {
        const auto [a, b] = patch.edge_ends[edge];
        return 0.5 * (points.col(a) + points.col(b)) + arcs.col(edge);
    });
}

std::span<double> LevelState::weights_of(int free_vertex) {
    const auto i = static_cast<std::size_t>(free_vertex);
    return std::span(weights).subspan(weights_begin[i], weights_begin[i + 1] - weights_begin[i]);
}

void LevelState::measure(const LevelProblem& level, Arcs which) {
    faces_.update(points, level.patch.triangles);
    stiffness.update(faces_, level.patch);
    measure_normals(level);
    if (which == Arcs::present) measure_arcs(level);
    measure_curvature(level);
}

void LevelState::measure_normals(const LevelProblem& level) {
    const Patch& patch = level.patch;
    normals = summed_normals(points, patch.triangles);
    for (int i = 0; i < patch.vertex_count(); ++i) {
        const double length = normals.col(i).norm();
        if (level.prescribes_normal(i)) {
            normals.col(i) = level.fixed_normals.col(i - patch.free_count);
        } else if (length > 0.0) {
            normals.col(i) /= length;
        }
    }
}

void LevelState::measure_arcs(const LevelProblem& level) {
    arcs = edge_virtual_points(level.patch, points, faces_, normals);
    for (int e = 0; e < level.patch.edge_count(); ++e) {
        const auto [a, b] = level.patch.edge_ends[e];
        arcs.col(e) -= 0.5 * (points.col(a) + points.col(b));
    }
}

void LevelState::measure_curvature(const LevelProblem& level) {
    const Patch& patch = level.patch;
    H.resize(patch.vertex_count());
    weights_begin = {0};
    weights.clear();
    for (int i = 0; i < patch.vertex_count(); ++i) {
        const std::span<const Vector3> points_around = around(patch, i);
        H[i] = fit_curvature(points.col(i), points_around, normals.col(i)).mean();
        if (!patch.is_free(i)) continue;
        weights.resize(weights.size() + points_around.size());
        weights_begin.push_back(weights.size());
        curvature_weights(points.col(i), points_around, normals.col(i), weights_of(i));
    }
}

VectorX LevelState::defect(const LevelProblem& level) const {
    const Eigen::RowVectorXd row = H.transpose();
    return -stiffness.apply(level.patch, row, level.patch.free_count).transpose();
}

// Positive unless a whole 1-disk has collapsed.
double LevelState::diagonal(const LevelProblem& level, int vertex) const {
    return std::max(stiffness.diagonal(level.patch, vertex), 1e-9);
}

double LevelState::residual(const LevelProblem& level) const {
    const int n = level.patch.free_count;
    const double largest =
        level.solver.equation == Equation::soap_film
            ? H.head(n).cwiseAbs().maxCoeff<Eigen::PropagateNaN>()
            : defect(level).cwiseAbs().cwiseQuotient(2.0 * stiffness.mass.head(n)).maxCoeff<Eigen::PropagateNaN>();
    return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
}

LevelUpdate::LevelUpdate(const LevelProblem& level, Points start) : level_(level) {
    state_.points = std::move(start);
    share_ = damping_shares(level);
}

double LevelUpdate::measure(Arcs which) {
    if (!state_.points.allFinite()) return std::numeric_limits<double>::infinity();
    state_.measure(level_, which);
    return state_.residual(level_);
}

void LevelUpdate::local(double damping) { move_vertices(wanted_by(&LevelUpdate::sweep), damping); }

void LevelUpdate::global(double damping) { move_vertices(wanted_by(&LevelUpdate::conjugate_gradient_steps), damping); }

VectorX LevelUpdate::wanted_by(void (LevelUpdate::*solve)(VectorX&) const) const {
    if (level_.solver.equation == Equation::soap_film) return VectorX::Zero(state_.H.size());
    VectorX H = state_.H;
    (this->*solve)(H);
    return H;
}

// Gauss–Seidel.
void LevelUpdate::sweep(VectorX& H) const {
    for (int s = 0; s < level_.paper.h_sweeps; ++s) {
        for (int i = 0; i < level_.patch.free_count; ++i) {
            const RingView ring = level_.patch.ring(i);
            double sum = 0.0;
            for (std::size_t k = 0; k < ring.valence(); ++k)
                sum += state_.stiffness.weights[ring.spokes[k]] * H[ring.vertices[k]];
            H[i] = sum / state_.diagonal(level_, i);
        }
    }
}

// Preconditioned by the diagonal.
void LevelUpdate::conjugate_gradient_steps(VectorX& H) const {
    using Row = Eigen::RowVectorXd;
    const int n = level_.patch.free_count;
    Row inverse(n);
    for (int i = 0; i < n; ++i) inverse[i] = 1.0 / state_.diagonal(level_, i);
    Row whole = Row::Zero(H.size());  // stays zero at the fixed vertices
    const auto apply = [&](const Row& p, Row& product) {
        whole.head(n) = p;
        product = state_.stiffness.apply(level_.patch, whole, n);
    };
    const auto precondition = [&](const Row& r, Row& z) { z = inverse.cwiseProduct(r); };
    const Row first = state_.defect(level_).transpose();
    H.head(n) += conjugate_gradients(first, exhausted, level_.paper.cg_steps, apply, precondition).x.transpose();
}

// Neighbours that have moved count with their new position.
void LevelUpdate::move_vertices(const VectorX& wanted, double damping) {
    for (int sweep = 0; sweep < level_.paper.vertex_sweeps; ++sweep) {
        for (int i = 0; i < level_.patch.free_count; ++i) {
            const VertexTarget target{state_.normals.col(i), state_.weights_of(i),
                                      level_.weights.mean(state_.points, i), wanted[i], damping * share_[i]};
            state_.points.col(i) = updated_position(state_.points.col(i), state_.around(level_.patch, i), target);
        }
    }
}

}  // namespace fairing
