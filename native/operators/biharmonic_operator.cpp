#include "operators/biharmonic_operator.h"

#include "base/parallel.h"

namespace fairing {

namespace {

// visit(k, edge from i to k) for each column k of S_I with an entry in row i; `none` for k = i.
template <typename Visit>
void for_each_around(const Patch& patch, int i, const Visit& visit) {
    visit(i, none);
    const RingView ring = patch.ring(i);
    for (std::size_t n = 0; n < ring.valence(); ++n) visit(ring.vertices[n], ring.spokes[n]);
}

// visit(j, k, edge from i to k, edge from k to j) for each product S_ik S_jk of row i with j ≥ i, both free.
template <typename Visit>
void for_each_product(const Patch& patch, int i, const Visit& visit) {
    for_each_around(patch, i, [&](int k, int first) {
        for_each_around(patch, k, [&](int j, int second) {
            if (j >= i && patch.is_free(j)) visit(j, k, first, second);
        });
    });
}

}  // namespace

BiharmonicOperator::BiharmonicOperator(const Patch& patch, Points layout) : patch_(patch), factor_(std::move(layout)) {
    build_pattern();
    find_slots();
}

void BiharmonicOperator::build_pattern() {
    const int count = patch_.free_count;
    std::vector<Indices> pieces((count / coarse_grain) + 1);
    std::vector<int> sizes(count);
    product_begin_.assign(count + 1, 0);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        Indices& all = pieces[begin / coarse_grain];
        Indices row;
        for (int i = begin; i < end; ++i) {
            row.clear();
            for_each_product(patch_, i, [&](int j, int, int, int) { row.push_back(j); });
            product_begin_[i + 1] = row.size();
            std::sort(row.begin(), row.end());
            row.erase(std::unique(row.begin(), row.end()), row.end());
            sizes[i] = static_cast<int>(row.size());
            all.insert(all.end(), row.begin(), row.end());
        }
    });
    std::partial_sum(product_begin_.begin(), product_begin_.end(), product_begin_.begin());
    matrix_.resize(count, count);
    std::partial_sum(sizes.begin(), sizes.end(), matrix_.outerIndexPtr() + 1);
    matrix_.resizeNonZeros(count > 0 ? matrix_.outerIndexPtr()[count] : 0);
    int* next = matrix_.innerIndexPtr();
    for (const Indices& piece : pieces) next = std::copy(piece.begin(), piece.end(), next);
}

void BiharmonicOperator::find_slots() {
    slots_.resize(product_begin_.back());
    for_ranges(patch_.free_count, coarse_grain, [&](int begin, int end) {
        auto slot = slots_.begin() + std::ptrdiff_t(product_begin_[begin]);
        for (int i = begin; i < end; ++i) {
            const int* first = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[i];
            const int* last = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[i + 1];
            for_each_product(patch_, i, [&](int j, int, int, int) {
                *slot++ = static_cast<int>(std::lower_bound(first, last, j) - first);
            });
        }
    });
}

bool BiharmonicOperator::update(const Stiffness& stiffness, const Progress& progress) {
    assemble(stiffness);
    return factor_.factorise(matrix_, "the fairness operator", progress);
}

bool BiharmonicOperator::update_with_mass(const Stiffness& stiffness, const VectorX& factors,
                                          const Progress& progress) {
    assemble(stiffness);
    // Rows begin at the diagonal.
    for (int i = 0; i < patch_.free_count; ++i) {
        matrix_.valuePtr()[matrix_.outerIndexPtr()[i]] += factors[i] * stiffness.mass[i];
    }
    return factor_.factorise(matrix_, "the smoothing operator", progress);
}

void BiharmonicOperator::assemble(const Stiffness& stiffness) {
    VectorX diagonal(patch_.vertex_count());
    for_ranges(patch_.vertex_count(), coarse_grain, [&](int begin, int end) {
        for (int k = begin; k < end; ++k) diagonal[k] = stiffness.diagonal(patch_, k);
    });
    const auto entry = [&](int k, int edge) { return edge == none ? diagonal[k] : -stiffness.weights[edge]; };
    for_ranges(patch_.free_count, coarse_grain, [&](int begin, int end) {
        auto slot = slots_.begin() + std::ptrdiff_t(product_begin_[begin]);
        for (int i = begin; i < end; ++i) {
            const int first = matrix_.outerIndexPtr()[i];
            double* row = matrix_.valuePtr() + first;
            std::fill(row, matrix_.valuePtr() + matrix_.outerIndexPtr()[i + 1], 0.0);
            for_each_product(patch_, i, [&](int, int k, int edge_i, int edge_j) {
                row[*slot++] += 0.25 / stiffness.mass[k] * entry(k, edge_i) * entry(k, edge_j);
            });
        }
    });
}

}  // namespace fairing
