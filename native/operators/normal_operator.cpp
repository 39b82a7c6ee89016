#include "operators/normal_operator.h"

#include "base/parallel.h"
#include "operators/bending.h"
#include "operators/biharmonic_operator.h"

namespace fairing {

namespace {

// Free vertices. The split operator is analysed and factorised in less time, the assembled one solves in less: at
// 10,000 12 and 39 ms, 4 and 2.4 ms. Repeated solves live on the latter. From 15,000 on the assembled operator's factor
// grows faster (at 100k three times the entries, six times the work).
constexpr int largest_assembled(Solves solves) { return solves == Solves::few ? 2'500 : 15'000; }

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

std::unique_ptr<NormalOperator> make_normal_operator(const Problem& problem, Points layout, Solves solves) {
    const Patch& patch = problem.patch;
    if (problem.options.equation == Equation::soap_film)
        return std::make_unique<LaplaceOperator>(patch, std::move(layout));
    if (patch.free_count <= largest_assembled(solves))
        return std::make_unique<BiharmonicOperator>(patch, std::move(layout));
    return std::make_unique<SplitBiharmonicOperator>(patch, problem.fixed_points, std::move(layout));
}

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

void LaplaceOperator::prepare() {
    Stiffness pattern;
    pattern.weights.setZero(patch_.edge_count());
    factor_.analyse_pattern(lower(pattern));
}

bool LaplaceOperator::update(const Stiffness& stiffness, const Progress& progress) {
    return factor_.factorise(lower(stiffness), "the Laplace–Beltrami operator", progress);
}

}  // namespace fairing
