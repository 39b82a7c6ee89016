// The tube between two boundary loops that face each other along a bend.
#pragma once

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

// From so many radians of turn on membranes and lofts are drawn to the inner side of a tube.
inline constexpr double wide_bend = 1.2;

// The end of a tube at a loop (columns of `points` and `normals`), the surface on its left. Nothing where the surface
// leaves the loop in many directions, as a flat ring does.
std::optional<TubeEnd> tube_end(const Indices& loop, const Points& points, const Points& normals);

// The area within a closed loop (columns of `points`): that of its projection in the direction where this is largest.
double area_within(const Indices& loop, const Points& points);

// Radius of the circle with that area.
double radius_of_area(double area);

// A closed section in its frame of the axis. Shares are those of its length, in [0, 1).
class TubeSection {
public:
    // `loop`: counter-clockwise around the axis, columns of `points`; it begins at `first`.
    TubeSection(const Indices& loop, std::size_t first, const Points& points, const TubeAxis& axis, double s);

    [[nodiscard]] Vector3 at_share(double u) const;
    // Around the axis, from the one with the share 0.
    [[nodiscard]] const Indices& vertices() const { return vertices_; }
    [[nodiscard]] double share(std::size_t k) const { return shares_[k]; }
    [[nodiscard]] double girth() const { return girth_; }

private:
    Indices vertices_;
    std::vector<Vector3> locals_;  // these two: once more the first one at the end
    std::vector<double> shares_;
    double girth_;
};

// The sections are swept along the cubic that leaves each loop's middle into the gap, and blended in between.
class SweptTube {
public:
    // `loops`: columns of `points` and `normals` (3 × boundary vertices), the surface on their left. Nothing where
    // there are other than two, where they leave out a vertex, or where they don't face along one tube.
    static std::optional<SweptTube> between(const std::vector<Indices>& loops, const Points& points,
                                            const Points& normals);

    // `s`: 0 at the first loop, 1 at the second one; `u`: share around.
    [[nodiscard]] Vector3 place(double s, double u) const;
    [[nodiscard]] const TubeSection& first() const { return first_; }
    [[nodiscard]] const TubeSection& last() const { return last_; }
    [[nodiscard]] double length() const { return axis_.length(); }
    [[nodiscard]] double turn() const { return axis_.turn(); }  // radians

private:
    SweptTube(TubeAxis axis, TubeSection first, TubeSection last);

    TubeAxis axis_;
    TubeSection first_;
    TubeSection last_;
};

}  // namespace fairing
