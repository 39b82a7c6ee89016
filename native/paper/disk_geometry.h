// Normals and curvatures of 1-disks by the paper's rules (§6).
#pragma once

#include <vector>

#include "paper/curvature_line.h"
#include "paper/disk.h"

namespace fairing {

// Where virtual points (§6.2) complete the fit, besides valence 3 and 4 and the fixed vertices.
enum class VirtualPoints {
    sparse,     // nowhere else
    coarse,     // at every vertex of the coarse levels
    everywhere  // at every vertex of every level
};

// Averages the cross products around the disk (§6). Zero when they cancel.
Vector3 disk_normal(const Disk& disk, const Points& points);

// Fits curvatures of disks; holds scratch memory. `points` and `normals` (3 × vertices) must outlive it.
class DiskCurvature {
public:
    DiskCurvature(const Points& points, const Points& normals) : points_(points), normals_(normals) {}

    // Of the disk with its centre moved to `centre` and `normal` there, from the neighbours and, where `completed`, a
    // virtual point between every two consecutive ones.
    CurvatureLine operator()(const Disk& disk, const Vector3& centre, const Vector3& normal, bool completed);
    // At the present position and normal.
    CurvatureLine operator()(const Disk& disk, bool completed);

private:
    [[nodiscard]] Vector3 virtual_point_at(const Disk& disk, const Vector3& centre, std::size_t k) const;

    const Points& points_;
    const Points& normals_;
    std::vector<Vector3> ring_;
};

}  // namespace fairing
