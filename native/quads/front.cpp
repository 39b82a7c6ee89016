#include "quads/front.h"

#include <map>
#include <unordered_map>

namespace fairing {

namespace {

constexpr int regular = 4;           // quads around an inner vertex
constexpr double least_soft = 50.0;  // degrees of each quad at a vertex of the boundary that takes more or less of them
constexpr double most_soft = 145.0;  // likewise

struct Hash {
    std::size_t operator()(const Lattice& p) const {
        return static_cast<std::size_t>(static_cast<unsigned>(p.x)) * 0x9E3779B97F4A7C15ULL +
               static_cast<std::size_t>(static_cast<unsigned>(p.y));
    }
};
using Numbers = std::unordered_map<Lattice, int, Hash>;

// The cells inside a simple counter-clockwise polygon, by their lower left corners: along each row of cells sides that
// go down and up take turns.
std::vector<Lattice> cells_within(const std::vector<Lattice>& walk) {
    std::map<int, std::vector<std::pair<int, bool>>> rows;
    for (std::size_t k = 0; k + 1 < walk.size(); ++k) {
        const int step = walk[k + 1].y - walk[k].y;
        if (step != 0) rows[std::min(walk[k].y, walk[k + 1].y)].emplace_back(walk[k].x, step < 0);
    }
    std::vector<Lattice> cells;
    for (auto& [y, sides] : rows) {
        std::sort(sides.begin(), sides.end());
        for (std::size_t k = 0; k + 1 < sides.size(); k += 2) {
            for (int x = sides[k].first; x < sides[k + 1].first; ++x) cells.push_back({x, y});
        }
    }
    return cells;
}

}  // namespace

Lattice Lattice::turned(int quarters) const {
    switch (((quarters % 4) + 4) % 4) {
        case 1: return {-y, x};
        case 2: return {-x, -y};
        case 3: return {y, -x};
        default: return *this;
    }
}

QuadFront::QuadFront(const Indices& faces, const Eigen::Matrix2Xd& places, VectorX angles)
    : angles_(std::move(angles)), faces_(faces), quads_at_(faces) {
    pattern_.boundary_count = pattern_.vertex_count = static_cast<int>(faces.size());
    for (int k = 0; k < pattern_.boundary_count; ++k) {
        vertices_.push_back(k);
        places_.emplace_back(places.col(k));
    }
}

int QuadFront::quarters() const {
    int sum = 0;
    for (const int count : faces_) sum += 2 - count;
    return sum;
}

std::optional<double> QuadFront::cost_of_turning(int at, int quarters) const {
    const int left = faces_[at] - quarters;
    if (left < 1 || left > regular) return std::nullopt;
    if (is_new(at)) return 0.0;
    if (angles_.size() == 0) return std::nullopt;
    const int there = quads_at_[vertices_[at]];
    const double angle = angles_[vertices_[at]] / (there - quarters);
    if (there - quarters < 1 || !(angle <= most_soft && angle >= least_soft)) return std::nullopt;
    const double own = angles_[vertices_[at]];
    return angles_error(own, there - quarters) - angles_error(own, there);
}

std::vector<Lattice> QuadFront::walk() const {
    std::vector<Lattice> result{{0, 0}};
    int heading = 0;
    for (int k = 0; k < size(); ++k) {
        if (k > 0) heading += 2 - faces_[k];
        result.push_back(result.back() + Lattice{1, 0}.turned(heading));
    }
    return result;
}

int QuadFront::new_vertex(const Eigen::Vector2d& place) {
    new_places_.push_back(place);
    return pattern_.vertex_count++;
}

// A position off the walk by its edges' length, at this share of the angle from the next edge to the previous one.
Eigen::Vector2d QuadFront::inwards(int at, double share) const {
    const Eigen::Vector2d next = places_[after(at)] - places_[at];
    const Eigen::Vector2d last = places_[before(at)] - places_[at];
    double angle = std::atan2(next.x() * last.y() - next.y() * last.x(), next.dot(last));
    if (angle <= 0.0) angle += 2.0 * std::numbers::pi;
    const double length = 0.5 * (next.norm() + last.norm());
    const double direction = std::atan2(next.y(), next.x()) + share * angle;
    return places_[at] + length * Eigen::Vector2d(std::cos(direction), std::sin(direction));
}

// Sides of one or two edges between convex corners: their rows from both ends would meet.
bool QuadFront::ring_meets_itself() const {
    for (int k = 0; k < size(); ++k) {
        if (faces_[k] != 1) continue;
        const int next = after(k);
        if (faces_[next] == 1 || (faces_[next] == 2 && faces_[after(next)] == 1)) return true;
    }
    return size() < 6;
}

// The new vertices opposite to the walk's, ordered from the previous edge to the next. Those adjacent to a convex
// corner are one.
QuadFront::Spokes QuadFront::spokes_of_ring(int first_new) {
    Spokes spokes(faces_.size());
    for (int k = 0; k < size(); ++k) {
        for (int j = faces_[k] - 1; j > 0; --j) spokes[k].push_back(new_vertex(inwards(k, double(j) / faces_[k])));
    }
    for (int k = 0; k < size(); ++k) {
        if (faces_[k] != 1) continue;
        const int kept = spokes[before(k)].back();
        spokes[after(k)].front() = kept;
        new_places_[kept - first_new] = places_[before(k)] + places_[after(k)] - places_[k];
    }
    return spokes;
}

bool QuadFront::add_ring() {
    if (ring_meets_itself()) return false;
    const int first_new = pattern_.vertex_count;
    new_places_.clear();
    const Spokes spokes = spokes_of_ring(first_new);
    Indices walk;
    const auto go = [&walk](int vertex) {
        if (walk.empty() || (walk.back() != vertex && walk.front() != vertex)) walk.push_back(vertex);
    };
    for (int k = 0; k < size(); ++k) {
        const int next = after(k);
        if (faces_[k] == 1) {
            pattern_.quads.push_back({vertices_[before(k)], vertices_[k], vertices_[next], spokes[before(k)].back()});
            continue;
        }
        for (std::size_t j = 0; j < spokes[k].size(); ++j) {
            go(spokes[k][j]);
            if (j + 1 == spokes[k].size()) break;
            const auto at = [&](int vertex) { return new_places_[vertex - first_new]; };
            const int far = new_vertex(at(spokes[k][j]) + at(spokes[k][j + 1]) - places_[k]);
            pattern_.quads.push_back({vertices_[k], spokes[k][j + 1], far, spokes[k][j]});
            go(far);
        }
        if (faces_[next] != 1)
            pattern_.quads.push_back({vertices_[k], vertices_[next], spokes[next].front(), spokes[k].back()});
    }
    take(walk, first_new);
    return true;
}

// Continues with this walk of new vertices, numbered as they are used. Each gets as many quads as are missing.
void QuadFront::take(const Indices& vertices, int first_new) {
    Indices faces(static_cast<std::size_t>(pattern_.vertex_count - first_new), regular);
    for (const auto& quad : pattern_.quads) {
        for (const int v : quad) {
            if (v >= first_new) --faces[v - first_new];
        }
    }
    // Merged vertices left their numbers unused.
    Indices number(faces.size(), none);
    int count = first_new;
    for (const int v : vertices) number[v - first_new] = count++;
    for (auto& quad : pattern_.quads) {
        for (int& v : quad) {
            if (v >= first_new) v = number[v - first_new];
        }
    }
    vertices_.clear();
    faces_.clear();
    places_.clear();
    for (const int v : vertices) {
        vertices_.push_back(number[v - first_new]);
        faces_.push_back(faces[v - first_new]);
        places_.push_back(new_places_[v - first_new]);
    }
    pattern_.vertex_count = count;
}

bool QuadFront::add_row(int at) {
    const int count = size();
    if (faces_[at] != 1) return false;
    int length = 1;
    while (length < count && faces_[(at + length) % count] == 2) ++length;
    const auto on = [&](int k) { return (at + k + count) % count; };
    if (length + 3 > count || faces_[on(length)] != 1 || faces_[on(-1)] < 2 || faces_[on(length + 1)] < 2) return false;
    const Eigen::Vector2d first = places_[on(-1)] - places_[at];
    const Eigen::Vector2d last = places_[on(length + 1)] - places_[on(length)];
    new_places_.clear();
    Indices row{vertices_[on(-1)]};
    for (int k = 1; k < length; ++k) {
        const double share = double(k) / length;
        row.push_back(new_vertex(places_[on(k)] + (1.0 - share) * first + share * last));
    }
    row.push_back(vertices_[on(length + 1)]);
    for (int k = 0; k < length; ++k)
        pattern_.quads.push_back({vertices_[on(k)], vertices_[on(k + 1)], row[k + 1], row[k]});
    Indices vertices = row;
    Indices faces(row.size(), 2);
    std::vector<Eigen::Vector2d> places{places_[on(-1)]};
    places.insert(places.end(), new_places_.begin(), new_places_.end());
    places.push_back(places_[on(length + 1)]);
    faces.front() = faces_[on(-1)] - 1;
    faces.back() = faces_[on(length + 1)] - 1;
    for (int k = length + 2; k < count - 1; ++k) {
        vertices.push_back(vertices_[on(k)]);
        faces.push_back(faces_[on(k)]);
        places.push_back(places_[on(k)]);
    }
    vertices_ = std::move(vertices);
    faces_ = std::move(faces);
    places_ = std::move(places);
    return true;
}

bool QuadFront::add_short_row() {
    for (int k = 0; k < size(); ++k) {
        const int next = after(k);
        const bool is_short = faces_[next] == 1 || (faces_[next] == 2 && faces_[after(next)] == 1);
        if (faces_[k] == 1 && is_short && add_row(k)) return true;
    }
    return false;
}

bool QuadFront::place(const std::vector<Pole>& poles) {
    const auto lose = [&](int at, int count) {
        faces_[at] -= count;
        if (!is_new(at)) quads_at_[vertices_[at]] -= count;
    };
    for (const Pole& pole : poles) {
        lose(pole.at, pole.quarters);
        if (pole.triangle) lose(after(pole.at), 1);
    }
    if (*std::min_element(faces_.begin(), faces_.end()) < 1) return false;
    for (auto pole = poles.rbegin(); pole != poles.rend(); ++pole) {
        if (!pole->triangle) continue;
        const int next = after(pole->at);
        const int middle = new_vertex(inwards(pole->at, 1.0 / 3.0));
        pattern_.triangles.push_back({vertices_[pole->at], vertices_[next], middle});
        vertices_.insert(vertices_.begin() + pole->at + 1, middle);
        faces_.insert(faces_.begin() + pole->at + 1, 3);
        places_.insert(places_.begin() + pole->at + 1, new_places_.back());
    }
    return true;
}

std::optional<QuadPattern> QuadFront::filled() const {
    const std::vector<Lattice> places = walk();
    if (quarters() != 4 || !(places.back() == Lattice{})) return std::nullopt;
    QuadPattern result = pattern_;
    Numbers numbers;
    for (int k = 0; k < size(); ++k) {
        if (!numbers.emplace(places[k], vertices_[k]).second) return std::nullopt;
    }
    for (const Lattice& cell : cells_within(places)) {
        std::array<int, 4>& quad = result.quads.emplace_back();
        const std::array<Lattice, 4> corners{cell, cell + Lattice{1, 0}, cell + Lattice{1, 1}, cell + Lattice{0, 1}};
        for (int k = 0; k < 4; ++k) {
            const auto [found, is_new] = numbers.emplace(corners[k], result.vertex_count);
            if (is_new) ++result.vertex_count;
            quad[k] = found->second;
        }
    }
    return result;
}

}  // namespace fairing
