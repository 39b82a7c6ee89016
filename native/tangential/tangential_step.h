// Moves vertices within their tangent planes towards their inner-fairness positions (paper §7.3).
#pragma once

#include "base/progress.h"
#include "fairness/inner_weights.h"
#include "geometry/shape_operator.h"

namespace fairing {

// The tangent planes that vertices move in. Refers to both.
struct TangentPlanes {
    const Points& normals;                   // unit, of the free vertices and maybe others
    const ShapeOperators* shapes = nullptr;  // how the planes turn there; none, or empty: they are taken as fixed

    // NOLINTNEXTLINE(google-explicit-constructor,hicpp-explicit-conversions): most surfaces are known by their normals
    TangentPlanes(const Points& unit_normals) : normals(unit_normals) {}
    TangentPlanes(const Points& unit_normals, const ShapeOperators& known) : normals(unit_normals), shapes(&known) {}
    TangentPlanes(const Points& unit_normals, ShapeOperators&& temporary) = delete;
};

// Vertices with turning tangent planes, moved into a step and released there, to save memory on large patches.
struct TurningPlanes {
    Points points;  // 3 × local vertices
    Points normals;
    ShapeOperators shapes;
};

// How far the systems of tangential steps are solved.
struct Effort {
    double tolerance = 0.05;
    int max_cycles = 10;
};

// Displacements across the normals until Σ_j λ_ij (x_j − x_i) is parallel to the normal at every free vertex.
class TangentialStep {
public:
    TangentialStep() = default;
    TangentialStep(const TangentialStep&) = delete;
    TangentialStep& operator=(const TangentialStep&) = delete;
    virtual ~TangentialStep() = default;

    // Moves the fixed vertices (3 × fixed count); the factorisation does not depend on them.
    virtual void hold(const Points& fixed_points) = 0;

    // The positions with Σ_j λ_ij (x_i − x_j) = 0 in all three coordinates: the discrete harmonic map of the boundary.
    [[nodiscard]] virtual Points harmonic_positions() const = 0;

    // What a step lowers: the Dirichlet energy ½ Σ λ_ij |x_i − x_j|², up to a constant of the fixed vertices.
    [[nodiscard]] virtual double merit(const Points& points) const = 0;

    // |P L x|, the root of the sum of squares over the free vertices: 0 where no step is left.
    [[nodiscard]] virtual double imbalance(const Points& points, const Points& normals) const = 0;

    // d with P L P d = −P L x; P is the projection across the unit normals, L the λ-Laplacian. Conjugate gradients,
    // preconditioned by P L⁻¹ P, to the relative residual `tolerance` or for `max_cycles`. Newton's step where it is
    // known how the planes turn: P L P d − ⟨n, L x⟩ W d = −P L x, since P turns with the vertices and L x stands along
    // the normals at the end. Without it smooth moves on a hemisphere are too short by 60 %. Where that system is not
    // positive definite, the planes count as fixed.
    [[nodiscard]] virtual Points displacement(const Points& points, const TangentPlanes& planes,
                                              Effort effort = {}) const = 0;

    // The same, for planes that are not needed any more.
    [[nodiscard]] virtual Points displacement(TurningPlanes&& temporary, Effort effort) const {
        return displacement(temporary.points, {temporary.normals, temporary.shapes}, effort);
    }
};

// The λ-Laplacian is constant and factorised here, once. `fixed_points`: 3 × fixed count. Throws SolverError where λ
// ties some vertices to no fixed one.
std::unique_ptr<TangentialStep> make_tangential_step(const Patch& patch, const Lambda& weights,
                                                     const Points& fixed_points, const Progress& progress);

}  // namespace fairing
