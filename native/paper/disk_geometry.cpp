#include "paper/disk_geometry.h"

#include <Eigen/Geometry>

namespace fairing {

Vector3 disk_normal(const Disk& disk, const Points& points) {
    Vector3 sum = Vector3::Zero();
    const Vector3 centre = points.col(disk.centre);
    const auto neighbours = disk.ring.vertices;
    const Vector3 first = points.col(neighbours.front()) - centre;
    Vector3 a = first;
    for (std::size_t k = 1; k < neighbours.size(); ++k) {
        const Vector3 b = points.col(neighbours[k]) - centre;
        sum += a.cross(b);
        a = b;
    }
    if (disk.ring.closed()) sum += a.cross(first);
    const double length = sum.norm();
    return length > 0.0 ? Vector3(sum / length) : Vector3(Vector3::Zero());
}

Vector3 arc_over(const NormalChord& chord) { return virtual_point(chord) - 0.5 * (chord.a + chord.b); }

}  // namespace fairing
