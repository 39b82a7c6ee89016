#include "fillet/row_pieces.h"

namespace fairing {

namespace {

constexpr double end_room = 0.4;  // of the width: so long are the triangles between the last column and others

}  // namespace

void RowPieces::lay() {
    strip_.triangles.clear();
    strip_.edges.clear();
    surface_.leave(owner_);
    if (strip_.closed) return add(columns_.columns(strip_, strip_.first_pair(), strip_.last_pair()));
    lay({{strip_.first_pair(), strip_.last_pair()}, strip_.ends});
}

void RowPieces::lay(Piece piece) {
    const auto [first, last] = bounds(piece);
    std::array<Indices, 2> walls;
    for (const int which : {0, 1}) {
        if (is_whole_wall(piece, which)) walls[which] = strip_.walls[which];
    }
    const std::vector<Column> columns = columns_.columns(strip_, first, last, walls);
    add(columns);
    for (const int which : {0, 1}) {
        const Column& end = which == 0 ? columns.front() : columns.back();
        if (piece.ends[which] == RowEnd::corner) strip_.last[which] = end;
        if (add_end(end, piece, which)) continue;
        strip_.triangles.clear();
        strip_.edges.clear();
        if (piece.ends[which] == RowEnd::open) piece.outer[which] = end.at;  // further in
        piece.ends[which] = RowEnd::open;
        return lay(piece);
    }
}

void RowPieces::add(const std::vector<Column>& columns) {
    strip_.quads.clear();
    for (std::size_t k = 0; k + 1 < columns.size(); ++k) add_quads({columns[k].ids, columns[k + 1].ids}, strip_.quads);
    if (!surface_.are_good(strip_.quads)) throw NoRows();
}

bool RowPieces::is_whole_wall(const Piece& piece, int which) const {
    return piece.ends[which] == RowEnd::wall && std::ssize(strip_.walls[which]) == rows_ + 1;
}

// The bounds at the first and the last column: away from where rows end, which is straight across.
std::array<Pair, 2> RowPieces::bounds(Piece& piece) const {
    std::array<Pair, 2> found = piece.outer;
    const auto station = [&](std::size_t which, Side side) {
        return strip_.sides[side].stations[piece.outer[which][side]];
    };
    const double begin = std::max(station(0, right), station(0, left));
    const double end = std::min(station(1, right), station(1, left));
    const double room = end_room * strip_.width;
    const auto ends = [&](int which) { return piece.ends[which] != RowEnd::corner && !is_whole_wall(piece, which); };
    for (const Side side : {right, left}) {
        const std::vector<double>& stations = strip_.sides[side].stations;
        const auto up_to = [&](double to) {
            return static_cast<int>(std::upper_bound(stations.begin(), stations.end(), to) - stations.begin()) - 1;
        };
        const auto from = [&](double at) {
            return static_cast<int>(std::lower_bound(stations.begin(), stations.end(), at) - stations.begin());
        };
        if (piece.ends[0] == RowEnd::open) piece.outer[0][side] = std::max(piece.outer[0][side], up_to(begin));
        if (piece.ends[1] == RowEnd::open) piece.outer[1][side] = std::min(piece.outer[1][side], from(end));
        if (ends(0)) found[0][side] = std::max(piece.outer[0][side] + 1, from(begin + room));
        if (ends(1)) found[1][side] = std::min(piece.outer[1][side] - 1, up_to(end - room));
    }
    if (found[0][right] >= found[1][right] || found[0][left] >= found[1][left]) throw NoRows();
    return found;
}

// From the right to the left, from the last column out, over, and back.
Indices RowPieces::beyond(const Column& last, const Piece& piece, int which, const Indices& path) const {
    const int step = which == 0 ? -1 : 1;
    Indices far;
    for (int k = last.at[right]; k != piece.outer[which][right]; k += step)
        far.push_back(strip_.sides[right].vertices[k]);
    far.insert(far.end(), path.begin(), path.end());
    for (int k = piece.outer[which][left]; k != last.at[left];) {
        k -= step;
        far.push_back(strip_.sides[left].vertices[k]);
    }
    return far;
}

// Triangles from the last column to a wall, or to the surface's that stay; false where none fit.
bool RowPieces::add_end(const Column& last, const Piece& piece, int which) {
    if (piece.ends[which] == RowEnd::corner || is_whole_wall(piece, which)) return true;
    const Pair& outer = piece.outer[which];
    const bool is_open = piece.ends[which] == RowEnd::open;
    const Indices path = is_open ? surface_.path_within(strip_.sides[right].vertices[outer[right]],
                                                        strip_.sides[left].vertices[outer[left]])
                                 : strip_.walls[which];
    const Indices far = beyond(last, piece, which, path);
    const std::vector<Eigen::Vector3i> made = which == 0 ? surface_.zip(last.ids, far) : surface_.zip(far, last.ids);
    if (made.empty()) return false;
    strip_.triangles.insert(strip_.triangles.end(), made.begin(), made.end());
    if (!is_open) return true;
    surface_.take(path, owner_);
    for (std::size_t k = 0; k + 1 < path.size(); ++k) strip_.edges.push_back({path[k], path[k + 1]});
    return true;
}

}  // namespace fairing
