#include "paper/disk_geometry.h"

#include <Eigen/Geometry>

#include "geometry/virtual_points.h"

namespace fairing {

namespace {

// Zero where the triangle is degenerate, as in FaceGeometry.
Vector3 unit_normal(const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 cross = (b - a).cross(c - a);
    const double length = cross.norm();
    return length > 0.0 ? Vector3(cross / length) : Vector3(Vector3::Zero());
}

}  // namespace

Vector3 disk_normal(const Disk& disk, const Points& points) {
    Vector3 sum = Vector3::Zero();
    const Vector3 centre = points.col(disk.centre);
    const std::size_t count = disk.valence();
    for (std::size_t k = 0; k < disk.rim_size(); ++k) {
        const Vector3 a = points.col(disk.neighbours[k]) - centre;
        const Vector3 b = points.col(disk.neighbours[k + 1 < count ? k + 1 : 0]) - centre;
        sum += a.cross(b);
    }
    const double length = sum.norm();
    return length > 0.0 ? Vector3(sum / length) : Vector3(Vector3::Zero());
}

Vector3 DiskCurvature::virtual_point_at(const Disk& disk, const Vector3& centre, std::size_t k) const {
    const int a = disk.neighbours[k];
    const int b = disk.neighbours[k + 1 < disk.valence() ? k + 1 : 0];
    const int apex = disk.apexes[k];
    Vector3 triangle_normals = unit_normal(centre, points_.col(a), points_.col(b));
    if (apex != none) triangle_normals += unit_normal(points_.col(b), points_.col(a), points_.col(apex));
    return virtual_point({points_.col(a), points_.col(b), normals_.col(a), normals_.col(b), triangle_normals});
}

CurvatureLine DiskCurvature::operator()(const Disk& disk, const Vector3& centre, const Vector3& normal,
                                        bool completed) {
    ring_.clear();
    for (int v : disk.neighbours) ring_.emplace_back(points_.col(v));
    if (completed) {
        for (std::size_t k = 0; k < disk.rim_size(); ++k) ring_.push_back(virtual_point_at(disk, centre, k));
    }
    return curvature_line(centre, ring_, normal);
}

CurvatureLine DiskCurvature::operator()(const Disk& disk, bool completed) {
    return (*this)(disk, points_.col(disk.centre), normals_.col(disk.centre), completed);
}

}  // namespace fairing
