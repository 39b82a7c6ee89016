#include "fillet/eaten_parts.h"

#include <map>
#include <set>

#include "base/progress.h"

namespace fairing {

namespace {

constexpr double accuracy = 0.01;  // of the widest fillet: nobody sets a width more finely

struct Piece {
    int triangle;
    std::array<Vector3, 3> weights;
};

double radius(const SeamMesh& mesh, const Piece& piece, const Vector3& middle) {
    double result = 0.0;
    for (const Vector3& corner : piece.weights)
        result = std::max(result, (mesh.place(piece.triangle, corner) - mesh.place(piece.triangle, middle)).norm());
    return result;
}

// Distances change by no more than one moves: pieces that can't hold the largest one, or none above `thin`, are left,
// the others are quartered.
double farthest(const SeamMesh& mesh, const SeamDistance& distance, const Indices& triangles, double thin) {
    double best = 0.0;
    std::vector<Piece> open;
    for (const int t : triangles) open.push_back({t, {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()}});
    while (!open.empty()) {
        checkpoint();
        std::vector<Piece> next;
        for (const Piece& piece : open) {
            const auto& [a, b, c] = piece.weights;
            const Vector3 middle = (a + b + c) / 3.0;
            const double found = distance.reaches(piece.triangle) ? distance.at(piece.triangle, middle).distance : 0.0;
            best = std::max(best, found);
            if (found + radius(mesh, piece, middle) <= std::max((1.0 + accuracy) * best, thin)) continue;
            const Vector3 ab = 0.5 * (a + b);
            const Vector3 bc = 0.5 * (b + c);
            const Vector3 ca = 0.5 * (c + a);
            for (const auto& quarter : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
                next.push_back({piece.triangle, quarter});
        }
        open = std::move(next);
    }
    return best;
}

}  // namespace

std::vector<EatenPart> eaten_parts(const SeamMesh& mesh, const SeamDistance& distance, const SplitMesh& cut,
                                   double thin) {
    UnionFind parts = mesh.parts();
    std::set<int> open;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.twin[h] == none) open.insert(parts.root(h / 3));
    }
    for (std::size_t t = 0; t < cut.parent.size(); ++t) {
        if (cut.inside[t] == 0) open.insert(parts.root(cut.parent[t]));
    }
    std::map<int, Indices> eaten;
    for (int t = 0; t < mesh.triangles.cols(); ++t) {
        if (!open.contains(parts.root(t))) eaten[parts.root(t)].push_back(t);
    }
    std::map<int, double> widest;
    for (const auto& [part, triangles] : eaten) widest[part] = farthest(mesh, distance, triangles, thin);
    std::map<int, std::set<int>> beside;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] == none || mesh.twin[h] == none) continue;
        beside[parts.root(h / 3)].insert(parts.root(mesh.twin[h] / 3));
    }
    std::vector<EatenPart> result;
    for (const auto& [part, triangles] : eaten) {
        if (widest.at(part) <= thin) continue;
        std::set<int> vertices;
        for (const int t : triangles) {
            for (const int v : mesh.triangles.col(t)) vertices.insert(v);
        }
        const auto is_left = [&](int other) { return !widest.contains(other) || widest.at(other) <= thin; };
        const auto& around = beside[part];
        const auto left = std::count_if(around.begin(), around.end(), [&](int other) { return open.contains(other); });
        result.push_back({{vertices.begin(), vertices.end()},
                          widest.at(part),
                          left > 1 && std::all_of(around.begin(), around.end(), is_left)});
    }
    return result;
}

}  // namespace fairing
