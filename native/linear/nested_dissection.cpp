#include "linear/nested_dissection.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

#include "base/parallel.h"
#include "base/progress.h"

namespace fairing {

namespace {

constexpr std::ptrdiff_t leaf = 32;
constexpr int shared_depth = 4;

class Dissection {
public:
    Dissection(const SparseMatrix& lower, const Points& points)
        : points_(points),
          begin_(at(static_cast<int>(lower.cols())) + 1, 0),
          part_(at(static_cast<int>(lower.cols())), 0) {
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
        visit([&](int i, int) { ++begin_[at(i) + 1]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        neighbours_.resize(at(begin_.back()));
        Indices cursor(begin_.begin(), begin_.end() - 1);
        visit([&](int i, int j) { neighbours_[at(cursor[at(i)]++)] = j; });
        order_.resize(part_.size());
        std::iota(order_.begin(), order_.end(), 0);
    }

    // The first halves are cut one after the other, then each by itself.
    Indices run() {
        std::vector<Range> ranges{{order_.begin(), order_.end()}};
        for (int depth = 0; depth < shared_depth; ++depth) {
            std::vector<std::array<Range, 2>> halves(ranges.size());
            run_pieces(static_cast<int>(ranges.size()), [&](int k) { halves[at(k)] = cut(ranges[at(k)]); });
            ranges.clear();
            for (const auto& pair : halves) ranges.insert(ranges.end(), pair.begin(), pair.end());
        }
        run_pieces(static_cast<int>(ranges.size()), [&](int k) { dissect(ranges[at(k)]); });
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
        if (range.last - range.first <= leaf) return;
        for (const Range& half : cut(range)) dissect(half);
    }

    // The two halves; their separator stands behind them. Unknowns of different halves are not coupled, so that pieces
    // cut side by side look at no part_ but their own and those of separators, which stay as they are.
    std::array<Range, 2> cut(const Range& range) {
        const auto [first, last] = range;
        if (last - first <= leaf) return {Range{first, first}, Range{first, first}};
        const int axis = longest_axis(range);
        const auto middle = first + (last - first) / 2;
        std::nth_element(first, middle, last, [&](int a, int b) {
            const double x = points_(axis, a);
            const double y = points_(axis, b);
            return x != y ? x < y : a < b;
        });
        const int right = ++parts_;
        for (auto v = middle; v != last; ++v) part_[at(*v)] = right;
        const auto separator = std::stable_partition(first, middle, [&](int v) {
            return std::none_of(neighbours_.begin() + begin_[at(v)], neighbours_.begin() + begin_[at(v) + 1],
                                [&](int u) { return part_[at(u)] == right; });
        });
        const auto separator_size = middle - separator;
        std::rotate(separator, middle, last);
        return {Range{first, separator}, Range{separator, last - separator_size}};
    }

    const Points& points_;
    Indices begin_;
    Indices neighbours_;
    Indices part_;  // which right half an unknown was in last
    std::atomic<int> parts_ = 0;
    Indices order_;
};

}  // namespace

Indices nested_dissection(const SparseMatrix& lower, const Points& points) { return Dissection(lower, points).run(); }

}  // namespace fairing
