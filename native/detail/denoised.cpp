#include "detail/denoised.h"

#include <cmath>
#include <numbers>

#include "base/errors.h"
#include "operators/bending.h"

namespace fairing {

namespace {

// Two passes leave 1 − (q/(1 + q))² of a wave, q = (2π l/wavelength)⁴: all but 1 % at q = 1/9.
double pull_of(double size) { return 9.0 * std::pow(2.0 * std::numbers::pi / size, 4); }

}  // namespace

// With p = l⁻⁴: (K + p A) u = −K x, and what the second pass puts back, −(K + p A)⁻¹ p A u.
Points denoised(const NoisySurface& surface, double size, const Progress& progress) {
    const Points& points = surface.points;
    Bending bending(points, surface.triangles, surface.fixed, surface.loose);
    const Indices& free = bending.free();
    if (free.empty()) return points;
    const double pull = pull_of(size);
    const VectorX pulls = VectorX::Constant(static_cast<Eigen::Index>(free.size()), pull);
    if (!bending.factorise(pulls, "denoise", progress))
        throw SolverError("the roughness could not be taken away: the mesh has triangles without area");
    const Points once = bending.solve(-bending.force(points));
    const Points left = once * (pull * bending.free_areas()).asDiagonal();
    Points result = points;
    result(Eigen::all, free) += once - bending.solve(left);
    return result;
}

}  // namespace fairing
