// Where on a boundary the curvature is known.
#pragma once

#include "mesh/patch.h"

namespace fairing {

// A piece of a boundary: fixed vertices, counted from the first one, in their order.
struct BoundaryCurve {
    Indices places;
    bool closed;
    std::vector<char> skipped = {};  // places where the measured value is meaningless; empty: none
};

// Values (of the fixed vertices) at the places of a curve, interpolated at those that are skipped. Where all are, zero.
VectorX values_along(const BoundaryCurve& curve, const VectorX& values);

// Vertices of the fastest wave along a boundary: faster ones change the curvature that is measured there in a way that
// depends on the mesh. Shorter arcs have none.
inline constexpr int fastest_wave = 6;

// Waves along the boundary. Closed curves have sines and cosines, open ones sines that vanish
// beyond their ends. Crowded vertices have shorter waves.
class BoundaryModes {
public:
    // `fixed_points`: 3 × fixed vertices. The fastest wave has so many vertices.
    BoundaryModes(const std::vector<BoundaryCurve>& curves, const Points& fixed_points,
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
        BoundaryCurve boundary;
        Eigen::MatrixXd waves;
        VectorX symbol;          // of each wave, for spacing one
        VectorX inverse_square;  // of the spacing at each vertex
    };

    void add_curve(const BoundaryCurve& curve, const Points& fixed_points, int vertices_per_wave);

    std::vector<Curve> curves_;
    Eigen::Index count_ = 0;
    Eigen::Index fixed_count_;
};

struct KnownCurvature {
    VectorX values;                     // H at the fixed vertices, 0 off the curves
    std::vector<BoundaryCurve> curves;  // whole loops, or arcs between vertices without a known curvature
    Indices unknown;  // boundary vertices off the curves that ask for it, counted from the first fixed one; ascending

    // What H at the fixed vertices lacks, zero off the curves.
    [[nodiscard]] VectorX missing(const VectorX& curvatures) const;
};

// `curvatures`: H at each fixed vertex, NaN where it is not known, infinite where it is not asked for. Gaps of up to
// three unknown ones are bridged by interpolation; arcs of less than six vertices count as unknown. Pins don't count at
// all. Corners of the patch, where it fills less than 120°, are skipped: H answers to the wedge there as much as to the
// surface, and on boundaries that run in steps it alternates from vertex to vertex. `points`: 3 × local vertices of a
// surface over the boundary.
KnownCurvature known_curvature(const Patch& patch, const Points& points, const VectorX& curvatures);

}  // namespace fairing
