// Least-squares systems of many rows and few columns, assembled and factorised repeatedly.
#pragma once

#include "base/types.h"

namespace fairing {

// A = Q R by Householder's reflections. Rows are stored in groups of four (SIMD), padded with zeros: Eigen's blocks of
// any size would spend half of the time on their ends.
class TallSystem {
public:
    using Four = Eigen::Array4d;
    using Index = Eigen::Index;
    static constexpr int most_columns = 11;  // ten unknowns of a cubic with a free centre, and the heights
    using Row = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_columns, 1>;

    // rows ≥ columns
    TallSystem(Index rows, Index columns);

    [[nodiscard]] Index fours() const { return fours_; }
    // Entries 4 `four` … 4 `four` + 3 of a column.
    void set(Index four, Index column, const Four& values) { rows_.col(column * fours_ + four) = values; }

    // Makes R, and leaves zeros in the rows.
    void triangularise();
    [[nodiscard]] double factor(Index row, Index column) const { return factor_(row, column); }
    // The least pivot of the first `count` ones over the largest of them.
    [[nodiscard]] double least_pivot(Index count) const;
    // R x = the column behind them, for the first `count` columns.
    [[nodiscard]] Row solve(Index count) const;
    // Rᵀ x = y, likewise.
    [[nodiscard]] Row solve_transposed(Row y) const;

private:
    void reflect(Index column);

    Index columns_;
    Index fours_;
    Eigen::Matrix<double, 4, Eigen::Dynamic> rows_;
    Eigen::Matrix<double, most_columns, most_columns> factor_;
};

}  // namespace fairing
