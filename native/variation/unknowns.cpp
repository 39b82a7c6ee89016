#include "variation/unknowns.h"

namespace fairing {

namespace {

// The corner of a triangle that does not lie on the edge.
int apex(const Patch& patch, int triangle, int edge) {
    for (int k = 0; k < 3; ++k) {
        if (patch.triangle_edges(k, triangle) == edge) return patch.triangles(k, triangle);
    }
    return none;
}

int across(const Patch& patch, int triangle, int edge) {
    const auto [first, second] = patch.edge_triangles[edge];
    const int other = first == triangle ? second : first;
    return other == none ? none : apex(patch, other, edge);
}

}  // namespace

std::vector<Stencil> stencils(const Patch& patch) {
    std::vector<Stencil> result;
    result.reserve(patch.triangle_count());
    for (int t = 0; t < patch.triangle_count(); ++t) {
        Stencil stencil{};
        for (int k = 0; k < 3; ++k) {
            stencil[k] = patch.triangles(k, t);
            stencil[3 + k] = across(patch, t, patch.triangle_edges(k, t));
        }
        result.push_back(stencil);
    }
    return result;
}

Unknowns::Unknowns(const Freedom& freedom, const std::vector<Stencil>& stencils)
    : vertex_count_(static_cast<int>(freedom.rises.size())) {
    number(freedom);
    connect(stencils);
}

void Unknowns::number(const Freedom& freedom) {
    index_.assign(3 * vertex_count_, none);
    for (int v = 0; v < vertex_count_; ++v) {
        first_.push_back(count_);
        if (freedom.rises[v]) index_[3 * v] = count_++;
        if (freedom.turns[v]) {
            index_[3 * v + 1] = count_++;
            index_[3 * v + 2] = count_++;
        }
        vertex_of_.resize(count_, v);
    }
    first_.push_back(count_);
}

void Unknowns::connect(const std::vector<Stencil>& stencils) {
    std::vector<Indices> later(vertex_count_);
    for (const Stencil& stencil : stencils) {
        for (int i : stencil) {
            for (int j : stencil) {
                if (i != none && j > i) later[i].push_back(j);
            }
        }
    }
    column_begin_ = {0};
    for (int v = 0; v < vertex_count_; ++v) {
        Indices& list = later[v];
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        list.insert(list.begin(), v);
        begin_.push_back(static_cast<int>(neighbours_.size()));
        int rows = 0;
        for (int u : list) {
            neighbours_.push_back(u);
            rows_before_.push_back(rows);
            rows += first_[u + 1] - first_[u];
        }
        for (int k = first_[v]; k < first_[v + 1]; ++k)
            column_begin_.push_back(column_begin_.back() + rows - (k - first_[v]));
    }
    begin_.push_back(static_cast<int>(neighbours_.size()));
}

SparseMatrix Unknowns::pattern() const {
    SparseMatrix matrix(count_, count_);
    matrix.resizeNonZeros(column_begin_.back());
    for (int column = 0; column <= count_; ++column) matrix.outerIndexPtr()[column] = column_begin_[column];
    int place = 0;
    for (int column = 0; column < count_; ++column) {
        const int v = vertex_of_[column];
        for (int k = begin_[v]; k < begin_[v + 1]; ++k) {
            const int u = neighbours_[k];
            for (int row = std::max(first_[u], column); row < first_[u + 1]; ++row)
                matrix.innerIndexPtr()[place++] = row;
        }
    }
    std::fill_n(matrix.valuePtr(), place, 0.0);
    return matrix;
}

int Unknowns::block_of(int vertex, int other) const {
    const int v = std::min(vertex, other);
    const auto list = neighbours_.begin() + begin_[v];
    const auto found = std::lower_bound(list, neighbours_.begin() + begin_[v + 1], std::max(vertex, other));
    return rows_before_[begin_[v] + static_cast<int>(found - list)];
}

int Unknowns::slot(int row, int column, int block) const {
    const int in_row = row - first_[vertex_of_[row]];
    const int in_column = column - first_[vertex_of_[column]];
    return column_begin_[column] + block + in_row - in_column;
}

}  // namespace fairing
