#include "fillet/seam_sides.h"

#include <map>

namespace fairing {

namespace {

constexpr double equal_areas = 1e-9;  // relative: parts that a rotation turns into each other, but for roundoff

// Turns seams that no part decides on so that chains of them run on.
void run_on(std::vector<VertexPair>& seams, std::vector<char>& labelled) {
    std::multimap<int, int> at;
    for (int s = 0; s < static_cast<int>(seams.size()); ++s) {
        if (labelled[s] != 0) continue;
        for (const int v : seams[s]) at.emplace(v, s);
    }
    for (int first = 0; first < static_cast<int>(seams.size()); ++first) {
        if (labelled[first] != 0) continue;
        labelled[first] = 1;
        Indices open{first};
        while (!open.empty()) {
            const int s = open.back();
            open.pop_back();
            for (const std::size_t end : {0U, 1U}) {
                const int v = seams[s][end];
                if (at.count(v) != 2) continue;
                const auto [begin, last] = at.equal_range(v);
                for (auto it = begin; it != last; ++it) {
                    VertexPair& other = seams[it->second];
                    if (labelled[it->second] != 0) continue;
                    labelled[it->second] = 1;
                    if (other[1 - end] != v) std::swap(other[0], other[1]);
                    open.push_back(it->second);
                }
            }
        }
    }
}

}  // namespace

std::vector<VertexPair> directed(const SeamMesh& mesh, const std::vector<VertexPair>& seams) {
    UnionFind parts = mesh.parts();
    std::vector<double> area(static_cast<std::size_t>(mesh.triangles.cols()), 0.0);  // of each part, at its root
    for (int t = 0; t < std::ssize(area); ++t) area[parts.root(t)] += 0.5 * mesh.length[3 * t] * mesh.apex[3 * t][1];
    std::vector<VertexPair> result = seams;
    std::vector<char> labelled(seams.size(), 0);
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] == none || mesh.left[h] == 0 || mesh.twin[h] == none) continue;
        const double here = area[parts.root(h / 3)];
        const double there = area[parts.root(mesh.twin[h] / 3)];
        if (std::abs(here - there) <= equal_areas * (here + there)) continue;
        VertexPair& pair = result[mesh.seam[h]];
        labelled[mesh.seam[h]] = 1;
        if (here < there) std::swap(pair[0], pair[1]);
    }
    run_on(result, labelled);
    return result;
}

}  // namespace fairing
