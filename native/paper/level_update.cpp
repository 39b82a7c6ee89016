#include "paper/level_update.h"

#include <algorithm>
#include <limits>

namespace fairing {

namespace {

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
