// One update of a level's mesh, M^k → M^(k+1) (paper §7.1, 7.2).
#pragma once

#include "geometry/mean_curvature.h"
#include "geometry/one_ring.h"
#include "multigrid/ring_matrix.h"
#include "paper/options.h"
#include "problem/problem.h"

namespace fairing {

// What stays the same while a level is faired. Fixed vertices are those of the whole patch, in the same order.
struct LevelProblem {
    const Patch& patch;
    const Points& fixed_normals;
    const SolverOptions& solver;
    const PaperOptions& paper;
    RingMatrix weights;
    // Whether the boundary data prescribe the normal.
    [[nodiscard]] bool prescribes_normal(int vertex) const {
        return solver.equation != Equation::soap_film && !patch.is_free(vertex) &&
               !patch.pin[static_cast<std::size_t>(vertex)];
    }
};

// Virtual points: of the present positions, or over chords with the arcs as they were. Between the two updates of a
// cycle those take a sixth fewer updates.
enum class Arcs { present, as_before };

struct LevelState {
    Points points;   // 3 × level vertices
    Points normals;  // prescribed or averaged (§6)
    // 3 × edges: from the middle of each chord to its virtual point. Kept apart from the chord, it stays good enough
    // while vertices move one after the other.
    Points arcs;
    VectorX H;
    Stiffness stiffness;
    std::vector<double> weights;  // w_j of the curvature at the free vertices
    std::vector<std::size_t> weights_begin;

    void measure(const LevelProblem& level, Arcs which);
    // −S H (free count), and S_ii.
    [[nodiscard]] VectorX defect(const LevelProblem& level) const;
    [[nodiscard]] double diagonal(const LevelProblem& level, int vertex) const;
    // The neighbours of a vertex and the virtual points between them (§6.2). Valid until the next call.
    [[nodiscard]] std::span<const Vector3> around(const Patch& patch, int vertex);
    [[nodiscard]] std::span<double> weights_of(int free_vertex);
    // max |Δ_B H| over the free vertices, |H| for minimal surfaces. Infinite where it is not a number.
    [[nodiscard]] double residual(const LevelProblem& level) const;

private:
    void measure_normals(const LevelProblem& level);
    void measure_arcs(const LevelProblem& level);
    void measure_curvature(const LevelProblem& level);

    FaceGeometry faces_;
    OneRingBuffer ring_;
};

class LevelUpdate {
public:
    // `start`: 3 × level vertices.
    LevelUpdate(const LevelProblem& level, Points start);

    // Measures all that an update needs, S included, at the present positions. Returns the residual: infinite where the
    // surface has left all bounds (there the residual, a third power of 1/length, means nothing).
    double measure(Arcs which = Arcs::present);

    // Step I, "local" (Gauss–Seidel sweeps) or "global" (conjugate gradient steps), then step II with damping s
    // (accelerated: less of it next to fixed vertices). Asks for a measurement before.
    void local(double damping);
    void global(double damping);

    [[nodiscard]] const Points& points() const { return state_.points; }
    void move_to(const Points& points) { state_.points = points; }

private:
    // Step I (§7.1), S H = 0 at the free vertices, H known at the fixed ones. Both begin at the H there is and are
    // not meant to converge.
    [[nodiscard]] VectorX wanted_by(void (LevelUpdate::*solve)(VectorX&) const) const;
    void sweep(VectorX& H) const;
    void conjugate_gradient_steps(VectorX& H) const;
    void move_vertices(const VectorX& wanted, double damping);

    const LevelProblem& level_;
    LevelState state_;
    VectorX share_;  // of s, for each free vertex
};

}  // namespace fairing
