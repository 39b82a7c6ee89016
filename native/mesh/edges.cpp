#include "mesh/edges.h"

#include <algorithm>

#include "base/progress.h"

namespace fairing {

namespace {

struct Entry {
    int high;
    int side;
};

// Sides bucketed by their smaller vertex: one pass of counting sort, linear in the number of triangles.
std::vector<Entry> bucket_sides(const Triangles& triangles, Indices& bucket_begin) {
    const int side_count = 3 * static_cast<int>(triangles.cols());
    for (int s = 0; s < side_count; ++s) {
        const int low = std::min(side_tail(triangles, s), side_head(triangles, s));
        ++bucket_begin[static_cast<std::size_t>(low) + 1];
    }
    for (std::size_t v = 1; v < bucket_begin.size(); ++v) bucket_begin[v] += bucket_begin[v - 1];
    std::vector<Entry> entries(static_cast<std::size_t>(side_count));
    Indices cursor(bucket_begin.begin(), bucket_begin.end());
    for (int s = 0; s < side_count; ++s) {
        checkpoint(s);
        const int low = std::min(side_tail(triangles, s), side_head(triangles, s));
        const int high = std::max(side_tail(triangles, s), side_head(triangles, s));
        entries[static_cast<std::size_t>(cursor[static_cast<std::size_t>(low)]++)] = {high, s};
    }
    return entries;
}

}  // namespace

EdgeTable make_edges(const Triangles& triangles, int vertex_count) {
    Indices bucket_begin(static_cast<std::size_t>(vertex_count) + 1, 0);
    std::vector<Entry> entries = bucket_sides(triangles, bucket_begin);
    EdgeTable table;
    table.edge_of_side.resize(entries.size());
    table.sides.reserve(entries.size());
    for (int low = 0; low < vertex_count; ++low) {
        checkpoint(low);
        const auto first = entries.begin() + bucket_begin[static_cast<std::size_t>(low)];
        const auto last = entries.begin() + bucket_begin[static_cast<std::size_t>(low) + 1];
        std::sort(first, last,
                  [](const Entry& a, const Entry& b) { return a.high != b.high ? a.high < b.high : a.side < b.side; });
        for (auto entry = first; entry != last; ++entry) {
            if (entry == first || entry->high != (entry - 1)->high) {
                table.begin.push_back(static_cast<int>(table.sides.size()));
                table.ends.push_back({low, entry->high});
            }
            table.edge_of_side[static_cast<std::size_t>(entry->side)] = table.size() - 1;
            table.sides.push_back(entry->side);
        }
    }
    table.begin.push_back(static_cast<int>(table.sides.size()));
    return table;
}

}  // namespace fairing
