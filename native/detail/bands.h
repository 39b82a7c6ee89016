// A field on a mesh, sorted by the length of its waves.
#pragma once

#include <optional>

#include "base/progress.h"
#include "linear/sparse_cholesky.h"

namespace fairing {

// M + t S/2 of all vertices of a triangle list, both triangles of it stored: S as in Stiffness, ends of borders free,
// so that constants stay constants. Vertices without triangles have 1. `t`: a length squared.
SparseMatrix screened_laplacian(const Points& points, const Triangles& triangles, double t);

// Low-pass filters 1/(1 + t k²)² one after the other, each of which keeps half of the waves of its length.
class Bands {
public:
    // `wavelengths`: ascending, in the points' unit. Nothing where the mesh has degenerated. Throws Cancelled.
    static std::optional<Bands> of(const Points& points, const Triangles& triangles,
                                   const std::vector<double>& wavelengths, const Progress& progress);

    // n × (k + 1): shorter than the first wavelength, from there to the next, …, longer than the last. Their sum is the
    // field (n).
    [[nodiscard]] Eigen::MatrixXd split(const VectorX& field) const;

private:
    VectorX mass_;
    std::vector<SparseCholesky> low_;
};

}  // namespace fairing
