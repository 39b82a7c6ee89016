// An approximate inverse of the boundary system that Woodbury's identity leaves of the biharmonic operator.
#pragma once

#include "geometry/face_geometry.h"
#include "linear/panel_solve.h"
#include "mesh/patch.h"

namespace fairing {

// Means with both neighbours that make lengths and masses along a boundary smooth.
inline constexpr int smoothing_sweeps = 10;

// G = 4M_B + Cᵀ S_II⁻¹ 4M_I S_II⁻¹ C takes a curvature on the boundary to the turn of the tangent plane there, an
// operator of order −1. On a straight boundary it is ℓ (c + 2/k). ℓ is the length that falls to a vertex, c = 4M_B / ℓ
// about twice the size of a triangle, k the frequency. Let A be the Laplacian of the boundary by arc length
// (eigenvalues k²) and f as HalfOrder has it. Then (ℓ c)^-½ f(c/2 A c/2) (c ℓ)^-½ is about the inverse. ℓ enters as it
// is, since functions on the boundary are smooth in arc length; c enters smoothed.
class BoundarySystem {
public:
    using Row = Eigen::RowVectorXd;  // a value for each fixed vertex

    // `fixed_points`: 3 × fixed vertices.
    BoundarySystem(const Patch& patch, const Points& fixed_points);

    // `quarter_mass`: 4M of the fixed vertices. False where nothing can be made of them.
    [[nodiscard]] bool update(const VectorX& quarter_mass);

    // About G⁻¹, symmetric positive definite.
    [[nodiscard]] Row approximate_inverse(const Row& values) const;

private:
    struct Edge {
        int a;  // fixed vertices, counted from the first one
        int b;
        double length;
    };

    [[nodiscard]] VectorX even(VectorX values) const;

    std::vector<Edge> edges_;
    VectorX length_;  // ℓ; 0 where no edge between fixed vertices ends
    Row scale_;       // (c ℓ)^-½
    HalfOrder half_order_;
};

// A value for each fixed vertex, counted from the first one.
using BoundaryRow = Eigen::RowVectorXd;

class BoundaryCoupling {
public:
    explicit BoundaryCoupling(const Patch& patch);

    void update(const Stiffness& stiffness);

    // C b, a value for each free vertex.
    [[nodiscard]] VectorX spread(const BoundaryRow& boundary) const;
    // Cᵀ a of a value for each free vertex.
    [[nodiscard]] BoundaryRow gather(const VectorX& field) const;
    // Free vertices beside the boundary, with repetitions.
    [[nodiscard]] Indices beside() const;

private:
    // C_ij = −w of an edge.
    struct Entry {
        int i;  // free
        int j;  // fixed, counted from the first one
        int edge;
        double weight;  // w
    };

    int free_count_;
    int fixed_count_;
    std::vector<Entry> entries_;
};

}  // namespace fairing
