#include "geometry/self_intersection.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <Eigen/Geometry>

namespace fairing {

namespace {

using Box = Eigen::AlignedBox3d;
using Corners = std::array<Vector3, 3>;

// Six times the signed volume of a tetrahedron.
double volume(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    return (b - a).cross(c - a).dot(d - a);
}

// The segment pq passes through the inside of the triangle, by more than round-off.
bool pierces(const Vector3& p, const Vector3& q, const Corners& t) {
    constexpr double round_off = 1e-12;
    const double size = std::max({(t[1] - t[0]).norm(), (t[2] - t[0]).norm(), (q - p).norm()});
    const double slack = round_off * size * size * size;
    const double above = volume(t[0], t[1], t[2], p);
    const double below = volume(t[0], t[1], t[2], q);
    if (!((above > slack && below < -slack) || (above < -slack && below > slack))) return false;
    const double sign = above > 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < 3; ++k) {
        if (!(sign * volume(p, q, t[at(k)], t[at((k + 1) % 3)]) > slack)) return false;
    }
    return true;
}

class Crossings {
public:
    Crossings(const Triangles& triangles, const Points& points)
        : triangles_(triangles), points_(points), crossing_(at(static_cast<int>(triangles.cols())), 0) {
        order_.resize(crossing_.size());
        std::iota(order_.begin(), order_.end(), 0);
        if (!order_.empty()) build(0, static_cast<int>(order_.size()));
    }

    Indices find() {
        if (!nodes_.empty()) test_inside(0);
        Indices result;
        for (int t = 0; t < static_cast<int>(crossing_.size()); ++t) {
            if (crossing_[at(t)]) result.push_back(t);
        }
        return result;
    }

private:
    // A leaf has no children and holds order_[begin … end).
    struct Node {
        Box box;
        int begin;
        int end;
        int left = none;
        int right = none;
    };

    [[nodiscard]] Corners corners(int t) const {
        return {points_.col(triangles_(0, t)), points_.col(triangles_(1, t)), points_.col(triangles_(2, t))};
    }

    [[nodiscard]] Vector3 centre(int t) const {
        const Corners c = corners(t);
        return c[0] + c[1] + c[2];
    }

    int build(int begin, int end) {
        constexpr int leaf_size = 4;
        const int index = static_cast<int>(nodes_.size());
        nodes_.push_back({Box(), begin, end});
        Box box;
        Box centres;
        for (int k = begin; k < end; ++k) {
            for (const Vector3& corner : corners(order_[at(k)])) box.extend(corner);
            centres.extend(centre(order_[at(k)]));
        }
        nodes_[at(index)].box = box;
        if (end - begin <= leaf_size) return index;
        Eigen::Index axis = 0;
        centres.sizes().maxCoeff(&axis);
        const int middle = (begin + end) / 2;
        std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
            const double x = centre(a)[axis];
            const double y = centre(b)[axis];
            return x != y ? x < y : a < b;
        });
        const int left = build(begin, middle);
        const int right = build(middle, end);
        nodes_[at(index)].left = left;
        nodes_[at(index)].right = right;
        return index;
    }

    void test_inside(int index) {
        const Node node = nodes_[at(index)];
        if (node.left != none) {
            test_inside(node.left);
            test_inside(node.right);
            test_between(node.left, node.right);
            return;
        }
        for (int a = node.begin; a < node.end; ++a) {
            for (int b = a + 1; b < node.end; ++b) test_pair(order_[at(a)], order_[at(b)]);
        }
    }

    void test_between(int first, int second) {
        const Node a = nodes_[at(first)];
        const Node b = nodes_[at(second)];
        if (!a.box.intersects(b.box)) return;
        if (a.left != none && (b.left == none || a.end - a.begin >= b.end - b.begin)) {
            test_between(a.left, second);
            test_between(a.right, second);
        } else if (b.left != none) {
            test_between(first, b.left);
            test_between(first, b.right);
        } else {
            for (int k = a.begin; k < a.end; ++k) {
                for (int l = b.begin; l < b.end; ++l) test_pair(order_[at(k)], order_[at(l)]);
            }
        }
    }

    void test_pair(int a, int b) {
        int shared = 0;
        for (int v : triangles_.col(a)) {
            for (int w : triangles_.col(b)) shared += v == w;
        }
        if (shared > 1 || (crossing_[at(a)] && crossing_[at(b)])) return;
        if (edge_pierces(a, b) || edge_pierces(b, a)) crossing_[at(a)] = crossing_[at(b)] = 1;
    }

    // Edges that end in a corner of the other triangle only touch it.
    [[nodiscard]] bool edge_pierces(int a, int b) const {
        const Corners target = corners(b);
        const auto is_corner_of_b = [&](int v) { return (triangles_.col(b).array() == v).any(); };
        for (int k = 0; k < 3; ++k) {
            const int p = triangles_(k, a);
            const int q = triangles_((k + 1) % 3, a);
            if (is_corner_of_b(p) || is_corner_of_b(q)) continue;
            if (pierces(points_.col(p), points_.col(q), target)) return true;
        }
        return false;
    }

    const Triangles& triangles_;
    const Points& points_;
    std::vector<char> crossing_;
    Indices order_;
    std::vector<Node> nodes_;
};

}  // namespace

Indices crossing_triangles(const Triangles& triangles, const Points& points) {
    return Crossings(triangles, points).find();
}

}  // namespace fairing
