#include "linear/panel_solve.h"

#include <algorithm>

namespace fairing {

namespace {

constexpr int block = 4;  // columns of a panel at once

// b ← b − Σ_k L_k x_k over rows begin … end − 1 of `width` columns that begin at `column`, `rows` long each.
template <typename Stored>
void subtract_columns(const Stored* column, std::ptrdiff_t rows, int width, const Stored* x, int begin, int end,
                      Stored* b) {
    if (width == block) {
        const Stored* const c0 = column;
        const Stored* const c1 = c0 + rows;
        const Stored* const c2 = c1 + rows;
        const Stored* const c3 = c2 + rows;
        const Stored x0 = x[0];  // copies: x is a part of b
        const Stored x1 = x[1];
        const Stored x2 = x[2];
        const Stored x3 = x[3];
        for (int i = begin; i < end; ++i) b[i] -= (c0[i] * x0 + c1[i] * x1) + (c2[i] * x2 + c3[i] * x3);
        return;
    }
    for (int k = 0; k < width; ++k) {
        const Stored* const c = column + k * rows;
        const Stored xk = x[k];
        for (int i = begin; i < end; ++i) b[i] -= c[i] * xk;
    }
}

template <typename Stored>
Stored dot(const Stored* a, const Stored* b, int begin, int end) {
    using Column = Eigen::Map<const Eigen::Vector<Stored, Eigen::Dynamic>>;
    return Column(a + begin, end - begin).dot(Column(b + begin, end - begin));
}

template <typename Stored>
using Lane = Eigen::Array<Stored, lanes, 1>;

template <typename Stored>
Eigen::Map<Lane<Stored>> row_of(Stored* b, int row) {
    return Eigen::Map<Lane<Stored>>(b + std::ptrdiff_t(lanes) * row);
}

// b_i ← b_i − Σ_k L_ik x_k over the rows i from `begin` on of `width` columns that begin at `column`.
template <typename Stored>
void subtract_lanes(const Stored* column, int rows, int width, int begin, Stored* x, Stored* b) {
    if (width == block) {
        const Stored* const c1 = column + rows;
        const Stored* const c2 = c1 + rows;
        const Stored* const c3 = c2 + rows;
        const Lane<Stored> x0 = row_of(x, 0);
        const Lane<Stored> x1 = row_of(x, 1);
        const Lane<Stored> x2 = row_of(x, 2);
        const Lane<Stored> x3 = row_of(x, 3);
        for (int i = begin; i < rows; ++i) row_of(b, i) -= (column[i] * x0 + c1[i] * x1) + (c2[i] * x2 + c3[i] * x3);
        return;
    }
    for (int k = 0; k < width; ++k) {
        const Stored* const c = column + std::ptrdiff_t(k) * rows;
        const Lane<Stored> xk = row_of(x, k);
        for (int i = begin; i < rows; ++i) row_of(b, i) -= c[i] * xk;
    }
}

}  // namespace

template <typename Stored>
void eliminate_vector(const PanelOf<Stored>& panel, Stored* b) {
    const int rows = static_cast<int>(panel.rows());
    const int columns = static_cast<int>(panel.cols());
    for (int j = 0; j < columns; j += block) {
        const int width = std::min(block, columns - j);
        const Stored* const first = panel.data() + std::ptrdiff_t(j) * rows;
        for (int k = j; k < j + width; ++k) {
            const Stored* const column = panel.data() + std::ptrdiff_t(k) * rows;
            b[k] /= column[k];
            for (int i = k + 1; i < j + width; ++i) b[i] -= column[i] * b[k];
        }
        subtract_columns(first, rows, width, b + j, j + width, rows, b);
    }
}

template <typename Stored>
void substitute_vector(const PanelOf<Stored>& panel, Stored* b) {
    const int rows = static_cast<int>(panel.rows());
    for (int j = static_cast<int>(panel.cols()); j-- > 0;) {
        const Stored* const column = panel.data() + std::ptrdiff_t(j) * rows;
        b[j] = (b[j] - dot(column, b, j + 1, rows)) / column[j];
    }
}

template <typename Stored>
void eliminate_lanes(const PanelOf<Stored>& panel, Stored* b) {
    const int rows = static_cast<int>(panel.rows());
    const int columns = static_cast<int>(panel.cols());
    for (int j = 0; j < columns; j += block) {
        const int width = std::min(block, columns - j);
        for (int k = j; k < j + width; ++k) {
            const Stored* const column = panel.data() + std::ptrdiff_t(k) * rows;
            row_of(b, k) /= column[k];
            for (int i = k + 1; i < j + width; ++i) row_of(b, i) -= column[i] * row_of(b, k);
        }
        subtract_lanes(panel.data() + std::ptrdiff_t(j) * rows, rows, width, j + width, row_of(b, j).data(), b);
    }
}

template <typename Stored>
void substitute_lanes(const PanelOf<Stored>& panel, Stored* b) {
    const int rows = static_cast<int>(panel.rows());
    for (int j = static_cast<int>(panel.cols()); j-- > 0;) {
        const Stored* const column = panel.data() + std::ptrdiff_t(j) * rows;
        Lane<Stored> sum = row_of(b, j);
        for (int i = j + 1; i < rows; ++i) sum -= column[i] * row_of(b, i);
        row_of(b, j) = sum / column[j];
    }
}

template void eliminate_vector<double>(const PanelOf<double>&, double*);
template void eliminate_vector<float>(const PanelOf<float>&, float*);
template void substitute_vector<double>(const PanelOf<double>&, double*);
template void substitute_vector<float>(const PanelOf<float>&, float*);
template void eliminate_lanes<double>(const PanelOf<double>&, double*);
template void eliminate_lanes<float>(const PanelOf<float>&, float*);
template void substitute_lanes<double>(const PanelOf<double>&, double*);
template void substitute_lanes<float>(const PanelOf<float>&, float*);

}  // namespace fairing
