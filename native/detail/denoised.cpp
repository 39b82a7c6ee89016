#include "detail/denoised.h"

#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "operators/bending.h"

namespace fairing {

namespace {

// l⁴. Two passes leave 1 − (q/(1 + q))² of a wave, q = (2π l/wavelength)⁴: all but 1 % at q = 1/9.
double bending_weight(double size) { return std::pow(size / (2.0 * std::numbers::pi), 4) / 9.0; }

}  // namespace

// (K + A) u = −K x, and what the second pass puts back, −(K + A)⁻¹ A u.
Points denoised(const NoisySurface& surface, const VectorX& sizes, const Progress& progress) {
    const Points& points = surface.points;
    Bending bending(points, surface.triangles, surface.fixed, sizes.unaryExpr(&bending_weight));
    const Indices& free = bending.free();
    if (free.empty()) return points;
    if (!bending.factorise(VectorX::Ones(static_cast<Eigen::Index>(free.size())), "denoise", progress))
        throw SolverError("the roughness could not be taken away: the mesh has triangles without area");
    const Points once = bending.solve(-bending.force(points));
    Points result = points;
    result(Eigen::all, free) += once - bending.solve(once * bending.free_areas().asDiagonal());
    return result;
}

}  // namespace fairing
