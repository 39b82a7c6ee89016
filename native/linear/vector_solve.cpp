#include "linear/vector_solve.h"

#include "base/parallel.h"

namespace fairing {

namespace {

constexpr int block = 4;  // columns of a panel at once

// b ← b − Σ_k L_k x_k over rows begin … end − 1 of `width` columns that begin at `column`, `rows` long each.
void subtract_columns(const double* column, std::ptrdiff_t rows, int width, const double* x, int begin, int end,
                      double* b) {
    if (width == block) {
        const double* const c0 = column;
        const double* const c1 = c0 + rows;
        const double* const c2 = c1 + rows;
        const double* const c3 = c2 + rows;
        const double x0 = x[0];  // copies: x is a part of b
        const double x1 = x[1];
        const double x2 = x[2];
        const double x3 = x[3];
        for (int i = begin; i < end; ++i) b[i] -= (c0[i] * x0 + c1[i] * x1) + (c2[i] * x2 + c3[i] * x3);
        return;
    }
    for (int k = 0; k < width; ++k) {
        const double* const c = column + k * rows;
        const double xk = x[k];
        for (int i = begin; i < end; ++i) b[i] -= c[i] * xk;
    }
}

double dot(const double* a, const double* b, int begin, int end) {
    using Column = Eigen::Map<const VectorX>;
    return Column(a + begin, end - begin).dot(Column(b + begin, end - begin));
}

// b ← L⁻¹ b for the front's own columns; the rows below get what is taken from them.
void eliminate(const double* panel, int rows, int columns, double* b) {
    for (int j = 0; j < columns; j += block) {
        const int width = std::min(block, columns - j);
        const double* const first = panel + std::ptrdiff_t(j) * rows;
        for (int k = j; k < j + width; ++k) {
            const double* const column = panel + std::ptrdiff_t(k) * rows;
            b[k] /= column[k];
            for (int i = k + 1; i < j + width; ++i) b[i] -= column[i] * b[k];
        }
        subtract_columns(first, rows, width, b + j, j + width, rows, b);
    }
}

// The own entries of b from those below: Lᵀ.
void substitute(const double* panel, int rows, int columns, double* b) {
    for (int j = columns; j-- > 0;) {
        const double* const column = panel + std::ptrdiff_t(j) * rows;
        b[j] = (b[j] - dot(column, b, j + 1, rows)) / column[j];
    }
}

class VectorSweep {
public:
    VectorSweep(const CholeskyFactor& factor, VectorX& x)
        : factor_(factor), tree_(factor.tree), x_(x), outer_(tree_.subtrees().size()) {}

    void up(const FrontReach& reach) {
        const std::vector<Subtree>& parts = tree_.subtrees();
        run_pieces(static_cast<int>(parts.size()), [&](int k) {
            const Subtree& part = parts[at(k)];
            if (!reach.has(part.root())) return;
            outer_[at(k)].setZero(static_cast<Eigen::Index>(tree_.below(part.root()).size()));
            std::vector<double> b;
            for (int s = part.begin; s < part.end; ++s) {
                if (reach.has(s)) up(s, b, outer_[at(k)]);
            }
        });
        for (std::size_t k = 0; k < parts.size(); ++k) {
            if (!reach.has(parts[k].root())) continue;
            Eigen::Index place = 0;
            for (int row : tree_.below(parts[k].root())) x_[row] += outer_[k][place++];
        }
        VectorX unused;
        std::vector<double> b;
        for (int s : tree_.top()) {
            if (reach.has(s)) up(s, b, unused);
        }
    }

    void down(const FrontReach& reach) {
        const std::vector<Subtree>& parts = tree_.subtrees();
        std::vector<double> top;
        for (auto s = tree_.top().rbegin(); s != tree_.top().rend(); ++s) {
            if (reach.has(*s)) down(*s, top);
        }
        run_pieces(static_cast<int>(parts.size()), [&](int k) {
            std::vector<double> b;
            for (int s = parts[at(k)].end; s-- > parts[at(k)].begin;) {
                if (reach.has(s)) down(s, b);
            }
        });
    }

private:
    [[nodiscard]] const double* panel(int s) const { return factor_.panels + factor_.panel_begin[s]; }

    // Into `outer` outside the subtree: other subtrees pass to the same rows.
    void up(int s, std::vector<double>& b, VectorX& outer) {
        const int columns = tree_.nodes().column_count(s);
        const int rows = tree_.nodes().row_count(s);
        double* const own = x_.data() + tree_.nodes().first[at(s)];
        b.assign(at(rows), 0.0);
        std::copy(own, own + columns, b.begin());
        eliminate(panel(s), rows, columns, b.data());
        std::copy(b.begin(), b.begin() + columns, own);
        const auto below = tree_.below(s);
        const auto places = tree_.below_in_outer(s);
        for (std::size_t k = 0; k < below.size(); ++k) {
            const double passed = b[at(columns) + k];
            if (places[k] == none) {
                x_[below[k]] += passed;
            } else {
                outer[places[k]] += passed;
            }
        }
    }

    void down(int s, std::vector<double>& b) {
        const int columns = tree_.nodes().column_count(s);
        const int rows = tree_.nodes().row_count(s);
        double* const own = x_.data() + tree_.nodes().first[at(s)];
        b.resize(at(rows));
        std::copy(own, own + columns, b.begin());
        const auto below = tree_.below(s);
        for (std::size_t k = 0; k < below.size(); ++k) b[at(columns) + k] = x_[below[k]];
        substitute(panel(s), rows, columns, b.data());
        std::copy(b.begin(), b.begin() + columns, own);
    }

    const CholeskyFactor& factor_;
    const FrontTree& tree_;
    VectorX& x_;
    std::vector<VectorX> outer_;  // what each subtree passes on
};

}  // namespace

FrontReach::FrontReach(const CholeskyFactor& factor, const Indices& unknowns)
    : marks_(at(factor.tree.nodes().size()), 0) {
    const Supernodes& nodes = factor.tree.nodes();
    for (int unknown : unknowns) {
        int s = nodes.column_to_supernode[at(factor.position[at(unknown)])];
        for (; s != none && marks_[at(s)] == 0; s = nodes.parent[at(s)]) marks_[at(s)] = 1;
    }
}

VectorX solve_vector(const CholeskyFactor& factor, const VectorX& rhs, const FrontReach& from, const FrontReach& to) {
    const int count = static_cast<int>(rhs.size());
    VectorX x(count);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int k = begin; k < end; ++k) x[k] = rhs[factor.order[at(k)]];
    });
    VectorSweep sweep(factor, x);
    sweep.up(from);
    sweep.down(to);
    VectorX result(count);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int row = begin; row < end; ++row) result[row] = x[factor.position[at(row)]];
    });
    return result;
}

}  // namespace fairing
