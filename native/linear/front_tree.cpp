#include "linear/front_tree.h"

#include "base/parallel.h"

namespace fairing {

namespace {

// Subtrees are split until none has more than this share of all operations; a tree of fewer operations stays whole.
constexpr double largest_share = 1.0 / 16.0;
constexpr double least_split = 2e6;

}  // namespace

FrontTree::FrontTree(Supernodes supernodes) : nodes_(std::move(supernodes)) {
    list_children();
    relate_rows();
    split();
}

std::span<const int> FrontTree::children(int s) const {
    const int begin = children_begin_[s];
    return {children_.data() + begin, static_cast<std::size_t>(children_begin_[s + 1] - begin)};
}

std::span<const int> FrontTree::below(int s) const {
    const int own = nodes_.column_count(s);
    return {nodes_.row_list(s) + own, static_cast<std::size_t>(nodes_.row_count(s) - own)};
}

std::span<const int> FrontTree::of_below(const Indices& values, int s) const {
    const int begin = below_begin_[s];
    return {values.data() + begin, static_cast<std::size_t>(below_begin_[s + 1] - begin)};
}

std::span<const int> FrontTree::below_in_parent(int s) const { return of_below(below_in_parent_, s); }

std::span<const int> FrontTree::below_in_outer(int s) const { return of_below(below_in_outer_, s); }

void FrontTree::list_children() {
    children_begin_.assign(nodes_.size() + 1, 0);
    for (int p : nodes_.parent) {
        if (p != none) ++children_begin_[p + 1];
    }
    for (std::size_t s = 1; s < children_begin_.size(); ++s) children_begin_[s] += children_begin_[s - 1];
    children_.resize(children_begin_.back());
    Indices cursor(children_begin_.begin(), children_begin_.end());
    for (int s = 0; s < nodes_.size(); ++s) {
        if (nodes_.parent[s] != none) children_[cursor[nodes_.parent[s]]++] = s;
    }
}

// Both lists are sorted, and the parent's holds all rows below its child.
void FrontTree::relate_rows() {
    below_begin_ = {0};
    for (int s = 0; s < nodes_.size(); ++s)
        below_begin_.push_back(below_begin_.back() + static_cast<int>(below(s).size()));
    below_in_parent_.assign(below_begin_.back(), none);
    for_ranges(nodes_.size(), coarse_grain, [&](int first, int last) {
        for (int s = first; s < last; ++s) {
            if (nodes_.parent[s] == none) continue;
            const int* const rows = nodes_.row_list(nodes_.parent[s]);
            const int* row = rows;
            auto place = below_in_parent_.begin() + below_begin_[s];
            for (int wanted : below(s)) {
                while (*row != wanted) ++row;
                *place++ = static_cast<int>(row - rows);
            }
        }
    });
}

// The subtree of each supernode.
std::vector<Subtree> FrontTree::measure_subtrees() {
    std::vector<Subtree> trees;
    for (int s = 0; s < nodes_.size(); ++s) {
        const double rows = nodes_.row_count(s);
        Subtree tree{s, s + 1, rows * rows * nodes_.column_count(s)};
        total_work_ += tree.work;
        for (int c : children(s)) {
            tree.begin = std::min(tree.begin, trees[c].begin);
            tree.work += trees[c].work;
        }
        trees.push_back(tree);
    }
    return trees;
}

void FrontTree::split() {
    const std::vector<Subtree> trees = measure_subtrees();
    Indices open;
    for (int s = 0; s < nodes_.size(); ++s) {
        if (nodes_.parent[s] == none) open.push_back(s);
    }
    const double largest = total_work_ < least_split ? total_work_ : largest_share * total_work_;
    while (!open.empty()) {
        const int root = open.back();
        open.pop_back();
        if (trees[root].work <= largest) {
            subtrees_.push_back(trees[root]);
        } else {
            top_.push_back(root);
            open.insert(open.end(), children(root).begin(), children(root).end());
        }
    }
    std::sort(top_.begin(), top_.end());
    std::stable_sort(subtrees_.begin(), subtrees_.end(),
                     [](const Subtree& a, const Subtree& b) { return a.work > b.work; });
    below_in_outer_.assign(below_in_parent_.size(), none);
    run_pieces(static_cast<int>(subtrees_.size()), [&](int k) { number_outer_rows(subtrees_[k]); });
}

// A coupling outside its subtree is one of the root, too.
void FrontTree::number_outer_rows(const Subtree& tree) {
    const auto outer = below(tree.root());
    const int inner_end = nodes_.first[tree.end];
    for (int s = tree.begin; s < tree.end; ++s) {
        auto place = below_in_outer_.begin() + below_begin_[s];
        for (int row : below(s)) {
            if (row >= inner_end)
                *place = static_cast<int>(std::lower_bound(outer.begin(), outer.end(), row) - outer.begin());
            ++place;
        }
    }
}

}  // namespace fairing
