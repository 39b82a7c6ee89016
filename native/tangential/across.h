// The projection P across the normals.
#pragma once

#include "base/parallel.h"
#include "base/types.h"

namespace fairing {

// Takes from each column its part along the normal of the same column; `normals` may have more columns.
inline void project_across(Eigen::Ref<Points> field, const Points& normals) {
    for_ranges(static_cast<int>(field.cols()), coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) field.col(i) -= normals.col(i).dot(field.col(i)) * normals.col(i);
    });
}

}  // namespace fairing
