// Curvature of 1-disks (paper §6) and how it changes when the vertex moves (§7.2).
#pragma once

#include "geometry/mean_curvature.h"
#include "geometry/shape_operator.h"
#include "geometry/triangle.h"

namespace fairing {

// Where virtual points (§6.2) complete the fit, besides valence 3 and 4 and the fixed vertices.
enum class VirtualPoints {
    sparse,     // nowhere else
    coarse,     // at every vertex of the coarse levels
    everywhere  // at every vertex of every level
};

// The 1-disk D(q_i) of a vertex. `ring.rim[k]` is the column of `arcs` below that
// belongs to the edge from neighbour k to k + 1; spokes are not read.
struct Disk {
    int centre = none;
    RingView ring;
    bool completed = false;  // a virtual point between every two consecutive neighbours joins the fit
};

// What disks are measured on: positions (3 × vertices) and, for each rim edge, the vector from the middle of its chord
// to its virtual point. Kept apart from the chord, it stays good enough while vertices move one after the other.
struct DiskField {
    const Points& points;
    const Points& arcs;
};

// Numbers that the weights of a disk take up: neighbours and virtual points, each group padded to pairs.
std::size_t weight_count(const Disk& disk);

// The least squares of eq. 8–11 over the neighbours and, where the disk is completed, its virtual points. The unknowns
// are those of κ(φ) = H + a cos 2φ + b sin 2φ instead of eq. 9's, so that H needs one row of the inverse only;
// solution, regularisation and sign are those of fit_curvature. Holds scratch memory.
class DiskFit {
public:
    // The disk as it is, with the unit `normal` at its centre.
    CurvatureFit operator()(const Disk& disk, const DiskField& field, const Vector3& normal);
    // w_j of H = Σ_j w_j κ_j for the disk fitted last; `weights`: weight_count numbers.
    void weights(std::span<double> weights) const;

private:
    using Pair = Eigen::Array2d;  // two points at a time
    struct Direction {
        Pair counted;  // 0 for padding and for points straight above the centre, which have no direction
        Pair cosine;   // of 2φ
        Pair sine;
    };
    struct Sums {
        Pair count{0.0, 0.0}, cosines{0.0, 0.0}, sines{0.0, 0.0}, squares{0.0, 0.0}, products{0.0, 0.0};
        Pair curvatures{0.0, 0.0}, with_cosines{0.0, 0.0}, with_sines{0.0, 0.0};
    };
    CurvatureFit solve(const Sums& sums);

    std::vector<Direction> directions_;
    Vector3 row_;  // of the inverse: w_j = row · (1, cos, sin)
};

// H of a disk as a linear function of the displacement t of its centre along the normal, the distances held:
// κ_j(t) = κ_j − 2t/|d_j|², H(t) = mean + t slope. The slope is negative for decent disks.
struct CurvatureLine {
    double mean;
    double slope;
};

// For weights found before: they belong to the directions alone, which stay the same along the normal. `centre` is
// where the disk's centre is moved to.
CurvatureLine curvature_line(const Disk& disk, const DiskField& field, std::span<const double> weights,
                             const Vector3& centre, const Vector3& normal);

// The input of one vertex update.
struct VertexTarget {
    Vector3 normal;                   // n_i, unit
    std::span<const double> weights;  // of its curvature, see DiskFit
    Vector3 mean;                     // Σ_j λ_ij q_j
    double curvature;                 // H̃_i
    double damping;                   // s
};

// The new position of the disk's centre. First the weighted mean is projected on the tangent plane: q̃ = mean −
// ⟨Δq, n⟩ n. Then it moves by s t n, with H(q̃ + t n) = H̃ for the linearised curvature (eq. 13). t is limited to the
// distance of the neighbours (root mean square). Beyond, the linearisation says nothing.
Vector3 updated_position(const Disk& disk, const DiskField& field, const VertexTarget& target);

}  // namespace fairing
