#include "fillet/halved_mesh.h"

#include "base/progress.h"

namespace fairing {

namespace {

constexpr double steepest = 1.5;  // values change by at most that times a length, as widths change by one along it

}  // namespace

HalvedMesh::Key HalvedMesh::key(const Piece& piece, int side) const {
    const auto [low, high] = std::minmax(piece.nodes[side], piece.nodes[(side + 1) % 3]);
    const int edge = piece.edges[side];
    return {low, high, edge != none && sides_[edge] > 2 ? piece.triangle : none};
}

HalvedMesh::HalvedMesh(const SeamMesh& mesh, const SeamDistance& distance, double resolution)
    : mesh_(mesh), distance_(distance) {
    for (const int edge : mesh.edge) {
        if (edge >= std::ssize(sides_)) sides_.resize(edge + 1, 0);
        ++sides_[edge];
    }
    Indices node_of(mesh.sheet_count, none);
    for (int t = 0; t < mesh.triangles.cols(); ++t) {
        if (!distance.reaches(t)) continue;
        Piece piece{t, {}, {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()}, {}};
        for (int k = 0; k < 3; ++k) {
            int& node = node_of[mesh.sheet[3 * t + k]];
            const double value = distance.value(t, piece.weights[k]);
            if (node == none) {
                node = static_cast<int>(nodes_.size());
                const int vertex = mesh.triangles(k, t);
                nodes_.push_back(
                    {mesh.points.col(vertex), value, distance.relative_width(t, piece.weights[k]), vertex, none});
            }
            nodes_[node].value = std::min(nodes_[node].value, value);
            piece.nodes[k] = node;
            piece.edges[k] = mesh.edge[3 * t + k];
        }
        pieces_.push_back(piece);
        insert(piece, static_cast<int>(pieces_.size()) - 1);
    }
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
        checkpoint();
        const auto long_and_cut = [&] {
            const Piece& piece = pieces_[p];
            const int side = longest_side(piece);
            const Vector3 offset = nodes_[piece.nodes[side]].place - nodes_[piece.nodes[(side + 1) % 3]].place;
            return offset.norm() > resolution * std::min(nodes_[piece.nodes[side]].size,
                                                         nodes_[piece.nodes[(side + 1) % 3]].size) &&
                   is_cut(piece);
        };
        while (long_and_cut()) halve(static_cast<int>(p));
    }
}

// By length and then by the nodes' numbers, so that both sides of an edge agree.
int HalvedMesh::longest_side(const Piece& piece) const {
    int best = 0;
    std::pair<double, Key> largest{-1.0, {}};
    for (int k = 0; k < 3; ++k) {
        const int a = piece.nodes[k];
        const int b = piece.nodes[(k + 1) % 3];
        const std::pair<double, Key> size{(nodes_[a].place - nodes_[b].place).squaredNorm(), key(piece, k)};
        if (size > largest) {
            largest = size;
            best = k;
        }
    }
    return best;
}

// Whether the line may pass through it.
bool HalvedMesh::is_cut(const Piece& piece) const {
    Vector3 weights = Vector3::Zero();
    Vector3 place = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
        weights += piece.weights[k] / 3.0;
        place += nodes_[piece.nodes[k]].place / 3.0;
    }
    double radius = 0.0;
    for (const int node : piece.nodes) radius = std::max(radius, (nodes_[node].place - place).norm());
    if (distance_.least_value(piece.triangle, weights, radius) > 0.0) return false;
    return distance_.value(piece.triangle, weights) > -steepest * radius;
}

void HalvedMesh::insert(const Piece& piece, int number) {
    for (int k = 0; k < 3; ++k) {
        const auto [place, is_new] = beside_.try_emplace(key(piece, k), std::array<int, 2>{none, none});
        std::array<int, 2>& sides = place->second;
        if (sides[0] == none || sides[0] == number)
            sides[0] = number;
        else
            sides[1] = number;
    }
}

int HalvedMesh::across(int piece, int side) const {
    const auto& sides = beside_.at(key(pieces_[piece], side));
    return sides[0] == piece ? sides[1] : sides[0];
}

// At its longest side, after those across it whose longest side is another one (Rivara 1984).
void HalvedMesh::halve(int piece) {
    Indices path{piece};
    while (!path.empty()) {
        const int last = path.back();
        const int side = longest_side(pieces_[last]);
        const Key own = key(pieces_[last], side);
        const int other = across(last, side);
        if (other != none && key(pieces_[other], longest_side(pieces_[other])) != own) {
            path.push_back(other);
            continue;
        }
        split(own);
        path.pop_back();
        if (last == piece) return;
    }
}

void HalvedMesh::split(const Key& side) {
    const auto found = beside_.find(side);
    const std::array<int, 2> sides = found->second;
    beside_.erase(found);
    const int node = static_cast<int>(nodes_.size());
    nodes_.push_back({0.5 * (nodes_[side[0]].place + nodes_[side[1]].place), 1.0, 1.0, none, none});
    bool first = true;
    for (const int p : sides) {
        if (p == none) continue;
        const Piece whole = pieces_[p];
        int k = 0;
        while (key(whole, k) != side) ++k;
        const int next = (k + 1) % 3;
        const int last = (k + 2) % 3;
        const Vector3 weights = 0.5 * (whole.weights[k] + whole.weights[next]);
        const double value = distance_.value(whole.triangle, weights);
        nodes_[node].value = first ? value : std::min(value, nodes_[node].value);
        nodes_[node].size = distance_.relative_width(whole.triangle, weights);
        nodes_[node].edge = whole.edges[k];
        first = false;
        Piece& kept = pieces_[p];
        kept.nodes[next] = node;
        kept.weights[next] = weights;
        kept.edges[next] = none;
        Piece added = whole;
        added.nodes[k] = node;
        added.weights[k] = weights;
        added.edges[last] = none;
        const int number = static_cast<int>(pieces_.size());
        for (int& owner : beside_.at(key(whole, next))) {
            if (owner == p) owner = number;
        }
        const Piece half = kept;
        pieces_.push_back(added);
        insert(half, p);
        insert(added, number);
    }
}

void HalvedMesh::snap(double vertices, double others) {
    for (Node& node : nodes_) {
        if (std::abs(node.value) <= (node.vertex == none ? others : vertices) * node.size) node.value = 0.0;
    }
}

}  // namespace fairing
