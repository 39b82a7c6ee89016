#include "mesh/edges.h"

#include "base/limits.h"
#include "base/progress.h"

namespace fairing {

namespace {

struct Entry {
    int high;
    int side;
};

// visit(side, lower end, higher end)
template <typename Visit>
void for_each_side(const Triangles& triangles, const Visit& visit) {
    for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) {
        checkpoint(t);
        for (int k = 0; k < 3; ++k) {
            const int tail = triangles(k, t);
            const int head = triangles(k == 2 ? 0 : k + 1, t);
            visit(3 * t + k, std::min(tail, head), std::max(tail, head));
        }
    }
}

// Sides bucketed by their smaller vertex: one pass of counting sort, linear in the number of triangles. Those of a
// bucket as they are numbered.
std::vector<Entry> bucket_sides(const Triangles& triangles, Indices& bucket_begin) {
    for_each_side(triangles, [&](int, int low, int) { ++bucket_begin[low + 1]; });
    for (std::size_t v = 1; v < bucket_begin.size(); ++v) bucket_begin[v] += bucket_begin[v - 1];
    std::vector<Entry> entries(static_cast<std::size_t>(triangles.size()));
    Indices cursor(bucket_begin.begin(), bucket_begin.end());
    for_each_side(triangles, [&](int side, int low, int high) { entries[cursor[low]++] = {high, side}; });
    return entries;
}

// Sorts the few sides of a bucket by their larger vertex, stably.
void sort_bucket(Entry* first, Entry* last) {
    const auto is_less = [](const Entry& a, const Entry& b) { return a.high < b.high; };
    if (last - first > one_by_one) {
        std::stable_sort(first, last, is_less);
        return;
    }
    for (Entry* next = first; next != last; ++next) {
        const Entry entry = *next;
        Entry* place = next;
        for (; place != first && is_less(entry, *(place - 1)); --place) *place = *(place - 1);
        *place = entry;
    }
}

}  // namespace

EdgeTable make_edges(const Triangles& triangles, int vertex_count) {
    Indices bucket_begin(static_cast<std::size_t>(vertex_count) + 1, 0);
    std::vector<Entry> entries = bucket_sides(triangles, bucket_begin);
    EdgeTable table;
    table.edge_of_side.resize(entries.size());
    table.sides.reserve(entries.size());
    table.ends.reserve(entries.size() / 2 + 16);
    table.begin.reserve(entries.size() / 2 + 17);
    for (int low = 0; low < vertex_count; ++low) {
        checkpoint(low);
        Entry* const first = entries.data() + bucket_begin[low];
        Entry* const last = entries.data() + bucket_begin[low + 1];
        sort_bucket(first, last);
        for (const Entry* entry = first; entry != last; ++entry) {
            if (entry == first || entry->high != (entry - 1)->high) {
                table.begin.push_back(static_cast<int>(table.sides.size()));
                table.ends.push_back({low, entry->high});
            }
            table.edge_of_side[entry->side] = table.size() - 1;
            table.sides.push_back(entry->side);
        }
    }
    table.begin.push_back(static_cast<int>(table.sides.size()));
    return table;
}

}  // namespace fairing
