#include "solver/normal_operator.h"

#include <algorithm>

namespace fairing {

namespace {

struct ColumnEntry {
    int row;
    int spoke;  // edge, or `none` on the diagonal
};

// The free rows of column k of S_I: k itself where it is free, and its free neighbours; rows ascending.
void gather_column(const Patch& patch, int k, std::vector<ColumnEntry>& column) {
    column.clear();
    const RingView ring = patch.ring(k);
    for (std::size_t j = 0; j < ring.valence(); ++j) {
        if (patch.is_free(ring.vertices[j])) column.push_back({ring.vertices[j], ring.spokes[j]});
    }
    if (patch.is_free(k)) column.push_back({k, none});
    std::sort(column.begin(), column.end(), [](const ColumnEntry& a, const ColumnEntry& b) { return a.row < b.row; });
}

double diagonal_weight(const Patch& patch, const Stiffness& stiffness, int k) {
    double sum = 0.0;
    for (int edge : patch.ring(k).spokes) sum += stiffness.weights[edge];
    return sum;
}

}  // namespace

BiharmonicOperator::BiharmonicOperator(const Patch& patch, Points layout)
    : NormalOperator(std::move(layout)), patch_(patch) {
    build_pattern();
}

template <typename Visit>
void BiharmonicOperator::for_each_column(Visit visit) const {
    std::vector<ColumnEntry> column;
    for (int k = 0; k < patch_.vertex_count(); ++k) {
        gather_column(patch_, k, column);
        visit(k, column);
    }
}

void BiharmonicOperator::build_pattern() {
    std::vector<Indices> rows(at(patch_.free_count));
    std::size_t products = 0;
    for_each_column([&](int, const std::vector<ColumnEntry>& column) {
        for (std::size_t a = 0; a < column.size(); ++a) {
            for (std::size_t b = a; b < column.size(); ++b) rows[at(column[a].row)].push_back(column[b].row);
        }
        products += column.size() * (column.size() + 1) / 2;
    });
    Indices sizes;
    for (Indices& list : rows) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        sizes.push_back(static_cast<int>(list.size()));
    }
    matrix_.resize(patch_.free_count, patch_.free_count);
    matrix_.reserve(sizes);
    for (int j = 0; j < patch_.free_count; ++j) {
        for (int i : rows[at(j)]) matrix_.insert(i, j) = 0.0;
    }
    matrix_.makeCompressed();

    slots_.reserve(products);
    for_each_column([&](int, const std::vector<ColumnEntry>& column) {
        for (std::size_t a = 0; a < column.size(); ++a) {
            const Indices& list = rows[at(column[a].row)];
            const int begin = matrix_.outerIndexPtr()[column[a].row];
            for (std::size_t b = a; b < column.size(); ++b) {
                const auto found = std::lower_bound(list.begin(), list.end(), column[b].row);
                slots_.push_back(begin + static_cast<int>(found - list.begin()));
            }
        }
    });
}

bool BiharmonicOperator::update(const Stiffness& stiffness, const Progress& progress) {
    matrix_.coeffs().setZero();
    double* values = matrix_.valuePtr();
    auto slot = slots_.begin();
    std::vector<double> entries;
    for_each_column([&](int k, const std::vector<ColumnEntry>& column) {
        entries.clear();
        for (const ColumnEntry& entry : column) {
            entries.push_back(entry.spoke == none ? diagonal_weight(patch_, stiffness, k)
                                                  : -stiffness.weights[entry.spoke]);
        }
        const double scale = 0.25 / stiffness.mass[k];
        for (std::size_t a = 0; a < entries.size(); ++a) {
            for (std::size_t b = a; b < entries.size(); ++b) values[*slot++] += scale * entries[a] * entries[b];
        }
    });
    return factor_.factorise(matrix_, "the fairness operator", progress);
}

bool LaplaceOperator::update(const Stiffness& stiffness, const Progress& progress) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < patch_.free_count; ++i) {
        entries.emplace_back(i, i, diagonal_weight(patch_, stiffness, i));
        const RingView ring = patch_.ring(i);
        for (std::size_t k = 0; k < ring.valence(); ++k) {
            if (ring.vertices[k] > i && patch_.is_free(ring.vertices[k])) {
                entries.emplace_back(ring.vertices[k], i, -stiffness.weights[ring.spokes[k]]);
            }
        }
    }
    SparseMatrix matrix(patch_.free_count, patch_.free_count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return factor_.factorise(matrix, "the Laplace–Beltrami operator", progress);
}

std::unique_ptr<NormalOperator> make_normal_operator(const Problem& problem) {
    if (problem.options.equation == Equation::minimal) return std::make_unique<LaplaceOperator>(problem.patch);
    return std::make_unique<BiharmonicOperator>(problem.patch);
}

}  // namespace fairing
