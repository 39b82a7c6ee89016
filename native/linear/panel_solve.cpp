#include "linear/panel_solve.h"

#include <Eigen/Cholesky>

#include "base/parallel.h"
#include "linear/limits.h"

namespace fairing {

namespace {

constexpr int block = 4;  // columns of a panel at once

template <int count, typename Stored>
using Row = Eigen::Array<Stored, count, 1>;

template <int count, typename Stored>
Eigen::Map<Row<count, Stored>> row_of(Stored* b, int row) {
    return Eigen::Map<Row<count, Stored>>(b + std::ptrdiff_t(count) * row);
}

// b_i ← b_i − Σ_k L_ik x_k over the rows i from `begin` on of `width` columns that begin at `column`. x is a part of b.
template <int count, typename Stored>
void subtract_columns(const Stored* column, int rows, int width, int begin, Stored* x, Stored* b) {
    if (width == block) {
        const Stored* const c1 = column + rows;
        const Stored* const c2 = c1 + rows;
        const Stored* const c3 = c2 + rows;
        const Row<count, Stored> x0 = row_of<count>(x, 0);
        const Row<count, Stored> x1 = row_of<count>(x, 1);
        const Row<count, Stored> x2 = row_of<count>(x, 2);
        const Row<count, Stored> x3 = row_of<count>(x, 3);
        for (int i = begin; i < rows; ++i)
            row_of<count>(b, i) -= (column[i] * x0 + c1[i] * x1) + (c2[i] * x2 + c3[i] * x3);
        return;
    }
    for (int k = 0; k < width; ++k) {
        const Stored* const c = column + std::ptrdiff_t(k) * rows;
        const Row<count, Stored> xk = row_of<count>(x, k);
        for (int i = begin; i < rows; ++i) row_of<count>(b, i) -= c[i] * xk;
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

template <int count, typename Stored>
void eliminate(const PanelOf<Stored>& panel, Stored* b) {
    const int rows = static_cast<int>(panel.rows());
    const int columns = static_cast<int>(panel.cols());
    for (int j = 0; j < columns; j += block) {
        const int width = std::min(block, columns - j);
        for (int k = j; k < j + width; ++k) {
            const Stored* const column = panel.data() + std::ptrdiff_t(k) * rows;
            row_of<count>(b, k) /= column[k];
            for (int i = k + 1; i < j + width; ++i) row_of<count>(b, i) -= column[i] * row_of<count>(b, k);
        }
        subtract_columns<count>(panel.data() + std::ptrdiff_t(j) * rows, rows, width, j + width,
                                b + std::ptrdiff_t(count) * j, b);
    }
}

// A single dot product is summed in several registers, which the compiler may not do by itself.
template <int count, typename Stored>
void substitute(const PanelOf<Stored>& panel, Stored* b) {
    const int rows = static_cast<int>(panel.rows());
    for (int j = static_cast<int>(panel.cols()); j-- > 0;) {
        const Stored* const column = panel.data() + std::ptrdiff_t(j) * rows;
        Row<count, Stored> sum = row_of<count>(b, j);
        if constexpr (count == 1) {
            const int below = rows - j - 1;
            sum -=
                panel.col(j).tail(below).dot(Eigen::Map<const Eigen::Vector<Stored, Eigen::Dynamic>>(b + j + 1, below));
        } else {
            for (int i = j + 1; i < rows; ++i) sum -= column[i] * row_of<count>(b, i);
        }
        row_of<count>(b, j) = sum / column[j];
    }
}

template void eliminate<1>(const PanelOf<double>&, double*);
template void eliminate<1>(const PanelOf<float>&, float*);
template void eliminate<lanes>(const PanelOf<double>&, double*);
template void eliminate<lanes>(const PanelOf<float>&, float*);
template void substitute<1>(const PanelOf<double>&, double*);
template void substitute<1>(const PanelOf<float>&, float*);
template void substitute<lanes>(const PanelOf<double>&, double*);
template void substitute<lanes>(const PanelOf<float>&, float*);

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
