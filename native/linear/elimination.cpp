#include "linear/elimination.h"

#include <cstdint>

#include <Eigen/OrderingMethods>

#include "base/progress.h"
#include "linear/limits.h"

namespace fairing {

namespace {

// For each column of the permuted matrix the entries above the diagonal (row lists of the lower triangle), flat.
struct UpperPattern {
    Indices begin;
    Indices rows;
};

UpperPattern upper_pattern(const SparseMatrix& lower, const Indices& position) {
    const int n = static_cast<int>(lower.cols());
    UpperPattern upper{Indices(n + 1, 0), {}};
    const auto visit = [&](auto action) {
        for (int j = 0; j < n; ++j) {
            checkpoint(j);
            for (SparseMatrix::InnerIterator entry(lower, j); entry; ++entry) {
                const int a = position[static_cast<int>(entry.row())];
                const int b = position[j];
                if (a != b) action(std::min(a, b), std::max(a, b));
            }
        }
    };
    visit([&](int, int column) { ++upper.begin[column + 1]; });
    std::partial_sum(upper.begin.begin(), upper.begin.end(), upper.begin.begin());
    upper.rows.resize(upper.begin.back());
    Indices cursor(upper.begin.begin(), upper.begin.end());
    visit([&](int row, int column) { upper.rows[cursor[column]++] = row; });
    return upper;
}

Indices invert(const Indices& order) {
    Indices position(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = static_cast<int>(k);
    return position;
}

// Liu's algorithm with path compression.
Indices elimination_tree(const UpperPattern& upper) {
    const int n = static_cast<int>(upper.begin.size()) - 1;
    Indices parent(n, none);
    Indices ancestor(n, none);
    for (int j = 0; j < n; ++j) {
        checkpoint(j);
        for (int p = upper.begin[j]; p < upper.begin[j + 1]; ++p) {
            int i = upper.rows[p];
            while (i != none && i < j) {
                const int next = ancestor[i];
                ancestor[i] = j;
                if (next == none) parent[i] = j;
                i = next;
            }
        }
    }
    return parent;
}

Indices postorder(const Indices& parent) {
    const int n = static_cast<int>(parent.size());
    Indices head(n, none);
    Indices next(n, none);
    for (int j = n - 1; j >= 0; --j) {
        if (parent[j] == none) continue;
        next[j] = head[parent[j]];
        head[parent[j]] = j;
    }
    Indices order;
    order.reserve(n);
    Indices stack;
    for (int root = 0; root < n; ++root) {
        if (parent[root] != none) continue;
        stack.push_back(root);
        while (!stack.empty()) {
            const int j = stack.back();
            const int child = head[j];
            if (child == none) {
                order.push_back(j);
                stack.pop_back();
            } else {
                head[j] = next[child];
                stack.push_back(child);
            }
        }
    }
    return order;
}

// Entries of each column of the factor, the diagonal included: row i fills the paths from its entries up to i.
Indices column_counts(const UpperPattern& upper, const Indices& parent) {
    const int n = static_cast<int>(parent.size());
    Indices counts(n, 1);
    Indices mark(n, none);
    for (int i = 0; i < n; ++i) {
        checkpoint(i);
        mark[i] = i;
        for (int p = upper.begin[i]; p < upper.begin[i + 1]; ++p) {
            for (int j = upper.rows[p]; mark[j] != i; j = parent[j]) {
                mark[j] = i;
                ++counts[j];
            }
        }
    }
    return counts;
}

// A supernode during merging.
struct Group {
    int first;
    int columns;
    std::int64_t zeros;  // explicit zeros in its panel
};

// Whether a supernode may take in the one just before it, its last child, at the price of explicit zeros.
// Large factors have no room for many.
bool worth_merging(std::int64_t columns, std::int64_t zeros, std::int64_t entries, int order) {
    if (columns <= 4) return true;
    const double share = static_cast<double>(zeros) / static_cast<double>(entries);
    if (columns <= 16) return share < (order < large_order ? 0.6 : 0.3);
    if (columns <= 48) return share < 0.12;
    return share < 0.05;
}

// Contiguous columns whose structures (nearly) nest. `counts` are those of single columns.
Indices supernode_starts(const Indices& parent, const Indices& counts) {
    const int n = static_cast<int>(parent.size());
    std::vector<Group> groups;
    const auto panel = [&](std::int64_t columns, int last) {
        return columns * (columns + 1) / 2 + columns * (counts[last] - 1);
    };
    for (int j = 0; j < n; ++j) {
        groups.push_back({j, 1, 0});
        while (groups.size() > 1) {
            const Group& upper = groups.back();
            const Group& lower = groups[groups.size() - 2];
            const int lower_last = upper.first - 1;
            // Only while `upper` still ends at j may it grow downwards; its last child must be `lower`.
            if (parent[lower_last] < upper.first || parent[lower_last] > j) break;
            const int columns = lower.columns + upper.columns;
            const std::int64_t own =
                panel(lower.columns, lower_last) - lower.zeros + panel(upper.columns, j) - upper.zeros;
            const std::int64_t zeros = panel(columns, j) - own;
            if (zeros > 0 && !worth_merging(columns, zeros, panel(columns, j), n)) break;
            groups[groups.size() - 2] = {lower.first, columns, zeros};
            groups.pop_back();
        }
    }
    Indices starts;
    for (const Group& group : groups) starts.push_back(group.first);
    starts.push_back(n);
    return starts;
}

void link_supernodes(const Indices& parent, Supernodes& supernodes) {
    const int n = static_cast<int>(parent.size());
    supernodes.column_to_supernode.resize(n);
    for (int s = 0; s < supernodes.size(); ++s) {
        for (int j = supernodes.first[s]; j < supernodes.first[s + 1]; ++j) {
            supernodes.column_to_supernode[j] = s;
        }
    }
    for (int s = 0; s < supernodes.size(); ++s) {
        const int above = parent[supernodes.first[s + 1] - 1];
        supernodes.parent.push_back(above == none ? none : supernodes.column_to_supernode[above]);
    }
}

// Row structures, children first: own columns, entries of the matrix below them, what children pass on.
void fill_rows(const UpperPattern& upper, Supernodes& supernodes) {
    const int n = static_cast<int>(supernodes.column_to_supernode.size());
    std::vector<Indices> below(supernodes.size());  // entries of the matrix by the supernode of their column
    for (int i = 0; i < n; ++i) {
        checkpoint(i);
        for (int p = upper.begin[i]; p < upper.begin[i + 1]; ++p) {
            Indices& list = below[supernodes.column_to_supernode[upper.rows[p]]];
            if (list.empty() || list.back() != i) list.push_back(i);
        }
    }
    std::vector<Indices> passed(supernodes.size());
    Indices mark(n, none);
    supernodes.row_begin = {0};
    for (int s = 0; s < supernodes.size(); ++s) {
        checkpoint(s);
        const int end = supernodes.first[s + 1];
        Indices rows;
        for (const Indices* list : {&below[s], &passed[s]}) {
            for (int i : *list) {
                if (i < end || mark[i] == s) continue;
                mark[i] = s;
                rows.push_back(i);
            }
        }
        std::sort(rows.begin(), rows.end());
        if (supernodes.parent[s] != none) {
            Indices& target = passed[supernodes.parent[s]];
            target.insert(target.end(), rows.begin(), rows.end());
        }
        for (int j = supernodes.first[s]; j < end; ++j) supernodes.rows.push_back(j);
        supernodes.rows.insert(supernodes.rows.end(), rows.begin(), rows.end());
        supernodes.row_begin.push_back(static_cast<int>(supernodes.rows.size()));
        Indices().swap(passed[s]);
        Indices().swap(below[s]);
    }
}

}  // namespace

Indices minimum_degree(const SparseMatrix& lower) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), permutation);
    return {permutation.indices().begin(), permutation.indices().end()};
}

Elimination analyse(const SparseMatrix& lower, const Indices& first_order) {
    Elimination result;
    const Indices first_post = postorder(elimination_tree(upper_pattern(lower, invert(first_order))));
    for (int k : first_post) result.order.push_back(first_order[k]);
    result.position = invert(result.order);
    const UpperPattern upper = upper_pattern(lower, result.position);
    const Indices parent = elimination_tree(upper);
    result.supernodes.first = supernode_starts(parent, column_counts(upper, parent));
    link_supernodes(parent, result.supernodes);
    fill_rows(upper, result.supernodes);
    return result;
}

}  // namespace fairing
