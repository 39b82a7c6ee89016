#include "linear/anderson.h"

#include <algorithm>

#include <Eigen/QR>

namespace fairing {

Anderson::Anderson(Eigen::Index size, int depth) : depth_(depth), dx_(size, depth), df_(size, depth) {}

Eigen::VectorXd Anderson::step(const Eigen::VectorXd& x, const Eigen::VectorXd& f) {
    if (count_ > 0) {
        const int slot = (count_ - 1) % depth_;
        dx_.col(slot) = x - last_x_;
        df_.col(slot) = f - last_f_;
    }
    last_x_ = x;
    last_f_ = f;
    const int used = std::min(count_++, depth_);
    if (used == 0) return f;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(df_.leftCols(used));
    qr.setThreshold(1e-12);
    const Eigen::VectorXd gamma = qr.solve(f);
    return f - (dx_.leftCols(used) + df_.leftCols(used)) * gamma;
}

}  // namespace fairing
