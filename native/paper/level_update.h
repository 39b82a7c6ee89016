// One update of a level's mesh, M^k → M^(k+1) (paper §7.1, 7.2).
#pragma once

#include "paper/level.h"
#include "paper/vertex_update.h"

namespace fairing {

class LevelUpdate {
public:
    // `start`: 3 × level vertices.
    LevelUpdate(const LevelProblem& level, Points start);

    // Measures all that an update needs, S included, at the present positions. Returns the residual: infinite where the
    // surface has left all bounds (there the residual, a third power of 1/length, means nothing).
    double measure();
    // The same between two updates of a cycle, with the virtual points' arcs as they were and without a residual; false
    // where the surface has left all bounds.
    bool measure_again();

    // Step I, "local" (Gauss–Seidel sweeps) or "global" (conjugate gradient steps), then step II with damping s
    // (accelerated: less of it next to fixed vertices). Asks for a measurement before.
    void local(double damping);
    void global(double damping);

    [[nodiscard]] double unfairness() const { return state_.unfairness(level_); }
    [[nodiscard]] const Points& points() const { return state_.points; }
    void move_to(const Points& points) { state_.points = points; }

private:
    void move_vertices(const VectorX& wanted, double damping);

    const LevelProblem& level_;
    CurvatureEquation equation_;
    LevelState state_;
    VectorX share_;  // of s, for each free vertex
};

}  // namespace fairing
