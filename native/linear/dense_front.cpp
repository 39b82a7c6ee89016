#include "linear/dense_front.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "base/parallel.h"

namespace fairing {

namespace {

// Columns that are eliminated at once, and tiles of the products of large fronts.
constexpr int block = 128;
constexpr int tile = 192;

using Block = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using ConstBlock = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

// target −= left · leftᵀ for the lower triangle of the leading square of `target`, and all rows below it.
// `left` has the rows of `target`.
void subtract_product(const ConstBlock& left, Block target) {
    const int columns = static_cast<int>(target.cols());
    for_ranges(columns, tile, [&](int begin, int end) {
        const int width = end - begin;
        const auto top = left.middleRows(begin, width);
        target.block(begin, begin, width, width).selfadjointView<Eigen::Lower>().rankUpdate(top, -1.0);
        const Eigen::Index below = target.rows() - end;
        target.block(end, begin, below, width).noalias() -= left.bottomRows(below) * top.transpose();
    });
}

// One block of columns; false where a pivot is not positive.
bool factorise_block(Block columns) {
    const int width = static_cast<int>(columns.cols());
    auto diagonal = columns.topRows(width);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>> llt(diagonal);
    if (llt.info() != Eigen::Success) return false;
    auto below = columns.bottomRows(columns.rows() - width);
    for_ranges(static_cast<int>(below.rows()), tile, [&](int begin, int end) {
        diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(
            below.middleRows(begin, end - begin));
    });
    return true;
}

}  // namespace

bool eliminate_front(Front front, Eigen::MatrixXd& update, const WorkDone& work_done) {
    const Eigen::Index rows = front.rows();
    const Eigen::Index columns = front.cols();
    for (Eigen::Index begin = 0; begin < columns; begin += block) {
        const Eigen::Index width = std::min<Eigen::Index>(block, columns - begin);
        const Eigen::Index end = begin + width;
        auto own = front.block(begin, begin, rows - begin, width);
        if (!factorise_block(own)) return false;
        subtract_product(own.bottomRows(rows - end), front.block(end, end, rows - end, columns - end));
        work_done(static_cast<double>(width * (rows - begin) * (columns - begin)));
        if (rows == columns) continue;
        subtract_product(own.bottomRows(rows - columns), update);
        work_done(static_cast<double>(width * (rows - columns) * (rows - columns)));
    }
    return true;
}

}  // namespace fairing
