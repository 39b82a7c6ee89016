#include "linear/sparse_cholesky.h"

#include <atomic>
#include <cstdint>
#include <thread>
#include <type_traits>

#include "base/parallel.h"
#include "linear/limits.h"
#include "linear/nested_dissection.h"

namespace fairing {

namespace {

// Counts the operations of several threads; the one that made it reports, about every ten million.
class SharedProgress {
public:
    SharedProgress(const Progress& progress, const char* what, double total)
        : progress_(progress), what_(what), total_(total) {}

    void add(double operations) {
        constexpr std::int64_t between_reports = 10'000'000;  // multiplications
        const std::int64_t done = done_ += static_cast<std::int64_t>(operations);
        if (std::this_thread::get_id() != caller_) return throw_if_stopped();
        if (done - reported_ < between_reports) return;
        reported_ = done;
        progress_.report(std::min(1.0, static_cast<double>(done) / total_), what_);
    }

private:
    const Progress& progress_;
    const char* what_;
    const double total_;
    const std::thread::id caller_ = std::this_thread::get_id();
    std::atomic<std::int64_t> done_ = 0;
    std::int64_t reported_ = 0;
};

// One factorisation in either precision.
template <typename Scalar>
class FrontElimination {
public:
    explicit FrontElimination(const FrontTree& tree) : tree_(tree), updates_(tree.nodes().size()) {}

    // Supernode s, whose children are done. False where a pivot is not positive.
    [[nodiscard]] bool eliminate(int s, Front<Scalar> front, const WorkDone& work_done) {
        Dense<Scalar>& update = updates_[s];
        const auto below = static_cast<Eigen::Index>(tree_.below(s).size());
        update.setZero(below, below);
        for (int child : tree_.children(s)) add_child(child, s, front, update);
        return eliminate_front<Scalar>(front, update, work_done);
    }

private:
    // Adds what a child passes on to the panel of its parent and to what the parent passes on itself (lower triangles).
    void add_child(int child, int parent, Front<Scalar>& front, Dense<Scalar>& parent_update) {
        Dense<Scalar>& update = updates_[child];
        const auto target = tree_.below_in_parent(child);
        const int columns = tree_.nodes().column_count(parent);
        for (Eigen::Index b = 0; b < update.cols(); ++b) {
            const int column = target[std::size_t(b)];
            if (column < columns) {
                for (Eigen::Index a = b; a < update.rows(); ++a) front(target[std::size_t(a)], column) += update(a, b);
            } else {
                for (Eigen::Index a = b; a < update.rows(); ++a) {
                    parent_update(target[std::size_t(a)] - columns, column - columns) += update(a, b);
                }
            }
        }
        update.resize(0, 0);
    }

    const FrontTree& tree_;
    std::vector<Dense<Scalar>> updates_;  // Schur complements that supernodes pass on, freed when taken
};

}  // namespace

template <typename Stored>
auto SparseCholesky::panel(Stored* panels, int s) const {
    using Matrix = Dense<std::remove_const_t<Stored>>;
    using Panel = Eigen::Map<std::conditional_t<std::is_const_v<Stored>, const Matrix, Matrix>>;
    const Supernodes& nodes = tree_.nodes();
    return Panel(panels + panel_begin_[s], nodes.row_count(s), nodes.column_count(s));
}

void SparseCholesky::analyse_pattern(const SparseMatrix& lower) {
    const bool dissect = layout_.cols() == lower.cols() && lower.cols() >= large_order;
    Elimination elimination = analyse(lower, dissect ? nested_dissection(lower, layout_) : minimum_degree(lower));
    layout_.resize(3, 0);
    order_ = std::move(elimination.order);
    position_ = std::move(elimination.position);
    tree_ = FrontTree(std::move(elimination.supernodes));
    const Supernodes& nodes = tree_.nodes();
    panel_begin_ = {0};
    for (int s = 0; s < nodes.size(); ++s) {
        panel_begin_.push_back(panel_begin_.back() +
                               static_cast<std::size_t>(nodes.row_count(s)) * nodes.column_count(s));
    }
    if (kept_ == Kept::doubles) {
        entry_slot_.resize(static_cast<std::size_t>(lower.nonZeros()));
        find_slots(lower, [&](int k, std::size_t slot) { entry_slot_[k] = slot; });
    }
    analysed_ = true;
}

std::size_t SparseCholesky::slot_of(int row, int column) const {
    const Supernodes& nodes = tree_.nodes();
    const auto [first, last] = std::minmax(position_[row], position_[column]);
    const int s = nodes.column_to_supernode[first];
    const int* rows = nodes.row_list(s);
    const auto place = std::lower_bound(rows, rows + nodes.row_count(s), last) - rows;
    return panel_begin_[s] + static_cast<std::size_t>(first - nodes.first[s]) * nodes.row_count(s) +
           static_cast<std::size_t>(place);
}

template <typename Visit>
void SparseCholesky::find_slots(const SparseMatrix& lower, const Visit& visit) const {
    for_ranges(static_cast<int>(lower.cols()), coarse_grain, [&](int first, int last) {
        for (int j = first; j < last; ++j) {
            for (int k = lower.outerIndexPtr()[j]; k < lower.outerIndexPtr()[j + 1]; ++k)
                visit(k, slot_of(lower.innerIndexPtr()[k], j));
        }
    });
}

// The panels are not made before: what is analysed beside other work leaves that the room.
void SparseCholesky::scatter(const SparseMatrix& lower) {
    const auto size = static_cast<Eigen::Index>(panel_begin_.back());
    kept_ == Kept::doubles ? panels_.resize(size) : singles_.resize(size);
    const double* values = lower.valuePtr();
    const auto clear = [&](auto* panels) {
        for_ranges(tree_.nodes().size(), fine_grain, [&](int first, int last) {
            for (int s = first; s < last; ++s) panel(panels, s).setZero();
        });
    };
    if (kept_ == Kept::singles) {
        clear(singles_.data());
        find_slots(lower, [&](int k, std::size_t slot) { singles_.data()[slot] = static_cast<float>(values[k]); });
        return;
    }
    clear(panels_.data());
    for_ranges(static_cast<int>(lower.nonZeros()), 8 * coarse_grain, [&](int first, int last) {
        for (int k = first; k < last; ++k) panels_.data()[entry_slot_[k]] = values[k];
    });
}

bool SparseCholesky::factorise(const SparseMatrix& lower, const char* what, const Progress& progress) {
    progress.report(0.0, what);
    read(lower);
    return eliminate_all(what, progress);
}

bool SparseCholesky::factorise(SparseMatrix&& lower, const char* what, const Progress& progress) {
    progress.report(0.0, what);
    read(lower);
    SparseMatrix().swap(lower);
    return eliminate_all(what, progress);
}

void SparseCholesky::read(const SparseMatrix& lower) {
    if (!analysed_) analyse_pattern(lower);
    scatter(lower);
}

bool SparseCholesky::eliminate_all(const char* what, const Progress& progress) {
    return kept_ == Kept::doubles ? eliminate_all(panels_.data(), what, progress)
                                  : eliminate_all(singles_.data(), what, progress);
}

template <typename Stored>
bool SparseCholesky::eliminate_all(Stored* panels, const char* what, const Progress& progress) {
    SharedProgress shared(progress, what, tree_.total_work());
    const WorkDone work_done = [&](double operations) { shared.add(operations); };
    FrontElimination<Stored> elimination(tree_);
    const auto eliminate = [&](int s) { return elimination.eliminate(s, panel(panels, s), work_done); };
    std::atomic<bool> positive = true;
    run_pieces(static_cast<int>(tree_.subtrees().size()), [&](int k) {
        const Subtree& part = tree_.subtrees()[k];
        for (int s = part.begin; s < part.end && positive; ++s) {
            if (!eliminate(s)) positive = false;
        }
    });
    for (int s : tree_.top()) positive = positive && eliminate(s);
    return positive;
}

FrontReach SparseCholesky::reach(const Indices& rows) const {
    Indices positions;
    for (int row : rows) positions.push_back(position_[row]);
    return {tree_, positions};
}

template <typename Visit>
auto SparseCholesky::with_panels(const Visit& visit) const {
    return kept_ == Kept::doubles ? visit(panels_.data()) : visit(singles_.data());
}

VectorX SparseCholesky::solve_vector(const VectorX& rhs, const FrontReach& from, const FrontReach& to) const {
    VectorX result(rhs.size());
    with_panels([&](const auto* panels) {
        using Stored = std::remove_const_t<std::remove_pointer_t<decltype(panels)>>;
        using Vector = Eigen::Vector<Stored, Eigen::Dynamic>;
        using Rows = Eigen::Map<Vector>;
        // Single precision overflows where right sides aren't scaled.
        constexpr bool is_exact = std::is_same_v<Stored, double>;
        // In units of its own, far from the limits of single precision.
        const double unit = is_exact ? 1.0 : std::max(rhs.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
        Vector x(rhs.size());
        for_ranges(static_cast<int>(rhs.size()), coarse_grain, [&](int begin, int end) {
            for (int k = begin; k < end; ++k) x[k] = static_cast<Stored>(rhs[order_[k]] / unit);
        });
        const auto up = [&](int s, Rows& b) { eliminate<1>(panel(panels, s), b.data()); };
        const auto down = [&](int s, Rows& b) { substitute<1>(panel(panels, s), b.data()); };
        const FrontSweeps sweeps{up, down};
        TreeSolve<Vector, decltype(sweeps)> solve(tree_, sweeps, x);
        solve.up(from);
        solve.down(to);
        for_ranges(static_cast<int>(rhs.size()), coarse_grain, [&](int begin, int end) {
            for (int k = begin; k < end; ++k) result[order_[k]] = unit * static_cast<double>(x[k]);
        });
    });
    return result;
}

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& rhs) const {
    Eigen::MatrixXd x(rhs.rows(), rhs.cols());
    for (Eigen::Index k = 0; k < rhs.cols(); ++k) x.col(k) = solve_vector(rhs.col(k));
    return x;
}

template <typename Stored>
Points SparseCholesky::solve_side_by_side(const Stored* panels, const Points& rhs) const {
    using Field = Eigen::Matrix<Stored, Eigen::Dynamic, lanes, Eigen::RowMajor>;
    using Rows = Eigen::Map<Field>;
    const int count = static_cast<int>(rhs.cols());
    Field x(count, lanes);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int k = begin; k < end; ++k) x.row(k) << rhs.col(order_[k]).cast<Stored>().transpose(), Stored(0);
    });
    const auto up = [&](int s, Rows& b) { eliminate<lanes>(panel(panels, s), b.data()); };
    const auto down = [&](int s, Rows& b) { substitute<lanes>(panel(panels, s), b.data()); };
    const FrontSweeps sweeps{up, down};
    TreeSolve<Field, decltype(sweeps)> solve(tree_, sweeps, x);
    solve.up(FrontReach());
    solve.down(FrontReach());
    Points result(3, count);
    for_ranges(count, coarse_grain, [&](int begin, int end) {
        for (int k = begin; k < end; ++k)
            result.col(order_[k]) = x.row(k).template head<3>().transpose().template cast<double>();
    });
    return result;
}

Points SparseCholesky::solve_points(const Points& rhs) const {
    return with_panels([&](const auto* panels) { return solve_side_by_side(panels, rhs); });
}

}  // namespace fairing
