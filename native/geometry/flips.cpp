#include "geometry/flips.h"

#include <map>
#include <set>

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "geometry/one_ring.h"
#include "geometry/vertex_normal.h"
#include "mesh/loops.h"

namespace fairing {

namespace {

// A triangle so flat that FaceGeometry gives it no normal doesn't count as turned over.
bool has_normal(const Vector3& cross, const Vector3& first, const Vector3& second) {
    const double longest = std::max({first.squaredNorm(), second.squaredNorm(), (second - first).squaredNorm()});
    return cross.norm() > least_twice_area * longest;
}

bool is_turned(const Points& points, const Points& normals, const Eigen::Vector3i& corners) {
    const Vector3 around = normals.col(corners[0]) + normals.col(corners[1]) + normals.col(corners[2]);
    const Vector3 first = points.col(corners[1]) - points.col(corners[0]);
    const Vector3 second = points.col(corners[2]) - points.col(corners[0]);
    const Vector3 cross = first.cross(second);
    return around.dot(cross) < 0.0 && has_normal(cross, first, second);
}

// Share of the longest side: in single precision, the normals of lower triangles are round-off.
constexpr double flattest = 1e-5;

// The longest side of a cap, or `none`.
int side_of_cap(const Points& points, const Triangles& triangles, int t, double least) {
    const std::array<Vector3, 3> at{points.col(triangles(0, t)), points.col(triangles(1, t)),
                                    points.col(triangles(2, t))};
    const std::array<double, 3> lengths{(at[1] - at[0]).norm(), (at[2] - at[1]).norm(), (at[0] - at[2]).norm()};
    const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
    const double height = std::max(least, flattest * *longest);
    if (!(*shortest > height)) return none;
    const double twice_area = area_vector(at[0], at[1], at[2]).norm();
    return twice_area < height * *longest ? static_cast<int>(longest - lengths.begin()) : none;
}

class Turning {
public:
    Turning(const std::vector<char>& may_take, Triangles& triangles) : may_take_(may_take), triangles_(triangles) {
        for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) insert(t);
    }

    // False where no flip is possible; `made` is the flip.
    bool turn(int cap, int side, TurnedCap& made) {
        const int a = corner(cap, side);
        const int b = corner(cap, side + 1);
        const int over = corner(cap, side + 2);
        const auto found = sides_.find({b, a});
        if (found == sides_.end() || may_take_[found->second] == 0) return false;
        const int beside = found->second;
        int place = 0;
        while (corner(beside, place) != b) ++place;
        const int opposite = corner(beside, place + 2);
        if (over == opposite || sides_.contains({over, opposite}) || sides_.contains({opposite, over})) return false;
        remove(cap);
        remove(beside);
        triangles_.col(cap) << over, opposite, b;
        triangles_.col(beside) << over, a, opposite;
        insert(cap);
        insert(beside);
        made = {cap, beside, {a, b}, over};
        return true;
    }

private:
    [[nodiscard]] int corner(int t, int k) const { return triangles_(k % 3, t); }

    void insert(int t) {
        for (int k = 0; k < 3; ++k) sides_[{corner(t, k), corner(t, k + 1)}] = t;
    }

    void remove(int t) {
        for (int k = 0; k < 3; ++k) sides_.erase({corner(t, k), corner(t, k + 1)});
    }

    const std::vector<char>& may_take_;
    Triangles& triangles_;
    std::map<std::array<int, 2>, int> sides_;
};

}  // namespace

Indices flipped_triangles(const Patch& patch, const Points& points) {
    const Points no_normals = Points::Zero(3, patch.vertex_count() - patch.free_count);
    const Points normals = max_normals(patch, points, no_normals);
    std::vector<char> turned(patch.triangle_count());
    for_ranges(patch.triangle_count(), coarse_grain, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) turned[t] = is_turned(points, normals, patch.triangles.col(t));
    });
    Indices flipped;
    for (int t = 0; t < patch.triangle_count(); ++t) {
        if (turned[t]) flipped.push_back(t);
    }
    return flipped;
}

Indices flipped_by_solution(const Patch& patch, const Points& points) {
    return with_free_corner(patch, flipped_triangles(patch, points));
}

Indices folded_triangles(const Patch& patch, const Points& points) {
    std::set<int> folded;
    for (int e = 0; e < patch.edge_count(); ++e) {
        const auto [a, b] = patch.edge_ends[e];
        const auto [first, second] = patch.edge_triangles[e];
        if (second == none || !patch.is_free(a) || !patch.is_free(b)) continue;
        const Vector3 n = area_vector(points, patch.triangles.col(first));
        const Vector3 m = area_vector(points, patch.triangles.col(second));
        if (n.dot(m) < cos_of_widest_turn * n.norm() * m.norm()) folded.insert({first, second});
    }
    return {folded.begin(), folded.end()};
}

bool is_flipped(const Patch& patch, const Points& points, int triangle) {
    const auto corners = patch.triangles.col(triangle);
    Vector3 around = Vector3::Zero();
    OneRingBuffer buffer;
    for (const int v : corners) {
        if (patch.is_free(v) || patch.pin[v]) around += max_normal(buffer.gather(patch, points, v));
    }
    const Vector3 first = points.col(corners[1]) - points.col(corners[0]);
    const Vector3 second = points.col(corners[2]) - points.col(corners[0]);
    return around.dot(first.cross(second)) < 0.0;
}

std::vector<TurnedCap> turn_caps(const Points& points, const std::vector<char>& may_turn,
                                 const std::vector<char>& may_take, double least, Triangles& triangles) {
    std::vector<TurnedCap> turned;
    Indices waiting;
    for (int t = static_cast<int>(triangles.cols()) - 1; t >= 0; --t) {
        if (may_turn[t] != 0 && side_of_cap(points, triangles, t, least) != none) waiting.push_back(t);
    }
    if (waiting.empty()) return turned;
    Turning turning(may_take, triangles);
    // A flip may turn the adjacent triangle into a cap, with one vertex less over its side.
    for (auto left = 4 * waiting.size() + static_cast<std::size_t>(triangles.cols()); !waiting.empty() && left > 0;
         --left) {
        const int t = waiting.back();
        waiting.pop_back();
        const int side = side_of_cap(points, triangles, t, least);
        TurnedCap made{};
        if (side == none || !turning.turn(t, side, made)) continue;
        turned.push_back(made);
        for (const int other : {made.cap, made.beside}) {
            if (may_turn[other] != 0) waiting.push_back(other);
        }
    }
    return turned;
}

}  // namespace fairing
