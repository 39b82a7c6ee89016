// An orthonormal basis of the plane across a unit vector.
#pragma once

#include <cmath>

#include "base/types.h"

namespace fairing {

template <typename Scalar>
struct FrameOf {
    Vector3Of<Scalar> u;
    Vector3Of<Scalar> v;

    // Duff et al. 2017, "Building an orthonormal basis, revisited": no branch that loses accuracy near the poles.
    explicit FrameOf(const Vector3Of<Scalar>& n) {
        using std::copysign;
        const Scalar sign = copysign(Scalar(1.0), n.z());
        const Scalar a = -1.0 / (sign + n.z());
        const Scalar b = n.x() * n.y() * a;
        u = {1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
        v = {b, sign + n.y() * n.y() * a, -n.y()};
    }
};

using Frame = FrameOf<double>;

}  // namespace fairing
