#include "paper/level_update.h"

namespace fairing {

namespace {

// The edges over which a disk of the level has virtual points.
Indices edges_with_arcs(const LevelProblem& level) {
    std::vector<char> wanted(static_cast<std::size_t>(level.patch.edge_count()), 0);
    for (int i = 0; i < level.patch.vertex_count(); ++i) {
        const Disk disk = level.disk(i);
        if (!disk.completed) continue;
        for (int edge : disk.ring.rim) wanted[static_cast<std::size_t>(edge)] = 1;
    }
    Indices edges;
    for (int e = 0; e < level.patch.edge_count(); ++e) {
        if (wanted[static_cast<std::size_t>(e)]) edges.push_back(e);
    }
    return edges;
}

// H of a fixed neighbour answers to the vertex too, and H̃ follows it, which eq. 13 leaves out: the step is as much too
// long. Found by trial: 2 to 8 do. As published (no acceleration) all vertices have the same s.
constexpr double answer_of_fixed_neighbours = 4.0;

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

}  // namespace

double outer_source(const SolverOptions& options, const CurvatureFit& fit) {
    switch (options.equation) {
        case Equation::constant: return options.load;
        case Equation::minimal_energy: {
            const double H = fit.mean();
            return -2.0 * H * (H * H - fit.gaussian());
        }
        case Equation::harmonic:
        case Equation::automatic:
        case Equation::least_variation:
        case Equation::soap_film: return 0.0;
    }
    return 0.0;
}

void LevelState::prepare(const LevelProblem& level) {
    arc_edges_ = edges_with_arcs(level);
    arcs.setZero(3, level.patch.edge_count());
    weights_begin = {0};
    for (int i = 0; i < level.patch.free_count; ++i) {
        weights_begin.push_back(weights_begin.back() + weight_count(level.disk(i)));
    }
    weights.resize(weights_begin.back());
}

std::span<double> LevelState::weights_of(int free_vertex) {
    const auto i = static_cast<std::size_t>(free_vertex);
    return std::span(weights).subspan(weights_begin[i], weights_begin[i + 1] - weights_begin[i]);
}

void LevelState::measure(const LevelProblem& level) {
    if (weights_begin.empty()) prepare(level);
    faces_.update(points, level.patch.triangles);
    stiffness.update(faces_, level.patch);
    measure_normals(level);
    measure_arcs(level);
    measure_curvature(level);
}

void LevelState::measure_again(const LevelProblem& level) {
    faces_.update(points, level.patch.triangles);
    stiffness.update(faces_, level.patch);
    measure_normals(level);
    measure_curvature(level);
}

void LevelState::measure_normals(const LevelProblem& level) {
    const Patch& patch = level.patch;
    normals.setZero(3, patch.vertex_count());
    for (int t = 0; t < patch.triangle_count(); ++t) {
        const Vector3 cross = faces_.areas[t] * faces_.normals.col(t);
        for (int v : patch.triangles.col(t)) normals.col(v) += cross;
    }
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
    for (int e : arc_edges_) {
        const auto [a, b] = level.patch.edge_ends[static_cast<std::size_t>(e)];
        const auto [left, right] = level.patch.edge_triangles[static_cast<std::size_t>(e)];
        Vector3 triangle_normals = faces_.normals.col(left);
        if (right != none) triangle_normals += faces_.normals.col(right);
        arcs.col(e) = arc_over({points.col(a), points.col(b), normals.col(a), normals.col(b), triangle_normals});
    }
}

void LevelState::measure_curvature(const LevelProblem& level) {
    const Patch& patch = level.patch;
    H.resize(patch.vertex_count());
    source.resize(patch.free_count);
    for (int i = 0; i < patch.vertex_count(); ++i) {
        const CurvatureFit fit = fit_(level.disk(i), {points, arcs}, normals.col(i));
        H[i] = fit.mean();
        if (!patch.is_free(i)) continue;
        source[i] = outer_source(level.solver, fit);
        fit_.weights(weights_of(i));
    }
}

VectorX LevelState::right_hand_side(const LevelProblem& level) const {
    // Δ_B H = −(S H)/(2 M) (eq. 5).
    return -2.0 * stiffness.mass.head(level.patch.free_count).cwiseProduct(source);
}

double LevelState::unfairness(const LevelProblem& level) const {
    double largest = 0.0;
    for (int i = 0; i < level.patch.free_count; ++i) {
        const Vector3 delta = level.weights.mean(i, points) - points.col(i);
        const Vector3 across = delta - normals.col(i).dot(delta) * normals.col(i);
        const auto neighbours = level.patch.ring(i).vertices;
        double squared = 0.0;
        for (int v : neighbours) squared += (points.col(v) - points.col(i)).squaredNorm();
        largest = std::max(largest, across.norm() * static_cast<double>(neighbours.size()) / std::max(squared, 1e-300));
    }
    return largest;
}

double LevelState::residual(const LevelProblem& level, const CurvatureEquation& equation) const {
    const int n = level.patch.free_count;
    const double largest = level.solver.equation == Equation::soap_film
                               ? H.head(n).cwiseAbs().maxCoeff<Eigen::PropagateNaN>()
                               : equation.defect(right_hand_side(level), H)
                                     .cwiseAbs()
                                     .cwiseQuotient(2.0 * stiffness.mass.head(n))
                                     .maxCoeff<Eigen::PropagateNaN>();
    return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
}

LevelUpdate::LevelUpdate(const LevelProblem& level, Points start) : level_(level), equation_(level.patch) {
    state_.points = std::move(start);
    share_ = damping_shares(level);
}

double LevelUpdate::measure() {
    if (!state_.points.allFinite()) return std::numeric_limits<double>::infinity();
    state_.measure(level_);
    equation_.assemble(state_.stiffness);
    return state_.residual(level_, equation_);
}

bool LevelUpdate::measure_again() {
    if (!state_.points.allFinite()) return false;
    state_.measure_again(level_);
    equation_.assemble(state_.stiffness);
    return true;
}

void LevelUpdate::local(double damping) {
    VectorX H = state_.H;
    if (level_.solver.equation != Equation::soap_film) {
        equation_.sweep(state_.right_hand_side(level_), level_.paper.h_sweeps, H);
    } else {
        H.setZero();
    }
    move_vertices(H, damping);
}

void LevelUpdate::global(double damping) {
    VectorX H = state_.H;
    if (level_.solver.equation != Equation::soap_film) {
        equation_.conjugate_gradients(state_.right_hand_side(level_), level_.paper.cg_steps, H);
    } else {
        H.setZero();
    }
    move_vertices(H, damping);
}

// Neighbours that have moved count with their new position.
void LevelUpdate::move_vertices(const VectorX& wanted, double damping) {
    const DiskField field{state_.points, state_.arcs};
    for (int sweep = 0; sweep < level_.paper.vertex_sweeps; ++sweep) {
        for (int i = 0; i < level_.patch.free_count; ++i) {
            const VertexTarget target{state_.normals.col(i), state_.weights_of(i),
                                      level_.weights.mean(i, state_.points), wanted[i], damping * share_[i]};
            state_.points.col(i) = updated_position(level_.disk(i), field, target);
        }
    }
}

}  // namespace fairing
