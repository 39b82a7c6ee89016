// Sparse Cholesky factorisation with a fixed pattern and changing values: multifrontal over supernodes, so that nearly
// all work is done by dense kernels, and interruptible between any two of them.
#pragma once

#include "base/progress.h"
#include "linear/front_tree.h"
#include "linear/panel_solve.h"
#include "linear/tree_solve.h"

namespace fairing {

// The precision of a factor. `singles` take half of the memory and of the time, and their solves have a relative error
// of some 1e-7 times the matrix's condition: enough for a step of an iteration. They may refuse a matrix that is
// positive definite by less than their rounding; sums in double precision would save nearly none of these, since the
// entries are rounded as well.
enum class Kept { doubles, singles };

class SparseCholesky {
public:
    SparseCholesky() = default;
    // Places of the unknowns (3 × n), by which a large matrix is ordered.
    explicit SparseCholesky(Points layout, Kept kept = Kept::doubles) : layout_(std::move(layout)), kept_(kept) {}

    // Finds the ordering of matrices with the pattern of `lower`, a lower triangle (diagonal included); its values are
    // not read.
    void analyse_pattern(const SparseMatrix& lower);

    // Factorises a symmetric matrix given by its lower triangle (diagonal included). The ordering is found at the first
    // call, or before, and kept: the pattern must stay the same. False where the matrix is not positive definite; the
    // factor is then unusable until the next call, as it is after Cancelled. `what` names the stage for `progress`.
    [[nodiscard]] bool factorise(const SparseMatrix& lower, const char* what, const Progress& progress);
    // The same for a matrix that no one else needs: it is released as soon as its entries are read.
    [[nodiscard]] bool factorise(SparseMatrix&& lower, const char* what, const Progress& progress);

    // Solves for one or several right-hand sides (n × k). With a factor of singles all sums are singles, here and
    // below.
    [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const;
    // For three at once, one point (a column) of each unknown: a third of the time where fronts are small.
    [[nodiscard]] Points solve_points(const Points& rhs) const;

    // For one, in part. `from`: reach of the entries of `rhs` that aren't zero; `to`: where x is wanted, elsewhere
    // it is left undefined.
    [[nodiscard]] VectorX solve_vector(const VectorX& rhs, const FrontReach& from = FrontReach(),
                                       const FrontReach& to = FrontReach()) const;
    // The reach of some rows of the matrix. Valid as long as the ordering is kept.
    [[nodiscard]] FrontReach reach(const Indices& rows) const;
    [[nodiscard]] const FrontTree& tree() const { return tree_; }

private:
    // visit(k, place in the panels) for all entries k.
    template <typename Visit>
    void find_slots(const SparseMatrix& lower, const Visit& visit) const;
    // The place of an entry in two rows of the matrix, in either order.
    [[nodiscard]] std::size_t slot_of(int row, int column) const;
    void read(const SparseMatrix& lower);
    void scatter(const SparseMatrix& lower);
    [[nodiscard]] bool eliminate_all(const char* what, const Progress& progress);
    template <typename Stored>
    [[nodiscard]] bool eliminate_all(Stored* panels, const char* what, const Progress& progress);
    // visit(panels_ or singles_).
    template <typename Visit>
    [[nodiscard]] auto with_panels(const Visit& visit) const;
    template <typename Stored>
    [[nodiscard]] Points solve_side_by_side(const Stored* panels, const Points& rhs) const;
    // A supernode's part of panels_ or singles_.
    template <typename Stored>
    [[nodiscard]] auto panel(Stored* panels, int supernode) const;

    Points layout_;     // empty: not known, or not needed any more
    Indices order_;     // position in the factor → row of the matrix
    Indices position_;  // its inverse
    FrontTree tree_;
    std::vector<std::size_t> panel_begin_;  // dense row_count × column_count blocks
    Kept kept_ = Kept::doubles;
    VectorX panels_;  // one of these two is empty
    Eigen::VectorXf singles_;
    std::vector<std::size_t> entry_slot_;  // entry of the matrix → place in panels_; a factor of singles keeps none
    bool analysed_ = false;
};

}  // namespace fairing
