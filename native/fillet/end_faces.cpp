#include "fillet/end_faces.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "fillet/face_trimming.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double flat = 1e-5;  // of a triangle's extent: single precision of a plane's vertices

}  // namespace

Indices EndSection::numbers() const {
    Indices result(chain.size());
    std::iota(result.begin(), result.end(), first_new - 1);
    result.front() = chain.front();
    result.back() = chain.back();
    return result;
}

EndFaces::EndFaces(const Points& points, const Triangles& triangles, const SplitMesh& cut)
    : points_(points), given_(triangles), pieces_of_(triangles.cols()) {
    for (const auto place : cut.points.colwise()) added_.emplace_back(place);
    for (Eigen::Index t = 0; t < cut.triangles.cols(); ++t)
        put({cut.triangles(0, t), cut.triangles(1, t), cut.triangles(2, t)}, cut.parent[t], cut.inside[t] != 0);
}

int EndFaces::put(const Corners& corners, int parent, bool inside) {
    const int t = static_cast<int>(triangles_.size());
    pieces_of_[parent].push_back(t);
    triangles_.push_back(corners);
    parent_.push_back(parent);
    inside_.push_back(inside ? 1 : 0);
    removed_.push_back(0);
    for (std::size_t k = 0; k < 3; ++k) sides_[{corners[k], corners[(k + 1) % 3]}] = t;
    return t;
}

void EndFaces::remove(int triangle) {
    removed_[triangle] = 1;
    std::erase(pieces_of_[parent_[triangle]], triangle);
    const Corners& corners = triangles_[triangle];
    for (std::size_t k = 0; k < 3; ++k) {
        const auto found = sides_.find({corners[k], corners[(k + 1) % 3]});
        if (found != sides_.end() && found->second == triangle) sides_.erase(found);
    }
}

int EndFaces::at(int from, int to) const {
    const auto found = sides_.find({from, to});
    return found == sides_.end() ? none : found->second;
}

Vector3 EndFaces::place(int vertex) const {
    const auto old = static_cast<int>(points_.cols());
    return vertex < old ? Vector3(points_.col(vertex)) : added_[vertex - old];
}

bool EndFaces::is_whole(int given) const {
    return std::ranges::none_of(pieces_of_[given], [&](int t) { return inside_[t] != 0; });
}

EndFaces::Corners EndFaces::corners_given(int given) const {
    return {given_(0, given), given_(1, given), given_(2, given)};
}

Indices EndFaces::border(int given) const {
    std::map<int, int> next;
    for (const int t : pieces_of_[given]) {
        for (std::size_t k = 0; k < 3; ++k) {
            const int from = triangles_[t][k];
            const int to = triangles_[t][(k + 1) % 3];
            const int other = at(to, from);
            if (other == none || parent_[other] != given) next[from] = to;
        }
    }
    Indices result;
    for (int v = given_(0, given); result.size() < next.size(); v = next.at(v)) result.push_back(v);
    return result;
}

bool EndFaces::lies_in(int given, const Vector3& plane, const Vector3& origin) const {
    const auto [a, b, c] = corners_given(given);
    const double extent = std::max((place(b) - place(a)).norm(), (place(c) - place(a)).norm());
    for (const int v : {a, b, c}) {
        const Vector3 offset = place(v) - origin;
        if (std::abs(offset.dot(plane)) > flat * std::max(extent, offset.norm())) return false;
    }
    return area_vector(place(a), place(b), place(c)).dot(plane) >= 0.0;
}

std::optional<Vector3> EndFaces::plane_beyond(const Indices& chain) const {
    Vector3 sum = Vector3::Zero();
    Indices beyond;
    for (std::size_t k = 1; k < chain.size(); ++k) {
        const int piece = at(chain[k], chain[k - 1]);
        if (piece == none || !is_whole(parent_[piece])) return std::nullopt;
        beyond.push_back(parent_[piece]);
        const auto [a, b, c] = corners_given(beyond.back());
        sum += area_vector(place(a), place(b), place(c));
    }
    const Vector3 plane = direction(sum);
    const auto is_in_it = [&](int t) { return lies_in(t, plane, place(chain.front())); };
    if (plane.isZero() || !std::all_of(beyond.begin(), beyond.end(), is_in_it)) return std::nullopt;
    return plane;
}

void EndFaces::replace(std::vector<EndSection>& sections) {
    std::vector<std::vector<EndSection*>> faces;  // those that lose something, by planes
    for (EndSection& section : sections) {
        section.first_new = static_cast<int>(points_.cols() + std::ssize(added_));
        added_.insert(added_.end(), section.places.begin() + 1, section.places.end() - 1);
        const Vector3 origin = place(section.chain.front());
        Vector3 area = Vector3::Zero();  // twice, of what is between chain and section
        for (std::size_t k = 1; k < section.chain.size(); ++k) {
            area += (place(section.chain[k - 1]) - origin).cross(place(section.chain[k]) - origin);
            area -= (section.places[k - 1] - origin).cross(section.places[k] - origin);
        }
        if (area.dot(section.plane) >= 0.0) {
            write({&section}, extension(section));
            continue;
        }
        const auto is_there = [&](const std::vector<EndSection*>& face) {
            const Vector3 offset = origin - place(face.front()->chain.front());
            return section.plane.dot(face.front()->plane) > 1.0 - flat &&
                   std::abs(offset.dot(section.plane)) <= flat * offset.norm();
        };
        const auto found = std::ranges::find_if(faces, is_there);
        (found == faces.end() ? faces.emplace_back() : *found).push_back(&section);
    }
    for (std::vector<EndSection*>& face : faces) {
        while (!face.empty()) {
            const auto next = static_cast<int>(points_.cols() + std::ssize(added_));
            const auto made = trimmed(*this, face, next);
            if (const auto* change = std::get_if<FaceChange>(&made)) {
                write(face, *change);
                break;
            }
            face.erase(face.begin() + static_cast<std::ptrdiff_t>(std::get<std::size_t>(made)));
        }
    }
}

void EndFaces::write(const std::vector<EndSection*>& sections, const FaceChange& change) {
    added_.insert(added_.end(), change.added.begin(), change.added.end());
    for (const int given : change.gone) {
        const Indices pieces = pieces_of_[given];
        for (const int t : pieces) remove(t);
    }
    for (std::size_t s = 0; s < sections.size(); ++s) {
        EndSection& section = *sections[s];
        std::vector<Indices> path(
            section.chain.size());  // for each of its vertices a new one, and those up to the next
        for (const auto& [at, vertex] : change.paths[s]) {
            const auto k = static_cast<std::size_t>(at);
            path[k].push_back(vertex);
            if (vertex == section.chain.front() || vertex == section.chain.back()) continue;
            const double share = at - static_cast<double>(k);
            const Vector3& after = section.normals[std::min(k + 1, path.size() - 1)];
            section.vertices.push_back(vertex);
            const int last = section.chain[std::min(k + 1, path.size() - 1)];
            section.before.emplace_back((1.0 - share) * place(section.chain[k]) + share * place(last));
            section.vertex_normals.push_back(((1.0 - share) * section.normals[k] + share * after).normalized());
        }
        move_fillet(section.chain, path);
    }
    for (std::size_t p = 0; p < change.pieces.size(); ++p) put(change.pieces[p], change.parents[p], false);
}

// Triangles between the chain and the section, which lies before it.
FaceChange EndFaces::extension(const EndSection& section) const {
    const Indices& chain = section.chain;
    const Indices numbers = section.numbers();
    FaceChange made;
    std::vector<FaceChange::PathPoint>& path = made.paths.emplace_back();
    for (std::size_t k = 0; k < chain.size(); ++k) {
        path.push_back({static_cast<double>(k), numbers[k]});
        if (k == 0) continue;
        if (numbers[k] != chain[k]) made.pieces.push_back({chain[k - 1], chain[k], numbers[k]});
        if (numbers[k - 1] != chain[k - 1]) made.pieces.push_back({chain[k - 1], numbers[k], numbers[k - 1]});
        made.parents.resize(made.pieces.size(), parent_[at(chain[k], chain[k - 1])]);
    }
    return made;
}

// The fillet's border from the chain to the path.
void EndFaces::move_fillet(const Indices& chain, const std::vector<Indices>& path) {
    for (std::size_t k = 1; k + 1 < chain.size(); ++k) {
        const int from = chain[k];
        const int to = path[k].front();
        moved_[from] = to;
        Indices fan;
        for (int before = path[k - 1].front(), t = at(before, from); t != none && inside_[t] != 0;) {
            fan.push_back(t);
            const Corners& corners = triangles_[t];
            const auto own = std::find(corners.begin(), corners.end(), from) - corners.begin();
            t = at(corners[(own + 1) % 3], from);
            if (fan.size() > triangles_.size()) break;
        }
        for (const int t : fan) {
            Corners corners = triangles_[t];
            std::replace(corners.begin(), corners.end(), from, to);
            remove(t);
            put(corners, parent_[t], true);
        }
    }
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        if (path[k].size() < 2) continue;
        const int last = path[k + 1].front();
        const int t = at(path[k].front(), last);
        const Corners& corners = triangles_[t];
        const auto own = std::find(corners.begin(), corners.end(), last) - corners.begin();
        const int apex = corners[(own + 1) % 3];
        remove(t);
        for (std::size_t n = 0; n < path[k].size(); ++n)
            put({path[k][n], n + 1 < path[k].size() ? path[k][n + 1] : last, apex}, parent_[t], true);
    }
}

void EndFaces::write(SplitMesh& cut) const {
    std::vector<Eigen::Vector3i> corners;
    cut.parent.clear();
    cut.inside.clear();
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (removed_[t] != 0) continue;
        corners.emplace_back(triangles_[t][0], triangles_[t][1], triangles_[t][2]);
        cut.parent.push_back(parent_[t]);
        cut.inside.push_back(inside_[t]);
    }
    cut.triangles = as_columns(corners);
    cut.points = as_columns(added_);
    for (VertexPair& seam : cut.seams) {
        for (int& v : seam) v = moved_.contains(v) ? moved_.at(v) : v;
    }
}

}  // namespace fairing
