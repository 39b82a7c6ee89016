// The line that a tube between two boundary loops is swept along.
#pragma once

#include <vector>

#include "base/types.h"

namespace fairing {

// One end of a tube.
struct TubeEnd {
    Vector3 middle;
    Vector3 into;  // the gap; unit
};

// The cubic between two ends that comes nearest to an arc, and frames along it that don't turn about it (Wang et al.
// 2008, double reflection). `s` runs from 0 to 1.
class TubeAxis {
public:
    TubeAxis(const TubeEnd& first, const TubeEnd& last);

    [[nodiscard]] Vector3 place(double s) const;
    // Columns: two across, then the tangent.
    [[nodiscard]] Eigen::Matrix3d frame(double s) const;
    [[nodiscard]] double length() const;
    // Angle between its directions at the ends, radians.
    [[nodiscard]] double turn() const { return turn_; }

private:
    [[nodiscard]] Vector3 tangent(double s) const;
    [[nodiscard]] Vector3 carried(const Vector3& across, double from, double to) const;
    void follow();

    Vector3 begin_;
    Vector3 end_;
    double turn_ = 0.0;
    Vector3 leaving_;   // derivative at s = 0
    Vector3 arriving_;  // at s = 1
    std::vector<Eigen::Matrix3d> frames_;
};

}  // namespace fairing
