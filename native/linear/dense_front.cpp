#include "linear/dense_front.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "base/parallel.h"
#include "linear/limits.h"

namespace fairing {

namespace {

constexpr int block = 128;  // columns that are eliminated at once

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

}  // namespace

template <typename Scalar>
bool eliminate_front(Front<Scalar> front, Dense<Scalar>& update, const WorkDone& work_done) {
    const Eigen::Index rows = front.rows();
    const Eigen::Index columns = front.cols();
    for (Eigen::Index begin = 0; begin < columns; begin += block) {
        const Eigen::Index width = std::min<Eigen::Index>(block, columns - begin);
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

}  // namespace fairing
