#include "linear/nested_dissection.h"

#include <algorithm>
#include <numeric>

namespace fairing {

namespace {

constexpr std::ptrdiff_t leaf = 32;

class Dissection {
public:
    Dissection(const SparseMatrix& lower, const Points& points)
        : points_(points),
          begin_(at(static_cast<int>(lower.cols())) + 1, 0),
          part_(at(static_cast<int>(lower.cols())), 0) {
        const auto visit = [&](auto action) {
            for (int j = 0; j < lower.cols(); ++j) {
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

    Indices run() {
        dissect(order_.begin(), order_.end());
        return std::move(order_);
    }

private:
    using Iterator = Indices::iterator;

    [[nodiscard]] int longest_axis(Iterator first, Iterator last) const {
        Vector3 low = points_.col(*first);
        Vector3 high = low;
        for (auto v = first; v != last; ++v) {
            low = low.cwiseMin(points_.col(*v));
            high = high.cwiseMax(points_.col(*v));
        }
        int axis = 0;
        (high - low).maxCoeff(&axis);
        return axis;
    }

    void dissect(Iterator first, Iterator last) {
        if (last - first <= leaf) return;
        const int axis = longest_axis(first, last);
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
        dissect(first, separator);
        dissect(separator, last - separator_size);
    }

    const Points& points_;
    Indices begin_;
    Indices neighbours_;
    Indices part_;  // which right half an unknown was in last
    int parts_ = 0;
    Indices order_;
};

}  // namespace

Indices nested_dissection(const SparseMatrix& lower, const Points& points) { return Dissection(lower, points).run(); }

}  // namespace fairing
