// Columns gathered one by one.
#pragma once

#include "base/types.h"

namespace fairing {

// Of points or triangles.
template <typename Column>
Eigen::Matrix3X<typename Column::Scalar> as_columns(const std::vector<Column>& columns) {
    Eigen::Matrix3X<typename Column::Scalar> result(3, static_cast<Eigen::Index>(columns.size()));
    Eigen::Index k = 0;
    for (const Column& column : columns) result.col(k++) = column;
    return result;
}

}  // namespace fairing
