#include "multigrid/restriction.h"

#include "base/parallel.h"
#include "base/progress.h"

namespace fairing {

namespace {

// The row of each fine vertex; `none` at fixed ones.
Indices rows_of(const Transfer& transfer) {
    const Removals& removals = transfer.removals;
    Indices row(transfer.fine_count, none);
    for (int k = 0; k < removals.size(); ++k) row[removals.vertex[k]] = k;
    for (int c = 0; c < transfer.coarse_free_count; ++c) row[transfer.coarse_in_fine[c]] = removals.size() + c;
    return row;
}

}  // namespace

Restriction::Restriction(const Transfer& transfer) : transfer_(transfer) {
    const Removals& removals = transfer.removals;
    const Indices row = rows_of(transfer);
    begin_.assign((removals.size() + transfer.coarse_free_count) + 1, 0);
    for (const int v : removals.neighbours) {
        if (row[v] != none) ++begin_[row[v] + 1];
    }
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
    from_.resize(begin_.back());
    weights_.resize(from_.size());
    Indices cursor(begin_.begin(), begin_.end() - 1);
    for (int k = 0; k < removals.size(); ++k) {
        checkpoint(k);
        for (int j = removals.begin[k]; j < removals.begin[k + 1]; ++j) {
            const int target = row[removals.neighbours[j]];
            if (target == none) continue;
            const std::size_t place = cursor[target]++;
            from_[place] = k;
            weights_[place] = removals.weights[j];
        }
    }
}

Eigen::Vector4f Restriction::arrived(int row, const Eigen::Vector4f& own, const SingleField& sums) const {
    Eigen::Vector4f sum = own;
    for (int j = begin_[row]; j < begin_[row + 1]; ++j) sum += weights_[j] * sums.col(from_[j]);
    return sum;
}

// What a removed vertex hands on is whole once the passes before its own are done.
void Restriction::apply(const SingleField& fine, float scale, SingleField& sums, SingleField& coarse) const {
    const Removals& removals = transfer_.removals;
    for (std::size_t pass = 1; pass < removals.pass_begin.size(); ++pass) {
        const int first = removals.pass_begin[pass - 1];
        for_ranges(removals.pass_begin[pass] - first, coarse_grain, [&](int begin, int end) {
            for (int k = first + begin; k < first + end; ++k)
                sums.col(k) = arrived(k, fine.col(removals.vertex[k]), sums);
        });
    }
    const int count = transfer_.coarse_free_count;
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int c = begin; c < end; ++c) {
            const Eigen::Vector4f own = fine.col(transfer_.coarse_in_fine[c]);
            coarse.col(c) = scale * arrived(removals.size() + c, own, sums);
        }
    });
    coarse.rightCols(coarse.cols() - count).setZero();
}

}  // namespace fairing
