// Anderson acceleration of a fixed-point iteration x ← x + f(x).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace fairing {

// Keeps the last `depth` differences; type II with least squares by QR (Walker & Ni 2011).
class Anderson {
public:
    explicit Anderson(int depth) : depth_(depth) {}

    using Values = Eigen::Ref<const Eigen::VectorXd>;
    // The accelerated step from x, given the plain step f(x).
    Eigen::VectorXd step(const Values& x, const Values& f);
    // Moves points (3 × n or more) by that step, given the plain one (3 × n). Scales the whole step down where a point
    // would move by more than `longest`.
    void move(Eigen::Matrix3Xd& points, Eigen::Matrix3Xd plain, double longest);
    // The points that the last step went from.
    [[nodiscard]] Eigen::Map<const Eigen::Matrix3Xd> last() const { return {last_x_.data(), 3, last_x_.size() / 3}; }
    void reset() { *this = Anderson(depth_); }
    // The next step is the first of an iteration of nearly the same f, which keeps the differences.
    void begin_again() { last_x_.resize(0); }

private:
    void remember(const Values& x, const Values& f);
    // From what was remembered last.
    [[nodiscard]] Eigen::VectorXd accelerated() const;

    int depth_;
    int count_ = 0;  // differences since the last reset
    // One for each step. Single precision is enough: they only improve a plain step, and the iteration ends where that
    // is 0.
    std::vector<Eigen::VectorXf> df_;
    std::vector<Eigen::VectorXf> sums_;  // dx + df
    Eigen::VectorXd last_x_;             // empty at the beginning
    Eigen::VectorXd last_f_;
};

}  // namespace fairing
