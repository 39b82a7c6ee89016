#include "geometry/shape_operator.h"

#include "base/parallel.h"

namespace fairing {

namespace {

// The form as κ(t) = II(t, t) has it: dn = −II.
void put(const CurvatureFit& fit, const Frame& frame, int i, ShapeOperators& shapes) {
    const Eigen::Matrix3d w = -(fit.x0 * frame.u * frame.u.transpose() + fit.x2 * frame.v * frame.v.transpose() +
                                0.5 * fit.x1 * (frame.u * frame.v.transpose() + frame.v * frame.u.transpose()));
    shapes.col(i) << static_cast<float>(w(0, 0)), static_cast<float>(w(1, 1)), static_cast<float>(w(2, 2)),
        static_cast<float>(w(0, 1)), static_cast<float>(w(0, 2)), static_cast<float>(w(1, 2));
}

// Two rows for each neighbour: II t = −dn in the tangent plane.
CurvatureFit fit_turn(const Patch& patch, const Points& points, const Points& normals, int i, const Frame& frame) {
    NormalEquations<3> equations;
    for (const int j : patch.ring(i).vertices) {
        const Vector3 d = points.col(j) - points.col(i);
        const Vector3 turned = normals.col(j) - normals.col(i);
        const double s = frame.u.dot(d);
        const double t = frame.v.dot(d);
        const double squared = s * s + t * t;
        if (!(squared > 0.0) || normals.col(j).isZero()) continue;
        equations.add({s, 0.5 * t, 0.0}, -frame.u.dot(turned), 1.0 / squared);
        equations.add({0.0, 0.5 * s, t}, -frame.v.dot(turned), 1.0 / squared);
    }
    equations.add_to_diagonal(1e-9 * equations.trace() + 1e-300);
    const Vector3 x = equations.solve();
    return {x[0], x[1], x[2]};
}

}  // namespace

ShapeOperators shape_operators(const PatchCurvature& curvature, const Points& normals, int count) {
    ShapeOperators shapes(6, count);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) put(curvature.fit(i), Frame(normals.col(i)), i, shapes);
    });
    return shapes;
}

ShapeOperators shape_operators(const Patch& patch, const Points& points, const Points& normals) {
    ShapeOperators shapes(6, patch.free_count);
    for_ranges(patch.free_count, fine_grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const Frame frame(normals.col(i));
            put(fit_turn(patch, points, normals, i, frame), frame, i, shapes);
        }
    });
    return shapes;
}

}  // namespace fairing
