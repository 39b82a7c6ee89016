// Residuals from a level to the next coarser one.
#pragma once

#include "multigrid/transfer.h"

namespace fairing {

// The transpose of Transfer::prolong, stored by target vertex so that several threads can apply it. Takes eight bytes
// for each weight beside the interpolation's own.
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
