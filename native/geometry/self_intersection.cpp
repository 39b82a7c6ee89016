#include "geometry/self_intersection.h"

#include <atomic>

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include "base/parallel.h"
#include "geometry/box_tree.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

using Box = Eigen::AlignedBox3d;
using Corners = std::array<Vector3, 3>;

// Six times the signed volume of a tetrahedron.
double volume(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    return area_vector(a, b, c).dot(d - a);
}

Corners corners_of(const Triangles& triangles, const Points& points, int t) {
    return {points.col(triangles(0, t)), points.col(triangles(1, t)), points.col(triangles(2, t))};
}

Box box_around(const Corners& corners) {
    Box box;
    for (const Vector3& corner : corners) box.extend(corner);
    return box;
}

struct Face {
    std::array<int, 3> vertices;
    Corners corners;
    [[nodiscard]] bool has(int v) const { return v == vertices[0] || v == vertices[1] || v == vertices[2]; }
};

using Heights = std::array<double, 3>;

// Heights of a face's corners over the plane of another one with this area vector, times twice its area.
Heights heights(const Face& face, const Face& other, const Vector3& area) {
    Heights above;
    for (std::size_t k = 0; k < 3; ++k) above[k] = area.dot(face.corners[k] - other.corners[0]);
    return above;
}

// All of a face lies on one side of another's plane: neither passes through the other. Most neighbours end here.
bool lie_beside(const Heights& above) {
    const auto [p, q, r] = above;
    return std::min({p, q, r}) >= 0.0 || std::max({p, q, r}) <= 0.0;
}

// Whether the line pq passes through the inside of the triangle: all volumes have the sign of `slack` and are larger
// than it in size.
bool passes_inside(const Vector3& p, const Vector3& q, const Corners& t, double slack) {
    const double sign = slack > 0.0 ? 1.0 : -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(sign * volume(p, q, t[k], t[(k + 1) % 3]) > std::abs(slack))) return false;
    }
    return true;
}

// Whether an edge of a face with these heights over another one pierces that one's inside, by more than round-off.
// Edges that end in a corner of the other only touch it.
bool edge_pierces(const Face& face, const Heights& above, const Face& other, double slack) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const double p = above[k];
        const double q = above[next];
        if (!((p > slack && q < -slack) || (p < -slack && q > slack))) continue;
        if (other.has(face.vertices[k]) || other.has(face.vertices[next])) continue;
        if (passes_inside(face.corners[k], face.corners[next], other.corners, p > 0.0 ? -slack : slack)) return true;
    }
    return false;
}

class Crossings {
public:
    // `asked`: flags of triangles; a pair counts where one of its two is flagged.
    Crossings(const Triangles& triangles, const Points& points, const std::vector<char>& asked)
        : triangles_(triangles), points_(points), asked_(asked), crossing_(asked.size()) {}

    Indices find() {
        BoxTree(triangles_, points_)
            .for_overlaps([&](int t, std::span<const int> others) { return test(t, others); },
                          [&](int t) { return is_known(t); });
        Indices result;
        for (int t = 0; t < static_cast<int>(crossing_.size()); ++t) {
            if (crossing_[t]) result.push_back(t);
        }
        return result;
    }

private:
    [[nodiscard]] Face face(int t) const {
        return {{triangles_(0, t), triangles_(1, t), triangles_(2, t)}, corners_of(triangles_, points_, t)};
    }

    // Whether any two cross.
    bool test(int t, std::span<const int> others) {
        const Face a = face(t);
        const Vector3 area = area_vector(a.corners[0], a.corners[1], a.corners[2]);
        bool found = false;
        for (const int other : others) {
            if (!asked_[t] && !asked_[other]) continue;
            if (is_known(t) && is_known(other)) continue;
            if (!cross(a, area, face(other))) continue;
            crossing_[t] = crossing_[other] = 1;
            found = true;
        }
        return found;
    }

    [[nodiscard]] bool is_known(int t) const { return crossing_[t].load(std::memory_order_relaxed) != 0; }

    static bool cross(const Face& a, const Vector3& area, const Face& b) {
        const Heights above_a = heights(b, a, area);
        if (lie_beside(above_a)) return false;
        const auto shared = std::count_if(b.vertices.begin(), b.vertices.end(), [&](int v) { return a.has(v); });
        if (shared > 1) return false;
        const Heights above_b = heights(a, b, area_vector(b.corners[0], b.corners[1], b.corners[2]));
        if (lie_beside(above_b)) return false;
        constexpr double round_off = 1e-12;  // of a volume
        const double size = std::max(box_around(a.corners).diagonal().norm(), box_around(b.corners).diagonal().norm());
        const double slack = round_off * size * size * size;
        return edge_pierces(a, above_b, b, slack) || edge_pierces(b, above_a, a, slack);
    }

    const Triangles& triangles_;
    const Points& points_;
    const std::vector<char>& asked_;
    std::vector<std::atomic<char>> crossing_;
};

// Whether a box meets one of a tree's. The functions' names are Eigen's.
struct Meeting {
    const Box& box;
    bool found = false;
    // NOLINTBEGIN(readability-identifier-naming)
    [[nodiscard]] bool intersectVolume(const Box& volume) const { return box.intersects(volume); }
    bool intersectObject(const Box& object) { return found = box.intersects(object); }  // true: no need to go on
    // NOLINTEND(readability-identifier-naming)
};

// The triangles whose boxes meet the box of one of the few, these included; ascending.
Indices around_few(const Triangles& triangles, const Points& points, const Indices& few) {
    std::vector<Box> boxes;
    boxes.reserve(few.size());
    Box all;
    for (const int t : few) all.extend(boxes.emplace_back(box_around(corners_of(triangles, points, t))));
    const Eigen::KdBVH<double, 3, Box> tree(boxes.begin(), boxes.end(), boxes.begin(), boxes.end());
    const auto count = static_cast<int>(triangles.cols());
    std::vector<char> meets(count, 0);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) {
            const Box box = box_around(corners_of(triangles, points, t));
            if (!box.intersects(all)) continue;
            Meeting meeting{box};
            Eigen::BVIntersect(tree, meeting);
            meets[t] = meeting.found ? 1 : 0;
        }
    });
    Indices found;
    for (int t = 0; t < count; ++t) {
        if (meets[t]) found.push_back(t);
    }
    return found;
}

}  // namespace

Indices crossing_triangles(const Triangles& triangles, const Points& points) {
    if (triangles.cols() == 0) return {};
    const std::vector<char> asked(static_cast<int>(triangles.cols()), 1);
    return Crossings(triangles, points, asked).find();
}

Indices crossings_with(const Triangles& triangles, const Points& points, const Indices& few) {
    if (few.empty()) return {};
    const Indices around = around_few(triangles, points, few);
    std::vector<char> is_few(static_cast<int>(triangles.cols()), 0);
    for (const int t : few) is_few[t] = 1;
    std::vector<char> asked;
    asked.reserve(around.size());
    for (const int t : around) asked.push_back(is_few[t]);
    const Triangles chosen = triangles(Eigen::all, around);
    Indices found = Crossings(chosen, points, asked).find();
    for (int& k : found) k = around[k];
    return found;
}

}  // namespace fairing
