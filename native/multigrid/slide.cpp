#include "multigrid/slide.h"

#include "base/parallel.h"
#include "geometry/mean_curvature.h"
#include "geometry/one_ring_buffer.h"
#include "linear/anderson.h"
#include "solver/surface_state.h"

namespace fairing {

namespace {

constexpr int most_steps = 3;
constexpr int history_depth = 3;
constexpr double near_enough = 5e-4;  // units of D; the iteration does the rest

// Adds to tangential steps how far the surface rises along them.
void follow_curvature(const Patch& patch, const Points& points, const Points& normals, Points& d) {
    for_ranges(patch.free_count, fine_grain, [&](int begin, int end) {
        OneRingBuffer buffer;
        for (int i = begin; i < end; ++i) {
            const OneRing ring = buffer.gather(patch, points, i);
            const Vector3 n = normals.col(i);
            d.col(i) += fit_curvature(ring.centre, ring.points, n).rise(n, d.col(i)) * n;
        }
    });
}

}  // namespace

void slide(const Problem& problem, const TangentialStep& tangential, Points& points) {
    const Patch& patch = problem.patch;
    Anderson anderson(3L * patch.free_count, history_depth);
    for (int step = 0; step < most_steps; ++step) {
        const Points normals = max_normals(patch, points, problem.fixed_normals);
        Points d = tangential.displacement(points, normals);
        const double largest = largest_length(d);
        follow_curvature(patch, points, normals, d);
        Eigen::Map<VectorX> x(points.data(), d.size());
        x += anderson.step(x, Eigen::Map<const VectorX>(d.data(), d.size()));
        if (largest < near_enough) return;
    }
}

}  // namespace fairing
