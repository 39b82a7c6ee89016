#include "fillet/profile.h"

#include "base/errors.h"
#include "operators/bending.h"

namespace fairing {

// With B = x − points, 0 at fixed vertices: (K + A pull) B = A pull (target − points).
Points drawn_to(const Points& points, const Triangles& triangles, const Indices& fixed, const Points& target,
                const VectorX& pull) {
    Bending bending(points, triangles, fixed, VectorX::Ones(points.cols()));
    const Indices& free = bending.free();
    if (free.empty()) return points;
    const VectorX pulls = pull(free);
    if (!bending.factorise(pulls, "profile", Progress()))
        throw SolverError("the profile could not be changed: the mesh has triangles without area");
    const VectorX weights = pulls.cwiseProduct(bending.free_areas());
    Points result = points;
    result(Eigen::all, free) += bending.solve((target - points)(Eigen::all, free) * weights.asDiagonal());
    return result;
}

Points least_bent(const Points& points, const Triangles& triangles, const Indices& fixed) {
    Bending bending(points, triangles, fixed, VectorX::Ones(points.cols()));
    const Indices& free = bending.free();
    Points result = points;
    if (free.empty() || !bending.factorise(VectorX::Zero(std::ssize(free)), "start", Progress())) return result;
    result(Eigen::all, free) -= bending.solve(bending.force(points, true));
    return result;
}

}  // namespace fairing
