#include "detail/relaid.h"

#include "base/limits.h"
#include "geometry/flips.h"
#include "problem/surface_state.h"
#include "tangential/slide.h"

namespace fairing {

Points relaid(const Problem& problem, const Points& points, const Points& base, const Progress& progress) {
    const Patch& patch = problem.patch;
    Problem conformal = problem;
    conformal.weights = conformal_weights(patch, base);
    const auto tangential = make_tangential_step(patch, conformal.weights, problem.fixed_points, progress);
    Points slid = points;
    slide(conformal, *tangential, measured_surface(problem, points).normals, Turning::known, most_iterations, slid);
    const std::size_t usual = flipped_triangles(patch, points).size() + flipped_triangles(patch, base).size();
    const bool worse = !slid.allFinite() || flipped_triangles(patch, slid).size() > usual;
    return worse ? points : slid;
}

}  // namespace fairing
