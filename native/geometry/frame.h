// An orthonormal basis of the plane across a unit vector.
#pragma once

#include <cmath>

#include "base/types.h"

namespace fairing {

struct Frame {
    Vector3 u;
    Vector3 v;

    // Duff et al. 2017, "Building an orthonormal basis, revisited": no branch that loses accuracy near the poles.
    explicit Frame(const Vector3& n) {
        const double sign = std::copysign(1.0, n.z());
        const double a = -1.0 / (sign + n.z());
        const double b = n.x() * n.y() * a;
        u = {1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
        v = {b, sign + n.y() * n.y() * a, -n.y()};
    }
};

}  // namespace fairing
