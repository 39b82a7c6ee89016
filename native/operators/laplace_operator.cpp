#include "operators/laplace_operator.h"

#include <algorithm>

#include "base/parallel.h"

namespace fairing {

LaplaceOperator::LaplaceOperator(const Patch& patch, Points layout, Kept kept)
    : patch_(patch), factor_(std::move(layout), kept), matrix_(patch.free_count, patch.free_count) {
    struct Entry {
        int row;
        int edge;
    };
    Indices rows;
    std::vector<Entry> column;
    for (int j = 0; j < patch.free_count; ++j) {
        column.assign(1, {j, none});
        const RingView ring = patch.ring(j);
        for (std::size_t k = 0; k < ring.valence(); ++k) {
            if (ring.vertices[k] > j && patch.is_free(ring.vertices[k]))
                column.push_back({ring.vertices[k], ring.spokes[k]});
        }
        std::sort(column.begin(), column.end(), [](const Entry& a, const Entry& b) { return a.row < b.row; });
        for (const Entry& entry : column) {
            rows.push_back(entry.row);
            edge_.push_back(entry.edge);
        }
        matrix_.outerIndexPtr()[j + 1] = static_cast<int>(rows.size());
    }
    matrix_.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
    std::copy(rows.begin(), rows.end(), matrix_.innerIndexPtr());
}

bool LaplaceOperator::update(const Stiffness& stiffness, const Progress& progress) {
    for_ranges(patch_.free_count, coarse_grain, [&](int begin, int end) {
        for (int j = begin; j < end; ++j) {
            for (int k = matrix_.outerIndexPtr()[j]; k < matrix_.outerIndexPtr()[j + 1]; ++k) {
                const int edge = edge_[at(k)];
                matrix_.valuePtr()[k] = edge == none ? stiffness.diagonal(patch_, j) : -stiffness.weights[edge];
            }
        }
    });
    return factor_.factorise(matrix_, "the Laplace–Beltrami operator", progress);
}

}  // namespace fairing
