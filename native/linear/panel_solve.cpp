#include "linear/panel_solve.h"

#include <Eigen/Cholesky>

#include "base/parallel.h"
#include "linear/limits.h"

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

constexpr int columns_at_once = 128;  // columns that are eliminated at once

template <typename Scalar>
using Block = Eigen::Ref<Dense<Scalar>, 0, Eigen::OuterStride<>>;

// target −= left · leftᵀ for the lower triangle of the leading square of `target`, and all rows below it.
// `left` has the rows of `target`.
template <typename Scalar>
void subtract_product(const Block<Scalar>& left, Block<Scalar> target) {
    const int columns = static_cast<int>(target.cols());
    for_ranges(columns, tile, [&](int begin, int end) {
        const int width = end - begin;
        const auto top = left.middleRows(begin, width);
        target.block(begin, begin, width, width).template selfadjointView<Eigen::Lower>().rankUpdate(top, Scalar(-1));
        const Eigen::Index below = target.rows() - end;
        target.block(end, begin, below, width).noalias() -= left.bottomRows(below) * top.transpose();
    });
}

// One block of columns; false where a pivot is not positive.
template <typename Scalar>
bool factorise_block(Block<Scalar> columns) {
    const int width = static_cast<int>(columns.cols());
    auto diagonal = columns.topRows(width);
    const Eigen::LLT<Block<Scalar>> llt(diagonal);
    if (llt.info() != Eigen::Success) return false;
    auto below = columns.bottomRows(columns.rows() - width);
    for_ranges(static_cast<int>(below.rows()), tile, [&](int begin, int end) {
        diagonal.template triangularView<Eigen::Lower>().transpose().template solveInPlace<Eigen::OnTheRight>(
            below.middleRows(begin, end - begin));
    });
    return true;
}

// The nodes in log s: the sum is within 2.3 % for eigenvalues from the least one to 4, which is about an boundary's
// largest. Beyond `largest` a hundredth of the integral is left out; the last node lies half a cell below the least
// one.
constexpr double spacing = 3.0;
constexpr double largest = 2.0;

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

template <typename Scalar>
bool eliminate_front(Front<Scalar> front, Dense<Scalar>& update, const WorkDone& work_done) {
    const Eigen::Index rows = front.rows();
    const Eigen::Index columns = front.cols();
    for (Eigen::Index begin = 0; begin < columns; begin += columns_at_once) {
        const Eigen::Index width = std::min<Eigen::Index>(columns_at_once, columns - begin);
        const Eigen::Index end = begin + width;
        auto own = front.block(begin, begin, rows - begin, width);
        if (!factorise_block<Scalar>(own)) return false;
        subtract_product<Scalar>(own.bottomRows(rows - end), front.block(end, end, rows - end, columns - end));
        work_done(static_cast<double>(width * (rows - begin) * (columns - begin)));
        if (rows == columns) continue;
        subtract_product<Scalar>(own.bottomRows(rows - columns), update);
        work_done(static_cast<double>(width * (rows - columns) * (rows - columns)));
    }
    return true;
}

template bool eliminate_front(Front<double> front, Dense<double>& update, const WorkDone& work_done);
template bool eliminate_front(Front<float> front, Dense<float>& update, const WorkDone& work_done);

bool HalfOrder::update(const SparseMatrix& lower, double least) {
    Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), order_);
    order_ = order_.inverse().eval();
    SparseMatrix ordered(lower.rows(), lower.cols());
    ordered.selfadjointView<Eigen::Lower>() = lower.selfadjointView<Eigen::Lower>().twistedBy(order_);
    const auto count = std::max(1, static_cast<int>(std::ceil((largest - std::log(least)) / spacing + 0.5)));
    terms_.clear();
    for (int k = 0; k < count; ++k) {
        Term& term = terms_.emplace_back();
        term.shift = std::exp(largest - k * spacing);
        term.weight = spacing / std::numbers::pi * std::sqrt(term.shift) / (1.0 + term.shift);
        term.factor.setShift(term.shift);
        term.factor.compute(ordered);
        if (term.factor.info() != Eigen::Success || !(term.factor.vectorD().minCoeff() > 0.0)) return false;
    }
    // Below the last node's cell λ / (λ + s) is 1, but for the least eigenvalues.
    const double end = terms_.back().shift * std::exp(-0.5 * spacing);
    constant_ = 2.0 / std::numbers::pi * std::sqrt(least) * std::atan(std::sqrt(end / least));
    return true;
}

VectorX HalfOrder::apply(const VectorX& values) const {
    const VectorX ordered = order_ * values;
    VectorX result = constant_ * ordered;
    for (const Term& term : terms_) {
        const VectorX solved = term.factor.solve(ordered);
        result += term.weight * (ordered - term.shift * solved);
    }
    return order_.inverse() * result;
}

}  // namespace fairing
