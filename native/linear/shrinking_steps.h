// Whether the steps of an iteration still become shorter.
#pragma once

#include <limits>

namespace fairing {

class ShrinkingSteps {
public:
    // A step counts as shorter where it is less than `share` of the shortest before it.
    explicit ShrinkingSteps(double share = 1.0) : share_(share) {}

    // Iterations in a row, this one too, without a shorter step: 0 where `length`, the largest move, is one.
    int in_vain(double length) {
        if (length < share_ * shortest_) {
            shortest_ = length;
            return count_ = 0;
        }
        return ++count_;
    }

private:
    double share_;
    double shortest_ = std::numeric_limits<double>::infinity();
    int count_ = 0;
};

}  // namespace fairing
