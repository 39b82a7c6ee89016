#include "fillet/row_line.h"

namespace fairing {

namespace {

// The vertices that a way over walls passes from a point on to a vertex, which comes last; and the half-edges there.
std::vector<WallPoint> steps_to(const SeamMesh& mesh, const LinePoint& point, int vertex) {
    std::map<int, WallPoint> before{{vertex, {none, none, 0.0}}};
    std::multimap<int, int> walls;
    int first = none;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.twin[h] != none) continue;
        if (mesh.edge[h] == point.edge) first = h;
        walls.emplace(mesh.tail(h), h);
        walls.emplace(mesh.head(h), h);
    }
    if (first == none && point.vertex == none) throw NoRows();
    const auto is_reached = [&](int v) {
        return v == point.vertex || (first != none && (v == mesh.tail(first) || v == mesh.head(first)));
    };
    Indices waiting{vertex};
    for (std::size_t k = 0; k < waiting.size() && !is_reached(waiting[k]); ++k) {
        const auto [begin, end] = walls.equal_range(waiting[k]);
        for (auto it = begin; it != end; ++it) {
            const int h = it->second;
            const int other = mesh.tail(h) + mesh.head(h) - waiting[k];
            if ((first == none || mesh.edge[h] != point.edge) &&
                before.try_emplace(other, WallPoint{waiting[k], h, 0.0}).second)
                waiting.push_back(other);
        }
    }
    const auto found = std::find_if(waiting.begin(), waiting.end(), is_reached);
    if (found == waiting.end()) throw NoRows();
    std::vector<WallPoint> steps;
    if (point.vertex == none) steps.push_back({*found, first, 0.0});
    for (int at = *found; at != vertex; at = steps.back().vertex) steps.push_back(before.at(at));
    if (steps.empty()) throw NoRows();
    return steps;
}

}  // namespace

std::vector<WallPoint> RowLine::wall_way(const Spot& spot, int vertex, int parts) const {
    if (spot.point == none) throw NoRows();
    const std::vector<WallPoint> steps = steps_to(mesh_, line_.points[spot.point], vertex);
    std::vector<Vector3> places{spot.place};
    std::vector<double> ways{0.0};
    for (const WallPoint& step : steps) {
        places.emplace_back(mesh_.points.col(step.vertex));
        ways.push_back(ways.back() + (places.back() - places[places.size() - 2]).norm());
    }
    std::vector<WallPoint> found;
    int slot = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const int last = static_cast<int>(std::lround(parts * ways[k + 1] / ways.back()));
        if (last <= slot) throw NoRows();
        const int h = steps[k].half_edge;
        for (int each = slot + 1; each < last; ++each) {
            const double share = static_cast<double>(each - slot) / (last - slot);
            const Vector3 place = (1.0 - share) * places[k] + share * places[k + 1];
            found.push_back({none, h, (place - mesh_.points.col(mesh_.tail(h))).norm() / mesh_.length[h]});
        }
        if (k + 1 < steps.size()) found.push_back({steps[k].vertex, none, 0.0});
        slot = last;
    }
    return found;
}

int RowLine::push(const LinePoint& point) {
    made_.points.push_back(point);
    vertices_.push_back(point.vertex == none ? vertex_count() : point.vertex);
    if (point.vertex == none) new_.push_back(static_cast<int>(made_.points.size()) - 1);
    return static_cast<int>(made_.points.size()) - 1;
}

int RowLine::add(const WallPoint& point) {
    if (point.vertex != none) return point.vertex;
    const int h = point.half_edge;
    const double along = mesh_.tail(h) < mesh_.head(h) ? point.along : 1.0 - point.along;
    const auto [known, is_new] = on_walls_.try_emplace({mesh_.edge[h], along}, 0);
    if (is_new) {
        Vector3 weights = Vector3::Zero();
        weights[h % 3] = 1.0 - point.along;
        weights[(h + 1) % 3] = point.along;
        known->second = vertices_[push({mesh_.place(h / 3, weights), none, mesh_.edge[h], along, h / 3, weights})];
    }
    return known->second;
}

std::vector<RowLine::Key> RowLine::within(int segment) const {
    std::vector<Key> found;
    const double number = segment;
    for (auto it = chosen_.lower_bound({number, -1e300, -1e300, -1e300}); it != chosen_.end() && it->first[0] == number;
         ++it)
        found.push_back(it->first);
    const Vector3 way =
        line_.points[line_.segments[segment].to].place - line_.points[line_.segments[segment].from].place;
    std::sort(found.begin(), found.end(), [&](const Key& a, const Key& b) {
        return Vector3(a[1], a[2], a[3]).dot(way) >
               Vector3(b[1], b[2], b[3]).dot(way);  // against the line, as walks run
    });
    return found;
}

void RowLine::number() {
    own_.assign(line_.points.size(), none);
    for (const SeamWalk& walk : walks_.walks()) {
        Indices kept;
        Indices triangles;  // of the way to each from the one before
        int triangle = none;
        const auto keep = [&](int point) {
            kept.push_back(point);
            triangles.push_back(triangle);
        };
        const auto stays = [&](int p) { return line_.points[p].bound() || chosen_.contains(key({{}, p, none})); };
        for (std::size_t k = 0; k < walk.points.size(); ++k) {
            const int p = walk.points[k];
            if (stays(p)) {
                own_[p] = push(line_.points[p]);
                keep(own_[p]);
                if (const auto at = chosen_.find(key({{}, p, none})); at != chosen_.end())
                    at->second = vertices_[own_[p]];
            }
            if (walk.segments[k] == none) {
                if (!stays(p)) throw NoRows();
                triangle = none;
                continue;
            }
            triangle = line_.segments[walk.segments[k]].triangle;
            for (const Key& spot : within(walk.segments[k])) {
                const Vector3 place(spot[1], spot[2], spot[3]);
                const int point = push({place, none, none, 0.0, triangle, Vector3::Zero()});
                chosen_[spot] = vertices_[point];
                keep(point);
            }
        }
        if (kept.size() < 2) throw NoRows();
        triangles.front() = triangle;  // over the walk's begin
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const int before = kept[(k + kept.size() - 1) % kept.size()];
            if (triangles[k] != none) made_.segments.push_back({kept[k], before, triangles[k]});
        }
    }
}

Indices RowLine::dropped() const {
    Indices found;
    for (int p = 0; p < static_cast<int>(own_.size()); ++p) {
        if (own_[p] != none && must_[p] == 0 && line_.points[p].vertex == none && !chosen_.contains(key({{}, p, none})))
            found.push_back(vertices_[own_[p]]);
    }
    return found;
}

Vector3 RowLine::place(const WallPoint& point) const {
    if (point.vertex != none) return mesh_.points.col(point.vertex);
    const int h = point.half_edge;
    return (1.0 - point.along) * mesh_.points.col(mesh_.tail(h)) + point.along * mesh_.points.col(mesh_.head(h));
}

Vector3 RowLine::place(int vertex) const {
    if (vertex < mesh_.points.cols()) return mesh_.points.col(vertex);
    return made_.points[new_[vertex - mesh_.points.cols()]].place;
}

}  // namespace fairing
