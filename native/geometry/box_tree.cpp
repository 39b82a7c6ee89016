#include "geometry/box_tree.h"

#include <atomic>
#include <bit>

#include <Eigen/Geometry>

#include "base/limits.h"
#include "base/parallel.h"

namespace fairing {

namespace {

// Halves along the longest edge of a box around the centres, down to leaves. A whole power of two comes first: the
// parts are those of nodes.
void sort_by_place(std::span<int> order, const Points& centres) {
    if (order.size() <= 4) return;
    Eigen::AlignedBox3d box;
    for (const int t : order) box.extend(Vector3(centres.col(t)));
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t half = std::bit_ceil(order.size()) / 2;
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                     [&](int a, int b) { return centres(axis, a) < centres(axis, b); });
    const std::array parts{order.first(half), order.subspan(half)};
    if (order.size() < one_by_one * one_by_one) {
        for (const auto part : parts) sort_by_place(part, centres);
    } else {
        run_pieces(2, [&](int k) { sort_by_place(parts[static_cast<std::size_t>(k)], centres); });
    }
}

Indices sorted_by_place(const Triangles& triangles, const Points& points) {
    const auto count = static_cast<int>(triangles.cols());
    Points centres(3, count);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) {
            const auto corners = triangles.col(t);
            const Vector3 sum = points.col(corners[0]) + points.col(corners[1]) + points.col(corners[2]);
            centres.col(t) = sum.allFinite() ? sum : Vector3::Zero();
        }
    });
    Indices order(count);
    std::iota(order.begin(), order.end(), 0);
    sort_by_place(order, centres);
    return order;
}

}  // namespace

// Marks nodes all of whose triangles are done.
class SettledNodes {
public:
    explicit SettledNodes(std::size_t leaves) {
        levels_.emplace_back(leaves);
        while (levels_.back().size() > 1) levels_.emplace_back((levels_.back().size() + 3) / 4);
    }

    [[nodiscard]] bool has(int level, int node) const {
        return levels_[level][node].load(std::memory_order_relaxed) != 0;
    }

    // Also marks the nodes above it that become complete by this.
    void add(int leaf) {
        levels_[0][leaf] = 1;
        std::size_t node = leaf;
        for (std::size_t level = 1; level < levels_.size(); ++level) {
            const std::vector<std::atomic<char>>& below = levels_[level - 1];
            node /= 4;
            const std::size_t end = std::min(4 * node + 4, below.size());
            for (std::size_t child = 4 * node; child < end; ++child) {
                if (below[child] == 0) return;
            }
            levels_[level][node] = 1;
        }
    }

private:
    std::vector<std::vector<std::atomic<char>>> levels_;
};

BoxTree::BoxTree(const Triangles& triangles, const Points& points) : order_(sorted_by_place(triangles, points)) {
    add_triangles(triangles, points);
    while (levels_.back().size() > 1) add_level();
}

void BoxTree::add_triangles(const Triangles& triangles, const Points& points) {
    const auto count = static_cast<int>(order_.size());
    std::vector<Boxes>& leaves = levels_.emplace_back((count + 3) / 4);
    for_ranges(static_cast<int>(leaves.size()), coarse_grain / 4, [&](int begin, int end) {
        for (int k = 4 * begin; k < 4 * end; ++k) {
            Vector3 least = Vector3::Constant(HUGE_VAL);
            Vector3 most = -least;
            if (k < count) {
                const auto corners = triangles.col(order_[k]);
                const Vector3 a = points.col(corners[0]);
                const Vector3 b = points.col(corners[1]);
                const Vector3 c = points.col(corners[2]);
                if ((a + b + c).allFinite()) {
                    least = a.cwiseMin(b).cwiseMin(c);
                    most = a.cwiseMax(b).cwiseMax(c);
                }
            }
            for (int axis = 0; axis < 3; ++axis) {
                leaves[k / 4].least[axis][k % 4] = least[axis];
                leaves[k / 4].most[axis][k % 4] = most[axis];
            }
        }
    });
}

void BoxTree::add_level() {
    const std::size_t count = levels_.back().size();
    std::vector<Boxes> level((count + 3) / 4);
    for (std::size_t k = 0; k < 4 * level.size(); ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto slot = static_cast<Eigen::Index>(k % 4);
            level[k / 4].least[axis][slot] = k < count ? levels_.back()[k].least[axis].minCoeff() : HUGE_VAL;
            level[k / 4].most[axis][slot] = k < count ? levels_.back()[k].most[axis].maxCoeff() : -HUGE_VAL;
        }
    }
    levels_.push_back(std::move(level));
}

// take(k, gaps) for each child of the first node that overlaps some of the second. A gap is the largest of all
// directions, negative where boxes overlap.
template <typename Take>
void BoxTree::compare(int level, const Pair& pair, const Take& take) const {
    const Boxes& first = levels_[level][pair.first];
    const Boxes& second = levels_[level][pair.second];
    for (int k = 0; k < 4; ++k) {
        Four gaps = Four::Constant(-HUGE_VAL);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            gaps = gaps.max(first.least[axis][k] - second.most[axis]).max(second.least[axis] - first.most[axis][k]);
        }
        if (gaps.minCoeff() < 0.0) take(k, gaps);
    }
}

// take(pair) for the pairs of children that overlap. A node's children with themselves come first: triangles that are
// done after these are skipped by the others.
template <typename Take>
void BoxTree::split(int level, const Pair& pair, const Take& take) const {
    const bool is_one = pair.first == pair.second;
    const auto child = [](int node, int k) { return 4 * node + k; };
    if (is_one) {
        compare(level, pair, [&](int k, const Four& gaps) {
            if (gaps[k] < 0.0) take(Pair{child(pair.first, k), child(pair.first, k)});
        });
    }
    compare(level, pair, [&](int k, const Four& gaps) {
        for (int l = is_one ? k + 1 : 0; l < 4; ++l) {
            if (gaps[l] < 0.0) take(Pair{child(pair.first, k), child(pair.second, l)});
        }
    });
}

void BoxTree::descend(int level, const Pair& pair, const Walk& walk) const {
    if (walk.nodes.has(level, pair.first) && walk.nodes.has(level, pair.second)) return;
    if (level == 0) {
        visit_triangles(pair, walk);
    } else {
        split(level, pair, [&](const Pair& part) { descend(level - 1, part, walk); });
    }
}

void BoxTree::visit_triangles(const Pair& pair, const Walk& walk) const {
    bool decides = false;
    compare(0, pair, [&](int k, const Four& gaps) {
        std::array<int, 4> others;
        std::size_t count = 0;
        for (int l = pair.first == pair.second ? k + 1 : 0; l < 4; ++l) {
            if (gaps[l] < 0.0) others[count++] = order_[4 * pair.second + l];
        }
        if (count > 0 && walk.visit(order_[4 * pair.first + k], std::span(others).first(count))) decides = true;
    });
    if (!decides) return;
    for (const int leaf : {pair.first, pair.second}) {
        if (is_settled(leaf, walk.is_settled)) walk.nodes.add(leaf);
    }
}

bool BoxTree::is_settled(int leaf, const IsSettled& is_settled) const {
    const auto begin = order_.begin() + std::ptrdiff_t{4} * leaf;
    return std::all_of(begin, begin + std::min<std::ptrdiff_t>(4, order_.end() - begin), is_settled);
}

// Pairs of large nodes are split serially; the pairs that they end in are worked on concurrently.
void BoxTree::for_overlaps(const Visit& visit, const IsSettled& is_settled) const {
    SettledNodes nodes(levels_.front().size());
    const Walk walk{visit, is_settled, nodes};
    int level = static_cast<int>(levels_.size()) - 1;
    std::vector<Pair> pairs{{0, 0}};
    for (; level > 0 && std::ssize(levels_[level]) < one_by_one; --level) {
        std::vector<Pair> parts;
        for (const Pair& pair : pairs) split(level, pair, [&](const Pair& part) { parts.push_back(part); });
        pairs = std::move(parts);
    }
    run_pieces(static_cast<int>(pairs.size()), [&](int k) { descend(level, pairs[k], walk); });
}

}  // namespace fairing
