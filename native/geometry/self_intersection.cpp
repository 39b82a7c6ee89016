#include "geometry/self_intersection.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include "base/parallel.h"

namespace fairing {

namespace {

using Box = Eigen::AlignedBox3d;
using Corners = std::array<Vector3, 3>;

constexpr int leaf_size = 4;
constexpr int most_pieces = 64;  // of a level of the tree, to work on side by side

// Twice the area of a triangle along its normal.
Vector3 area_vector(const Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

// Six times the signed volume of a tetrahedron.
double volume(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    return area_vector({a, b, c}).dot(d - a);
}

Corners corners_of(const Triangles& triangles, const Points& points, int t) {
    return {points.col(triangles(0, t)), points.col(triangles(1, t)), points.col(triangles(2, t))};
}

Box box_around(const Corners& corners) {
    Box box;
    for (const Vector3& corner : corners) box.extend(corner);
    return box;
}

// The triangles of a range of the order, split at the median.
struct Node {
    Box box;
    int begin = 0;
    int end = 0;
    [[nodiscard]] int size() const { return end - begin; }
    [[nodiscard]] bool is_leaf() const { return size() <= leaf_size; }
};

class Crossings {
public:
    // `asked`: for each triangle whether its pairs count; a pair of two that are not asked for doesn't.
    Crossings(const Triangles& triangles, const Points& points, const std::vector<char>& asked)
        : triangles_(triangles), points_(points), asked_(asked), crossing_(asked.size()) {
        const int count = static_cast<int>(triangles.cols());
        order_.resize(at(count));
        std::iota(order_.begin(), order_.end(), 0);
        measure_triangles();
        int last_level = 1;  // nodes there: enough for all of them to be leaves
        while (last_level * leaf_size < count) last_level *= 2;
        nodes_.resize(2 * at(last_level));
        nodes_[1] = {Box(), 0, count};
        for (int level = 1; level <= last_level; level *= 2) sort_level(level);
    }

    Indices find() {
        test_pairs();
        Indices result;
        for (int t = 0; t < static_cast<int>(crossing_.size()); ++t) {
            if (crossing_[at(t)]) result.push_back(t);
        }
        return result;
    }

private:
    // Two nodes that may touch, or one twice.
    struct Pair {
        int first;
        int second;
    };

    void measure_triangles() {
        const auto count = static_cast<int>(triangles_.cols());
        boxes_.resize(at(count));
        sizes_.resize(at(count));
        areas_.resize(3, count);
        for_ranges(count, coarse_grain, [&](int begin, int end) {
            for (int t = begin; t < end; ++t) {
                boxes_[at(t)] = box_around(corners(t));
                sizes_[at(t)] = boxes_[at(t)].diagonal().norm();
                areas_.col(t) = area_vector(corners(t));
            }
        });
    }

    [[nodiscard]] Corners corners(int t) const { return corners_of(triangles_, points_, t); }

    // Children of node k are 2 k and 2 k + 1: a level begins at a power of two and has as many nodes.
    void sort_level(int first) {
        for_ranges(first, std::max(1, first / most_pieces), [&](int begin, int end) {
            for (int k = first + begin; k < first + end; ++k) sort_node(k);
        });
    }

    void sort_node(int index) {
        Node& node = nodes_[at(index)];
        Box centres;
        for (int k = node.begin; k < node.end; ++k) {
            const Box& box = boxes_[at(order_[at(k)])];
            node.box.extend(box);
            centres.extend(Vector3(box.min() + box.max()));
        }
        if (node.is_leaf()) return;
        Eigen::Index axis = 0;
        centres.sizes().maxCoeff(&axis);
        const int middle = (node.begin + node.end) / 2;
        // Keys side by side: large nodes would wait for the memory otherwise.
        std::vector<std::pair<double, int>> keys;
        keys.reserve(at(node.size()));
        for (int k = node.begin; k < node.end; ++k) {
            const Box& box = boxes_[at(order_[at(k)])];
            keys.emplace_back(box.min()[axis] + box.max()[axis], order_[at(k)]);
        }
        std::nth_element(keys.begin(), keys.begin() + (middle - node.begin), keys.end());
        std::transform(keys.begin(), keys.end(), order_.begin() + node.begin,
                       [](const auto& key) { return key.second; });
        nodes_[at(2 * index)] = {Box(), node.begin, middle};
        nodes_[at(2 * index + 1)] = {Box(), middle, node.end};
    }

    // Pairs of large nodes are split one after the other, what they come down to side by side.
    void test_pairs() {
        const int small = std::max(leaf_size, static_cast<int>(order_.size()) / most_pieces);
        std::vector<Pair> open{{1, 1}};
        std::vector<Pair> pieces;
        while (!open.empty()) {
            const Pair pair = open.back();
            open.pop_back();
            if (std::max(nodes_[at(pair.first)].size(), nodes_[at(pair.second)].size()) <= small) {
                pieces.push_back(pair);
            } else {
                split(pair, [&](const Pair& part) { open.push_back(part); });
            }
        }
        run_pieces(static_cast<int>(pieces.size()), [&](int k) { test(pieces[at(k)]); });
    }

    // visit(pair) for the parts of a pair of which not both are leaves, as far as they touch.
    template <typename Visit>
    void split(const Pair& pair, const Visit& visit) const {
        const auto [a, b] = pair;
        if (a == b) {
            for (const Pair& part : {Pair{2 * a, 2 * a}, Pair{2 * a + 1, 2 * a + 1}, Pair{2 * a, 2 * a + 1}}) {
                if (touch(part)) visit(part);
            }
            return;
        }
        const bool splits_first = nodes_[at(a)].size() >= nodes_[at(b)].size();
        for (int child : {0, 1}) {
            const Pair part = splits_first ? Pair{2 * a + child, b} : Pair{a, 2 * b + child};
            if (touch(part)) visit(part);
        }
    }

    [[nodiscard]] bool touch(const Pair& pair) const {
        return nodes_[at(pair.first)].box.intersects(nodes_[at(pair.second)].box);
    }

    void test(const Pair& pair) {
        const Node& a = nodes_[at(pair.first)];
        const Node& b = nodes_[at(pair.second)];
        if (!a.is_leaf() || !b.is_leaf()) {
            split(pair, [&](const Pair& part) { test(part); });
            return;
        }
        for (int k = a.begin; k < a.end; ++k) {
            const int other = pair.first == pair.second ? k + 1 : b.begin;
            for (int l = other; l < b.end; ++l) test_triangles(order_[at(k)], order_[at(l)]);
        }
    }

    void test_triangles(int a, int b) {
        if (!asked_[at(a)] && !asked_[at(b)]) return;
        if (!boxes_[at(a)].intersects(boxes_[at(b)]) || lies_beside(a, b) || lies_beside(b, a)) return;
        int shared = 0;
        for (int v : triangles_.col(a)) {
            for (int w : triangles_.col(b)) shared += v == w;
        }
        if (shared > 1 || (crossing_[at(a)] && crossing_[at(b)])) return;
        if (edge_pierces(a, b) || edge_pierces(b, a)) crossing_[at(a)] = crossing_[at(b)] = 1;
    }

    // Of the corners of triangle a over b's plane, times twice b's area.
    [[nodiscard]] std::array<double, 3> heights(int a, int b) const {
        const Vector3 normal = areas_.col(b);
        const Vector3 origin = points_.col(triangles_(0, b));
        std::array<double, 3> above;
        for (int k = 0; k < 3; ++k) above[at(k)] = normal.dot(points_.col(triangles_(k, a)) - origin);
        return above;
    }

    // All of triangle a lies on one side of b's plane: neither passes through the other. Most neighbours end here.
    [[nodiscard]] bool lies_beside(int a, int b) const {
        const auto [p, q, r] = heights(a, b);
        return std::min({p, q, r}) >= 0.0 || std::max({p, q, r}) <= 0.0;
    }

    // An edge of triangle a passes through the inside of triangle b, by more than round-off. Edges that end in a corner
    // of b only touch it.
    [[nodiscard]] bool edge_pierces(int a, int b) const {
        constexpr double round_off = 1e-12;
        const Corners from = corners(a);
        const Corners to = corners(b);
        const double size = std::max(sizes_[at(a)], sizes_[at(b)]);
        const double slack = round_off * size * size * size;
        const std::array<double, 3> above = heights(a, b);
        const auto is_corner_of_b = [&](int v) { return (triangles_.col(b).array() == v).any(); };
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            const double p = above[at(k)];
            const double q = above[at(next)];
            if (!((p > slack && q < -slack) || (p < -slack && q > slack))) continue;
            if (is_corner_of_b(triangles_(k, a)) || is_corner_of_b(triangles_(next, a))) continue;
            if (passes_inside(from[at(k)], from[at(next)], to, p > 0.0 ? -slack : slack)) return true;
        }
        return false;
    }

    // The line pq passes all edges of the triangle on the side of its inside: where all volumes have the sign of
    // `slack`, and more than its size.
    [[nodiscard]] static bool passes_inside(const Vector3& p, const Vector3& q, const Corners& t, double slack) {
        const double sign = slack > 0.0 ? 1.0 : -1.0;
        for (int k = 0; k < 3; ++k) {
            if (!(sign * volume(p, q, t[at(k)], t[at((k + 1) % 3)]) > std::abs(slack))) return false;
        }
        return true;
    }

    const Triangles& triangles_;
    const Points& points_;
    const std::vector<char>& asked_;
    std::vector<std::atomic<char>> crossing_;
    std::vector<Box> boxes_;     // of triangles
    std::vector<double> sizes_;  // of these
    Points areas_;               // area vectors of triangles
    Indices order_;
    std::vector<Node> nodes_;
};

// Whether a box meets one of a tree's. Eigen names the functions.
struct Meeting {
    const Box& box;
    bool found = false;
    // NOLINTBEGIN(readability-identifier-naming)
    [[nodiscard]] bool intersectVolume(const Box& volume) const { return box.intersects(volume); }
    bool intersectObject(const Box& object) { return found = box.intersects(object); }  // true: no need to go on
    // NOLINTEND(readability-identifier-naming)
};

// Of all triangles those whose boxes meet the box of one of the few, these among them; ascending.
Indices around_few(const Triangles& triangles, const Points& points, const Indices& few) {
    std::vector<Box> boxes;
    boxes.reserve(few.size());
    Box all;
    for (const int t : few) all.extend(boxes.emplace_back(box_around(corners_of(triangles, points, t))));
    const Eigen::KdBVH<double, 3, Box> tree(boxes.begin(), boxes.end(), boxes.begin(), boxes.end());
    const auto count = static_cast<int>(triangles.cols());
    std::vector<char> meets(at(count), 0);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) {
            const Box box = box_around(corners_of(triangles, points, t));
            if (!box.intersects(all)) continue;
            Meeting meeting{box};
            Eigen::BVIntersect(tree, meeting);
            meets[at(t)] = meeting.found ? 1 : 0;
        }
    });
    Indices found;
    for (int t = 0; t < count; ++t) {
        if (meets[at(t)]) found.push_back(t);
    }
    return found;
}

}  // namespace

Indices crossing_triangles(const Triangles& triangles, const Points& points) {
    if (triangles.cols() == 0) return {};
    const std::vector<char> asked(at(static_cast<int>(triangles.cols())), 1);
    return Crossings(triangles, points, asked).find();
}

Indices crossings_with(const Triangles& triangles, const Points& points, const Indices& few) {
    if (few.empty()) return {};
    const Indices around = around_few(triangles, points, few);
    std::vector<char> is_few(at(static_cast<int>(triangles.cols())), 0);
    for (const int t : few) is_few[at(t)] = 1;
    std::vector<char> asked;
    asked.reserve(around.size());
    for (const int t : around) asked.push_back(is_few[at(t)]);
    const Triangles chosen = triangles(Eigen::all, around);
    Indices found = Crossings(chosen, points, asked).find();
    for (int& k : found) k = around[at(k)];
    return found;
}

}  // namespace fairing
