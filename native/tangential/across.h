// The projection P across the normals, and the term that its turning adds to the λ-Laplacian.
#pragma once

#include "base/parallel.h"
#include "tangential/tangential_step.h"

namespace fairing {

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
