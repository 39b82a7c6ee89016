// Smooth functions along the curves of a boundary where its curvature is prescribed.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// A piece of a boundary: fixed vertices, counted from the first one, in their order.
struct OutlineCurve {
    Indices places;
    bool closed;
    std::vector<char> skipped = {};  // places where the measured value is meaningless; empty: none
};

// Values (of the fixed vertices) at the places of a curve, interpolated at those that are skipped. Where all are, zero.
VectorX values_along(const OutlineCurve& curve, const VectorX& values);

// Vertices of the fastest wave along a boundary: faster ones change the curvature that is measured there in a way that
// depends on the mesh. Shorter arcs have none.
inline constexpr int fastest_wave = 6;

// Waves along the boundary. Closed curves have sines and cosines, open ones sines that vanish
// beyond their ends. Crowded vertices have shorter waves.
class OutlineModes {
public:
    // `fixed_points`: 3 × fixed vertices. The fastest wave has so many vertices.
    OutlineModes(const std::vector<OutlineCurve>& curves, const Points& fixed_points,
                 int vertices_per_wave = fastest_wave);

    [[nodiscard]] Eigen::Index count() const { return count_; }
    // U c, zero off the curves. The columns of U are nearly orthonormal.
    [[nodiscard]] VectorX combined(const VectorX& coefficients) const;
    // Uᵀ of values at the fixed vertices, interpolated where the curves skip them.
    [[nodiscard]] VectorX projected(const VectorX& values) const;
    // Values of Δ_B H at the boundary that change H there by about −U c. On a straight boundary of the half-plane a
    // wave of frequency k takes 8 k², on a disc of radius a the wave m takes 8 (m + 1)(m + 2)/a².
    [[nodiscard]] VectorX multipliers(const VectorX& coefficients) const;

private:
    struct Curve {
        OutlineCurve outline;
        Eigen::MatrixXd waves;
        VectorX symbol;          // of each wave, for spacing one
        VectorX inverse_square;  // of the spacing at each vertex
    };

    void add_curve(const OutlineCurve& curve, const Points& fixed_points, int vertices_per_wave);

    std::vector<Curve> curves_;
    Eigen::Index count_ = 0;
    Eigen::Index fixed_count_;
};

}  // namespace fairing
