// A surface as its points and unit normals, and how its vertices may move.
#pragma once

#include "geometry/frame.h"
#include "mesh/patch.h"

namespace fairing {

// 3 × local vertices each.
struct Sheet {
    Points points;
    Points normals;  // unit
};

// Small motions of a vertex: height h along its normal n, and n turned to the direction of n + a u + b v.
using Motion = Vector3;  // (h, a, b)

inline void move(Sheet& sheet, int vertex, const Motion& motion) {
    const Vector3 n = sheet.normals.col(vertex);
    const Frame frame(n);
    sheet.points.col(vertex) += motion[0] * n;
    sheet.normals.col(vertex) = (n + motion[1] * frame.u + motion[2] * frame.v).normalized();
}

}  // namespace fairing
