// The tangent plane of a surface at one of its points, from points around it.
#pragma once

#include "base/types.h"

namespace fairing {

enum class Degree { sphere, strip, quadratic, cubic };
// Whether the surface passes through the centre, or the centre is a noisy point like the others.
enum class Centre { met, free };

struct SlopeFit {
    Vector3 normal;                // unit
    double error = 0.0;            // of the slopes: their standard error plus the change in the last round
    double height = 0.0;           // of the surface over the centre, along the normal; 0 where the centre is met
    double scatter = 0.0;          // standard deviation of the points' heights from the surface
    double mean_curvature = 0.0;   // where the centre projects to, in length⁻¹; −1/R on a sphere with outward normals
    double curvature_error = 0.0;  // its standard error
    // The curvature along a unit tangent t is tᵀ bending t, with the sign of the mean one.
    Eigen::Matrix3d bending = Eigen::Matrix3d::Zero();

    // Unit normal of the fitted surface nearest to the point at this offset from the centre.
    [[nodiscard]] Vector3 normal_at(const Vector3& offset) const;
    // The surface's nearest point to it, as an offset from the centre, to first order in the distance.
    [[nodiscard]] Vector3 foot(const Vector3& offset) const;

    // The terms belong to x², xy, y², x³, x²y, xy², y³ along `x` and `y`, all in units of `scale`.
    Vector3 x = Vector3::Zero();
    Vector3 y = Vector3::Zero();
    double scale = 1.0;
    Eigen::Vector<double, 7> terms = Eigen::Vector<double, 7>::Zero();

private:
    struct Local {
        double across;
        double along;
        double above;
    };
    [[nodiscard]] Local local(const Vector3& offset) const;
    [[nodiscard]] Vector3 gradient(const Local& place) const;
};

// Fits h = a (x² + h²) + b xy + c y² (and cubic terms) by least squares with Gaussian weights. h = ⟨d, n⟩ − c₀ for d =
// p − centre; x and y run along and across the direction of largest curvature. Along x this is a circle: spheres and
// cylinders are fitted exactly, however far around the points reach. c₀ = 0 where the surface passes through the
// centre; else c₀ is fitted and the centre is a point of weight 1. n, the direction and c₀ are iterated from `start`.
// Degree::sphere: h = a (x² + y² + h²), with the same slopes and constant.
// Degree::strip, for points in one or two rows: h = a (x² + h²) + b xy, x along the rows. Such points don't show the
// curvature across; the errors allow for as much as along. Returns nothing where the points are too few to estimate
// an error (6 and 10), don't determine the terms, or turn the normal more than 60° away from `start`.
std::optional<SlopeFit> fit_slopes(const Vector3& centre, std::span<const Vector3> points, const Vector3& start,
                                   Degree degree, Centre at_centre = Centre::met);

}  // namespace fairing
