// The tree of fronts of a multifrontal factorisation: which adds to which, and which parts are independent of each
// other (Liu 1992).
#pragma once

#include "linear/elimination.h"

namespace fairing {

// Supernodes begin … end − 1, the last one their root: independent of all other subtrees.
struct Subtree {
    int begin;
    int end;
    double work;  // operations, roughly
    [[nodiscard]] int root() const { return end - 1; }
};

class FrontTree {
public:
    FrontTree() = default;
    explicit FrontTree(Supernodes supernodes);

    [[nodiscard]] const Supernodes& nodes() const { return nodes_; }
    [[nodiscard]] std::span<const int> children(int supernode) const;
    // The rows of a supernode's columns of the factor below its own.
    [[nodiscard]] std::span<const int> below(int supernode) const;
    // Their places in the row list of the parent.
    [[nodiscard]] std::span<const int> below_in_parent(int supernode) const;
    // Their places among the rows below the root of the subtree, `none` within the subtree and above all subtrees.
    [[nodiscard]] std::span<const int> below_in_outer(int supernode) const;

    [[nodiscard]] const std::vector<Subtree>& subtrees() const { return subtrees_; }  // heaviest first
    [[nodiscard]] const Indices& top() const { return top_; }  // the supernodes above them, children first
    [[nodiscard]] double total_work() const { return total_work_; }

private:
    void list_children();
    void relate_rows();
    std::vector<Subtree> measure_subtrees();
    void split();
    void number_outer_rows(const Subtree& tree);
    [[nodiscard]] std::span<const int> of_below(const Indices& values, int supernode) const;

    Supernodes nodes_;
    Indices children_begin_;
    Indices children_;
    Indices below_begin_;  // of the lists below, all supernodes one after the other
    Indices below_in_parent_;
    Indices below_in_outer_;
    std::vector<Subtree> subtrees_;
    Indices top_;
    double total_work_ = 0.0;
};

}  // namespace fairing
