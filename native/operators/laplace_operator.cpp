#include "operators/laplace_operator.h"

#include <algorithm>

#include "base/parallel.h"

namespace fairing {

namespace {

struct Entry {
    int row;
    double value;
};

// Column j of the lower triangle, by rows.
void list_column(const Patch& patch, const Stiffness& stiffness, int j, std::vector<Entry>& column) {
    const RingView ring = patch.ring(j);
    column.assign(1, {j, stiffness.diagonal(patch, j)});
    for (std::size_t k = 0; k < ring.valence(); ++k) {
        if (ring.vertices[k] > j && patch.is_free(ring.vertices[k]))
            column.push_back({ring.vertices[k], -stiffness.weights[ring.spokes[k]]});
    }
    std::sort(column.begin(), column.end(), [](const Entry& a, const Entry& b) { return a.row < b.row; });
}

int column_size(const Patch& patch, int j) {
    const auto below = [&](int i) { return i > j && patch.is_free(i); };
    return 1 + static_cast<int>(std::ranges::count_if(patch.ring(j).vertices, below));
}

}  // namespace

LaplaceOperator::LaplaceOperator(const Patch& patch, Points layout, Kept kept)
    : patch_(patch), factor_(std::move(layout), kept) {}

SparseMatrix LaplaceOperator::lower(const Stiffness& stiffness) const {
    SparseMatrix matrix(patch_.free_count, patch_.free_count);
    int* const begin = matrix.outerIndexPtr();
    for (int j = 0; j < patch_.free_count; ++j) begin[j + 1] = begin[j] + column_size(patch_, j);
    matrix.resizeNonZeros(begin[patch_.free_count]);
    for_ranges(patch_.free_count, coarse_grain, [&](int first, int last) {
        std::vector<Entry> column;
        for (int j = first; j < last; ++j) {
            list_column(patch_, stiffness, j, column);
            int k = begin[j];
            for (const Entry& entry : column) {
                matrix.innerIndexPtr()[k] = entry.row;
                matrix.valuePtr()[k++] = entry.value;
            }
        }
    });
    return matrix;
}

void LaplaceOperator::prepare() { factor_.analyse_pattern(lower({VectorX::Zero(patch_.edge_count()), {}})); }

bool LaplaceOperator::update(const Stiffness& stiffness, const Progress& progress) {
    return factor_.factorise(lower(stiffness), "the Laplace–Beltrami operator", progress);
}

}  // namespace fairing
