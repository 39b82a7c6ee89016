#include "linear/anderson.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "base/parallel.h"

namespace fairing {

namespace {

constexpr int rows_at_once = 4096;  // one sum for each, in the same order for any number of threads

// γ with least |A γ − b|, of least norm in the columns that are independent.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
    qr.setThreshold(1e-12);
    return qr.solve(b);
}

using Columns = std::vector<Eigen::VectorXf>;

Eigen::MatrixXd rows_of(const Columns& columns, Eigen::Index begin, Eigen::Index size) {
    Eigen::MatrixXd result(size, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k)
        result.col(static_cast<Eigen::Index>(k)) = columns[k].segment(begin, size).cast<double>();
    return result;
}

// rows_of(columns, begin, size) γ
Eigen::VectorXd combined(const Columns& columns, Eigen::Index begin, Eigen::Index size, const Eigen::VectorXd& gamma) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size);
    for (std::size_t k = 0; k < columns.size(); ++k)
        sum += gamma[static_cast<Eigen::Index>(k)] * columns[k].segment(begin, size).cast<double>();
    return sum;
}

// The same of a tall A by factors of its parts (Golub, Plemmons & Sameh 1988).
Eigen::VectorXd least_squares_by_parts(const Columns& A, const Eigen::VectorXd& b) {
    const int rows = static_cast<int>(b.size());
    const int parts = (rows + rows_at_once - 1) / rows_at_once;
    if (parts == 1) return least_squares(rows_of(A, 0, rows), b);
    const auto columns = static_cast<int>(A.size());
    Eigen::MatrixXd factors = Eigen::MatrixXd::Zero(Eigen::Index(parts) * columns, columns);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(factors.rows());
    for_ranges(rows, rows_at_once, [&](int begin, int end) {
        const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows_of(A, begin, end - begin));
        const Eigen::VectorXd rotated = qr.householderQ().adjoint() * b.segment(begin, end - begin);
        const Eigen::Index first = Eigen::Index(begin / rows_at_once) * columns;
        const int kept = std::min(columns, end - begin);
        factors.middleRows(first, kept) = qr.matrixQR().topRows(kept).triangularView<Eigen::Upper>();
        values.segment(first, kept) = rotated.head(kept);
    });
    return least_squares(factors, values);
}

}  // namespace

Eigen::VectorXd Anderson::step(const Values& x, const Values& f) {
    remember(x, f);
    return accelerated();
}

void Anderson::remember(const Values& x, const Values& f) {
    if (last_x_.size() > 0) {
        const auto slot = static_cast<std::size_t>(count_++ % depth_);
        if (slot == df_.size()) df_.emplace_back(), sums_.emplace_back();
        Eigen::VectorXf& df = df_[slot];
        Eigen::VectorXf& sum = sums_[slot];
        df.resize(f.size());
        sum.resize(f.size());
        for_ranges(static_cast<int>(f.size()), rows_at_once, [&](int begin, int end) {
            const int size = end - begin;
            const Eigen::VectorXd change = f.segment(begin, size) - last_f_.segment(begin, size);
            df.segment(begin, size) = change.cast<float>();
            sum.segment(begin, size) = (x.segment(begin, size) - last_x_.segment(begin, size) + change).cast<float>();
        });
    }
    last_x_ = x;
    last_f_ = f;
}

Eigen::VectorXd Anderson::accelerated() const {
    if (df_.empty()) return last_f_;
    const Eigen::VectorXd gamma = least_squares_by_parts(df_, last_f_);
    Eigen::VectorXd step = last_f_;
    for_ranges(static_cast<int>(step.size()), rows_at_once, [&](int begin, int end) {
        step.segment(begin, end - begin) -= combined(sums_, begin, end - begin, gamma);
    });
    return step;
}

void Anderson::move(Eigen::Matrix3Xd& points, Eigen::Matrix3Xd plain, double longest) {
    const Eigen::Index count = plain.cols();
    Eigen::Map<Eigen::VectorXd> x(points.data(), plain.size());
    remember(x, Eigen::Map<const Eigen::VectorXd>(plain.data(), plain.size()));
    plain.resize(3, 0);  // the step needs the room
    Eigen::VectorXd far = accelerated();
    const double largest = std::sqrt(far.reshaped(3, count).colwise().squaredNorm().maxCoeff());
    if (largest > longest) far *= longest / largest;
    x += far;
}

}  // namespace fairing
