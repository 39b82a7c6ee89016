// Disjoint sets with an optional parity between members (used for windings).
#pragma once

#include "base/types.h"

namespace fairing {

class UnionFind {
public:
    explicit UnionFind(int size) : parent_(static_cast<std::size_t>(size)), parity_(static_cast<std::size_t>(size), 0) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    // The set's representative, and whether `item` has the opposite parity to it.
    std::pair<int, bool> find(int item) {
        const int above = parent_[item];
        if (parent_[above] == above) return {above, parity_[item] != 0};  // the usual case; a root's own parity is none
        int root = item;
        bool flipped = false;
        while (parent_[root] != root) {
            flipped ^= parity_[root] != 0;
            root = parent_[root];
        }
        compress(item, root, flipped);
        return {root, flipped};
    }

    int root(int item) { return find(item).first; }

    // Joins the sets of a and b; `opposite`: their parities differ. False where they were joined already and disagree.
    bool join(int a, int b, bool opposite = false) {
        auto [root_a, flipped_a] = find(a);
        auto [root_b, flipped_b] = find(b);
        const bool relative = (flipped_a != flipped_b) != opposite;
        if (root_a == root_b) return !relative;
        // The smaller index leads, so that the outcome does not depend on the order of the calls.
        if (root_a > root_b) std::swap(root_a, root_b);
        parent_[root_b] = root_a;
        parity_[root_b] = relative ? 1 : 0;
        return true;
    }

private:
    void compress(int item, int root, bool flipped) {
        while (item != root) {
            const int next = parent_[item];
            const bool own = parity_[item] != 0;
            parent_[item] = root;
            parity_[item] = flipped ? 1 : 0;
            flipped ^= own;
            item = next;
        }
    }

    Indices parent_;
    std::vector<char> parity_;
};

}  // namespace fairing
