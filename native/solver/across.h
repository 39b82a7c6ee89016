// The projection P across the normals.
#pragma once

#include "base/types.h"

namespace fairing {

// Takes from each column its part along the normal of the same column; `normals` may have more columns.
inline void project_across(Eigen::Ref<Points> field, const Points& normals) {
    for (Eigen::Index i = 0; i < field.cols(); ++i) {
        field.col(i) -= normals.col(i).dot(field.col(i)) * normals.col(i);
    }
}

}  // namespace fairing
