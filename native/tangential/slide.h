// Moves vertices within a surface that is known from its own mesh alone.
#pragma once

#include "base/parallel.h"
#include "geometry/target_surface.h"
#include "problem/problem.h"
#include "tangential/tangential_step.h"

namespace fairing {

// Moves vertices nearer to their inner-fairness positions, by some accelerated tangential steps, each of which ends on
// the surface as given. `points`: 3 × local vertices; `normals`: unit, of the surface there (0 at pins); `shapes`: how
// the tangent planes turn at the free vertices. Empty: they count as fixed, as where normals are noisy.
void slide(const Problem& problem, const TangentialStep& tangential, const Points& normals, ShapeOperators shapes,
           int most_steps, Points& points);

// The same on another surface. `where`: places of the free vertices on it; `points`: 3 × local vertices.
void slide_on(const TargetSurface& target, const TangentialStep& tangential, int most_steps,
              std::vector<SurfacePoint>& where, Points& points);

// The projection P across the normals, and the term that its turning adds to the λ-Laplacian.
// Removes from each column its part along the normal of the same column; `normals` may have more columns.
inline void project_across(Eigen::Ref<Points> field, const Points& normals) {
    for_ranges(static_cast<int>(field.cols()), coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) field.col(i) -= normals.col(i).dot(field.col(i)) * normals.col(i);
    });
}

// ⟨n, pull⟩ W at the free vertices from W there, for `pull` = −L x before it is projected; empty where W is.
inline ShapeOperators turning(ShapeOperators shapes, const Points& normals, const Points& pull) {
    for_ranges(static_cast<int>(shapes.cols()), coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) shapes.col(i) *= static_cast<float>(pull.col(i).dot(normals.col(i)));
    });
    return shapes;
}

// The same for tangent planes; empty where they count as fixed.
inline ShapeOperators turning(const TangentPlanes& planes, const Points& pull) {
    return planes.shapes ? turning(*planes.shapes, planes.normals, pull) : ShapeOperators();
}

// product ← product + W p
inline void add_turning(const ShapeOperators& turning, const Points& p, Points& product) {
    for_ranges(static_cast<int>(turning.cols()), coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) product.col(i) += turn(turning, i, p.col(i).cast<float>()).cast<double>();
    });
}

}  // namespace fairing
