#include "tangential/slide.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"
#include "geometry/target_surface.h"
#include "linear/anderson.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr int history_depth = 3;
constexpr double longest_move = 0.1;  // units of D
constexpr double stuck = 0.8;         // from one step to the next: vertices that the outline holds back
constexpr double near_enough = 5e-4;  // units of D; the iteration does the rest

// Vertices on a surface that stays as it is. Near extraordinary vertices they have to move over several edges: by the
// curvature of their one-rings, which is noisy there, they would leave it.
class SlidingVertices {
public:
    SlidingVertices(const TargetSurface& target, int count) : target_(target), where_(at(count)) {
        for (int v = 0; v < count; ++v) where_[at(v)] = target.at_vertex(v);
    }

    void walk_to(Points& points, Points& normals) {
        for_ranges(static_cast<int>(where_.size()), fine_grain, [&](int begin, int end) {
            for (int v = begin; v < end; ++v) {
                SurfacePoint& where = where_[at(v)];
                where = target_.project(points.col(v), where.triangle);
                points.col(v) = target_.position(where);
                normals.col(v) = target_.normal(where);
            }
        });
    }

private:
    const TargetSurface& target_;
    std::vector<SurfacePoint> where_;
};

}  // namespace

void slide(const Problem& problem, const TangentialStep& tangential, const Points& normals, int most_steps,
           Points& points) {
    const Patch& patch = problem.patch;
    const Points surface = points;
    const TargetSurface target(patch, surface, normals);
    SlidingVertices vertices(target, patch.free_count);
    Points present = normals;
    Anderson anderson(3L * patch.free_count, history_depth);
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < most_steps; ++step) {
        const Points d = tangential.displacement(points, present);
        const double largest = largest_length(d);
        if (largest > stuck * last) return;
        last = largest;
        Eigen::Map<VectorX> x(points.data(), d.size());
        const VectorX move = anderson.step(x, Eigen::Map<const VectorX>(d.data(), d.size()));
        x += std::min(1.0, longest_move / largest_length(Eigen::Map<const Points>(move.data(), 3, d.cols()))) * move;
        vertices.walk_to(points, present);
        if (largest < near_enough) return;
    }
}

}  // namespace fairing
