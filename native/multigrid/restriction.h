// Residuals from a level to the next coarser one.
#pragma once

#include "multigrid/transfer.h"

namespace fairing {

// The transpose of Transfer::prolong, by what arrives at each vertex instead of what leaves it: on several threads.
// Eight bytes for each weight that are not shared with the interpolation.
class Restriction {
public:
    // Refers to it.
    explicit Restriction(const Transfer& transfer);

    // coarse ← scale · Pᵀ fine; nothing arrives at fixed vertices. `sums`: scratch of the size of `fine`, `coarse` in
    // the right size.
    void apply(const SingleField& fine, float scale, SingleField& sums, SingleField& coarse) const;

    [[nodiscard]] const Transfer& transfer() const { return transfer_; }

private:
    [[nodiscard]] Eigen::Vector4f arrived(int row, const Eigen::Vector4f& own, const SingleField& sums) const;

    const Transfer& transfer_;
    Indices begin_;  // of each row: the removed vertices in the order of their removal, then the coarse free ones
    Indices from_;   // removals
    std::vector<float> weights_;
};

}  // namespace fairing
