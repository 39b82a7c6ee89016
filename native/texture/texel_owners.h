// Which triangle of a UV map lies over each texel of an image.
#pragma once

#include <cstdint>

#include "base/types.h"

namespace fairing {

struct ImageSize {
    int width;
    int height;
};

struct TexelOwners {
    Indices owner;           // width × height, row by row: the last triangle over the texel's centre, or `none`
    std::int64_t count = 0;  // of pairs of a texel and a triangle over its centre
};

// `corners`: 2 × 3 t, in texels from the corner of the first one, whose centre is at (½, ½). Triangles beyond the image
// come in on its other side, as repeated textures do. Triangles that share an edge share no texel and leave none out,
// whatever the rounding. Those that are not finite cover nothing, those larger than four images all. Throws Cancelled.
TexelOwners texel_owners(const Eigen::Matrix2Xd& corners, const ImageSize& size);

// The values (c × 3 t) of the triangles' corners, linear in between: c × (width × height), NaN where no triangle is.
// What lies in several is the last one's.
Eigen::MatrixXf texel_values(const Eigen::Matrix2Xd& corners, const Eigen::MatrixXd& values, const ImageSize& size);

}  // namespace fairing
