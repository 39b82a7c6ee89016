#include "linear/nested_dissection.h"

#include <atomic>

#include "base/limits.h"
#include "base/parallel.h"
#include "base/progress.h"

namespace fairing {

namespace {

constexpr int shared_depth = 4;  // bisections whose 2⁴ parts threads share

class Dissection {
public:
    Dissection(const SparseMatrix& lower, const Points& points)
        : points_(points),
          begin_((static_cast<int>(lower.cols())) + 1, 0),
          part_(static_cast<int>(lower.cols()), 0),
          mate_(part_.size(), none),
          seen_(part_.size(), 0) {
        const auto visit = [&](auto action) {
            for (int j = 0; j < lower.cols(); ++j) {
                checkpoint(j);
                for (SparseMatrix::InnerIterator entry(lower, j); entry; ++entry) {
                    const int i = static_cast<int>(entry.row());
                    if (i == j) continue;
                    action(i, j);
                    action(j, i);
                }
            }
        };
        visit([&](int i, int) { ++begin_[i + 1]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        neighbours_.resize(begin_.back());
        Indices cursor(begin_.begin(), begin_.end() - 1);
        visit([&](int i, int j) { neighbours_[cursor[i]++] = j; });
        order_.resize(part_.size());
        std::iota(order_.begin(), order_.end(), 0);
    }

    // The first halves are cut one after the other, then each by itself.
    Indices run() {
        std::vector<Range> ranges{{order_.begin(), order_.end()}};
        for (int depth = 0; depth < shared_depth; ++depth) {
            std::vector<std::array<Range, 2>> halves(ranges.size());
            run_pieces(static_cast<int>(ranges.size()), [&](int k) { halves[k] = cut(ranges[k]); });
            ranges.clear();
            for (const auto& pair : halves) ranges.insert(ranges.end(), pair.begin(), pair.end());
        }
        run_pieces(static_cast<int>(ranges.size()), [&](int k) { dissect(ranges[k]); });
        return std::move(order_);
    }

private:
    struct Range {
        Indices::iterator first;
        Indices::iterator last;
    };

    [[nodiscard]] int longest_axis(const Range& range) const {
        Vector3 low = points_.col(*range.first);
        Vector3 high = low;
        for (auto v = range.first; v != range.last; ++v) {
            low = low.cwiseMin(points_.col(*v));
            high = high.cwiseMax(points_.col(*v));
        }
        int axis = 0;
        (high - low).maxCoeff(&axis);
        return axis;
    }

    void dissect(const Range& range) {
        if (range.last - range.first <= one_by_one) return;
        for (const Range& half : cut(range)) dissect(half);
    }

    // The two halves; their separator stands behind them. Unknowns of different halves are not coupled, so that pieces
    // cut side by side look at no part_ but their own and those of separators, which stay as they are.
    std::array<Range, 2> cut(const Range& range) {
        const auto [first, last] = range;
        if (last - first <= one_by_one) return {Range{first, first}, Range{first, first}};
        const int axis = longest_axis(range);
        const auto middle = first + (last - first) / 2;
        std::nth_element(first, middle, last, [&](int a, int b) {
            const double x = points_(axis, a);
            const double y = points_(axis, b);
            return x != y ? x < y : a < b;
        });
        const int left = ++parts_;
        const int right = ++parts_;
        for (auto v = first; v != last; ++v) part_[*v] = v < middle ? left : right;
        const int separator = ++parts_;
        for (const int v : least_cover({first, middle}, right)) part_[v] = separator;
        const auto end = std::stable_partition(first, last, [&](int v) { return part_[v] != separator; });
        const auto between = std::stable_partition(first, end, [&](int v) { return part_[v] == left; });
        return {Range{first, between}, Range{between, end}};
    }

    [[nodiscard]] std::span<const int> neighbours(int v) const {
        return std::span(neighbours_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
    }

    // The fewest unknowns of both halves that all couplings between them have an end in: by a largest matching
    // (Kőnig 1931).
    [[nodiscard]] Indices least_cover(const Range& half, int right) {
        Indices beside;  // on this side
        Indices beyond;
        for (auto v = half.first; v != half.last; ++v) {
            bool coupled = false;
            for (const int u : neighbours(*v)) {
                if (part_[u] != right) continue;
                coupled = true;
                beyond.push_back(u);
                mate_[u] = none;
            }
            if (!coupled) continue;
            beside.push_back(*v);
            mate_[*v] = none;
        }
        for (const int v : beside) find_mate(v, right, ++parts_);
        const int reached = ++parts_;
        for (const int v : beside) {
            if (mate_[v] == none) reach(v, right, reached);
        }
        Indices cover;
        for (const int v : beside) {
            if (seen_[v] != reached) cover.push_back(v);
        }
        for (const int u : beyond) {
            if (seen_[u] == reached) cover.push_back(u);
        }
        return cover;
    }

    // An alternating path from v to one beyond without a mate; all on it change mates.
    bool find_mate(int v, int right, int search) {
        for (const int u : neighbours(v)) {
            if (part_[u] != right || seen_[u] == search) continue;
            seen_[u] = search;
            if (mate_[u] != none && !find_mate(mate_[u], right, search)) continue;
            mate_[u] = v;
            mate_[v] = u;
            return true;
        }
        return false;
    }

    // All that alternating paths lead to from v.
    void reach(int v, int right, int reached) {
        Indices stack{v};
        seen_[v] = reached;
        while (!stack.empty()) {
            const int from = stack.back();
            stack.pop_back();
            for (const int u : neighbours(from)) {
                if (part_[u] != right || seen_[u] == reached) continue;
                seen_[u] = reached;
                const int next = mate_[u];
                if (next == none || seen_[next] == reached) continue;
                seen_[next] = reached;
                stack.push_back(next);
            }
        }
    }

    const Points& points_;
    Indices begin_;
    Indices neighbours_;
    Indices part_;  // which half or separator an unknown was in last
    Indices mate_;  // across the cut
    Indices seen_;  // by which search last
    std::atomic<int> parts_ = 0;
    Indices order_;
};

}  // namespace

Indices nested_dissection(const SparseMatrix& lower, const Points& points) { return Dissection(lower, points).run(); }

}  // namespace fairing
