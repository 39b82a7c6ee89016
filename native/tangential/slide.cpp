#include "tangential/slide.h"

#include "linear/anderson.h"
#include "linear/limits.h"
#include "linear/shrinking_steps.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr int depth = 3;                   // of the acceleration
constexpr double stuck = 0.8;              // from one step to the next: vertices that the boundary holds back
constexpr double near_enough = 5e-4;       // units of D; the iteration does the rest
constexpr double next_near_enough = 1e-4;  // of the step that would come next, by how the last two shrank

struct Sliding {
    const TargetSurface& target;
    std::vector<SurfacePoint>& where;  // free vertices
    Points& points;                    // 3 × local vertices
    Points normals;                    // at the free vertices
    ShapeOperators shapes;             // likewise, where the vertices began; empty: not known
};

// The vertices stay on the surface by a walk over its triangles. Near extraordinary vertices they have to move over
// several edges: by the curvature of their one-rings, which is noisy there, they would leave it.
void walk(Sliding& vertices) {
    for_ranges(static_cast<int>(vertices.where.size()), fine_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) {
            SurfacePoint& where = vertices.where[v];
            where = vertices.target.project(vertices.points.col(v), where.triangle);
            vertices.points.col(v) = vertices.target.position(where);
            vertices.normals.col(v) = vertices.target.normal(where);
        }
    });
}

void slide(Sliding& vertices, const TangentialStep& tangential, int most_steps) {
    Points& points = vertices.points;
    Anderson anderson(depth);
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < most_steps; ++step) {
        Points d = tangential.displacement(points, {vertices.normals, vertices.shapes});
        const double largest = largest_length(d);
        if (largest > stuck * last) return;
        const double next = largest * std::max(largest / last, fastest_contraction);
        last = largest;
        anderson.move(points, std::move(d), longest_step);
        walk(vertices);
        if (largest < near_enough || (step > 0 && next < next_near_enough)) return;
    }
}

}  // namespace

void slide(const Problem& problem, const TangentialStep& tangential, const Points& normals, ShapeOperators shapes,
           int most_steps, Points& points) {
    const Points surface = points;
    const TargetSurface target(problem.patch, surface, normals);
    std::vector<SurfacePoint> where(problem.patch.free_count);
    for_ranges(problem.patch.free_count, coarse_grain, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) where[v] = target.at_vertex(v);
    });
    Sliding vertices{target, where, points, normals, std::move(shapes)};
    slide(vertices, tangential, most_steps);
}

void slide_on(const TargetSurface& target, const TangentialStep& tangential, int most_steps,
              std::vector<SurfacePoint>& where, Points& points) {
    Points normals(3, static_cast<Eigen::Index>(where.size()));
    for (std::size_t v = 0; v < where.size(); ++v) normals.col(static_cast<Eigen::Index>(v)) = target.normal(where[v]);
    Sliding vertices{target, where, points, std::move(normals), {}};
    slide(vertices, tangential, most_steps);
}

}  // namespace fairing
