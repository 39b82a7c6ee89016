#include "outline/chain_end.h"

#include <Eigen/Eigenvalues>

namespace fairing {

ChainEnd end_of_chain(const Points& chain) {
    const Eigen::Index count = chain.cols() - 1;
    const Vector3 first = chain.col(1) - chain.col(0);
    if (count == 1) return {-first.normalized(), Vector3::Zero()};
    // An inversion about the end makes a straight line of the circle, parallel to its tangent there and at a distance
    // of half the curvature. It magnifies errors by the inverse square of the distance: hence the weights.
    Points places(3, count);
    VectorX weights(count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const Vector3 out = chain.col(k + 1) - chain.col(0);
        places.col(k) = out / out.squaredNorm();
        weights[k] = out.squaredNorm() / first.squaredNorm();
    }
    const Vector3 middle = places * weights / weights.sum();
    const Points off = places.colwise() - middle;
    const Eigen::Matrix3d spread = off * weights.asDiagonal() * off.transpose();
    Vector3 along = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
    if (along.dot(off.col(0)) < 0.0) along = -along;
    return {-along, 2.0 * (middle - middle.dot(along) * along)};
}

}  // namespace fairing
