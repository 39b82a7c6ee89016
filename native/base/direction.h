// Unit vectors.
#pragma once

#include "base/types.h"

namespace fairing {

// v / |v|, however small or large v is; zero where it has no direction or isn't finite.
inline Vector3 direction(const Vector3& v) {
    const double largest = v.cwiseAbs().maxCoeff();
    if (!v.allFinite() || !(largest > 0.0)) return Vector3::Zero();
    return (v / largest).normalized();
}

}  // namespace fairing
