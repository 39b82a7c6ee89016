#include "fillet/seam_distance.h"

#include <Eigen/Geometry>

#include "base/progress.h"

namespace fairing {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();  // not reached yet
constexpr double right_angle = 0.5 * std::numbers::pi;                // shortest paths leave the seam at one
constexpr double roundoff = 1e-9;  // relative: neighbouring windows overlap by that, so that no crack is between them

Vector2 turned_left(const Vector2& v) { return {-v[1], v[0]}; }

}  // namespace

SeamDistance::SeamDistance(const SeamMesh& mesh, const SeamWidths& widths, double reach, bool through)
    : mesh_(mesh),
      reach_(reach),
      through_(through),
      windows_of_(mesh.triangles.cols()),
      vertex_(mesh.sheet_count, infinite),
      seams_at_(mesh.points.cols(), 0) {
    double least = infinite;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] == none) continue;
        ++seams_at_[mesh.tail(h)];
        vertex_[mesh.sheet[h]] = vertex_[mesh.sheet[SeamMesh::next(h)]] = 0.0;
        for (const bool at_tail : {true, false}) {
            least = std::min(least, width_of(h, at_tail, widths));
            widest_ = std::max(widest_, width_of(h, at_tail, widths));
        }
    }
    slack_ = widest_ > least ? widest_ - least : 0.0;
    size_ = std::max(reach, *std::max_element(mesh.length.begin(), mesh.length.end()));
    seed_edges(widths);
    seed_corners(widths);
    run();
}

double SeamDistance::width_of(int half_edge, bool at_tail, const SeamWidths& widths) const {
    const int vertex = at_tail ? mesh_.tail(half_edge) : mesh_.head(half_edge);
    return mesh_.left[half_edge] != 0 ? widths.left[vertex] : widths.right[vertex];
}

void SeamDistance::seed_edges(const SeamWidths& widths) {
    for (int h = 0; h < mesh_.half_edge_count(); ++h) {
        if (mesh_.seam[h] == none) continue;
        const double length = mesh_.length[h];
        sources_.push_back(
            {0.0, length, width_of(h, true, widths), width_of(h, false, widths), true, {h, false, infinite}});
        const int source = static_cast<int>(sources_.size()) - 1;
        add({h, false, Vector2::Zero(), Vector2(1.0, 0.0), 0.0, 0.0, length, 0.0, source}, 0.0);
    }
}

// Each sector at a seam's vertex begins at a seam or a wall.
void SeamDistance::seed_corners(const SeamWidths& widths) {
    std::vector<char> on_seam(mesh_.sheet_count, 0);
    for (int h = 0; h < mesh_.half_edge_count(); ++h) {
        if (mesh_.seam[h] != none) on_seam[mesh_.sheet[h]] = on_seam[mesh_.sheet[SeamMesh::next(h)]] = 1;
    }
    for (int h = 0; h < mesh_.half_edge_count(); ++h) {
        if (on_seam[mesh_.sheet[h]] != 0 && (mesh_.seam[h] != none || mesh_.twin[h] == none)) seed_sector(h, widths);
    }
}

// The rays that no seam beside the sector sends out: from a right angle on beyond each of them.
void SeamDistance::seed_sector(int first_half_edge, const SeamWidths& widths) {
    double total = 0.0;
    int last = first_half_edge;
    for (int h = first_half_edge; h != none;) {
        last = h;
        total += mesh_.opening[h];
        h = mesh_.turned(h);
        if (h == first_half_edge || (h != none && mesh_.seam[h] != none)) break;
    }
    const int closing = SeamMesh::previous(last);
    const bool from_seam = mesh_.seam[first_half_edge] != none;
    const bool to_seam = mesh_.seam[closing] != none;
    const double begin = from_seam ? right_angle : 0.0;
    const double end = total - (to_seam ? right_angle : 0.0);
    if (!(end > begin)) return;
    const double before = width_of(from_seam || !to_seam ? first_half_edge : closing, from_seam || !to_seam, widths);
    const double after = width_of(to_seam || !from_seam ? closing : first_half_edge, !to_seam && from_seam, widths);
    if (through_ && from_seam != to_seam && total <= 2.0 * right_angle && seams_at_[mesh_.tail(first_half_edge)] == 1) {
        seed_extension(from_seam ? closing : first_half_edge, from_seam ? first_half_edge : closing,
                       2.0 * right_angle - total, before);
        return;
    }
    sources_.push_back({-end, -begin, after, before, false, {first_half_edge, true, infinite}});
    const int source = static_cast<int>(sources_.size()) - 1;
    double angle = 0.0;
    for (int h = first_half_edge;; h = mesh_.turned(h)) {
        const double first = std::max(-(angle + mesh_.opening[h]), -end);
        const double after_last = std::min(-angle, -begin);
        if (after_last > first)
            add({h, true, Vector2::Zero(), Vector2(1.0, 0.0), -angle, first, after_last, 0.0, source}, 0.0);
        angle += mesh_.opening[h];
        if (h == last) break;
    }
}

// Where a seam ends on a wall, paths square to it come from its extension, over that wall as far as it is straight; so
// the fillet's line runs on to it. `angle`: between both, at most a right one.
void SeamDistance::seed_extension(int wall, int seam, double angle, double width) {
    const bool comes = mesh_.seam[seam] != none && mesh_.tail(seam) == mesh_.head(wall);  // the wall, to the seam's end
    const Vector2 zero(std::cos(angle), comes ? std::sin(angle) : -std::sin(angle));
    sources_.push_back({0.0, 0.0, width, width, true, {seam, false, comes ? 0.0 : mesh_.length[seam]}});
    const int source = static_cast<int>(sources_.size()) - 1;
    const auto offset = [&](int h) {
        return Vector3(mesh_.points.col(mesh_.head(h)) - mesh_.points.col(mesh_.tail(h)));
    };
    double passed = 0.0;
    for (int h = wall; passed * zero[0] <= reach_;) {
        const Vector2 origin(comes ? passed + mesh_.length[h] : -passed, 0.0);
        const double near = passed * zero[0];
        const double far = (passed + mesh_.length[h]) * zero[0];
        const double key = passed * std::abs(zero[1]);
        if (key <= reach_)
            add({h, false, origin, zero, 0.0, comes ? -far : near, comes ? -near : far, 0.0, source}, key);
        passed += mesh_.length[h];
        int next = comes ? h : SeamMesh::next(h);
        if (comes) {
            while (mesh_.turned(next) != none) next = mesh_.turned(next);
            next = SeamMesh::previous(next);
        } else {
            while (mesh_.twin[next] != none) next = SeamMesh::next(mesh_.twin[next]);
        }
        const Vector3 before = offset(h);
        if (next == wall || before.cross(offset(next)).norm() > roundoff * before.norm() * offset(next).norm() ||
            before.dot(offset(next)) <= 0.0)
            break;
        h = next;
    }
}

// From a vertex that shortest paths bend around, into all triangles there.
void SeamDistance::emit_fan(int half_edge, int source) {
    int start = half_edge;
    for (int h = mesh_.turned_back(half_edge); h != none && h != half_edge; h = mesh_.turned_back(h)) start = h;
    const double offset = vertex_[mesh_.sheet[half_edge]];
    for (int h = start; h != none;) {
        add({h, true, Vector2::Zero(), Vector2(1.0, 0.0), 0.0, -mesh_.opening[h], 0.0, offset, source}, offset);
        h = mesh_.turned(h);
        if (h == start) break;
    }
}

void SeamDistance::add(const Window& window, double key) {
    windows_of_[window.half_edge / 3].push_back(static_cast<int>(windows_.size()));
    queue_.push_back({key, static_cast<int>(windows_.size()), none, none});
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
    windows_.push_back(window);
}

void SeamDistance::run() {
    while (!queue_.empty()) {
        checkpoint();
        std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
        const Event event = queue_.back();
        queue_.pop_back();
        if (event.window != none)
            propagate(event.window);
        else if (event.key <= vertex_[mesh_.sheet[event.half_edge]])
            emit_fan(event.half_edge, event.source);
    }
}

double SeamDistance::tolerance(const Window& window) const {
    return sources_[window.source].parallel ? roundoff * size_ : roundoff;
}

double SeamDistance::coordinate(const Window& window, const Vector2& place) const {
    const Vector2 offset = place - window.origin;
    if (sources_[window.source].parallel) return offset.dot(window.zero);
    return window.base + std::atan2(cross2(offset, window.zero), offset.dot(window.zero));
}

double SeamDistance::distance(const Window& window, const Vector2& place) const {
    const Vector2 offset = place - window.origin;
    if (sources_[window.source].parallel) return std::abs(cross2(window.zero, offset));
    return window.offset + offset.norm();
}

double SeamDistance::width(const Window& window, double ray) const {
    const Source& source = sources_[window.source];
    const double range = source.last - source.first;
    const double share = range > 0.0 ? std::clamp((ray - source.first) / range, 0.0, 1.0) : 0.5;
    return source.width_first + share * (source.width_last - source.width_first);
}

// Where a ray crosses the window's half-edge, in its frame.
double SeamDistance::crossing(const Window& window, double ray) const {
    const double length = mesh_.length[window.half_edge];
    Vector2 start = window.origin;
    Vector2 offset = turned_left(window.zero);
    if (sources_[window.source].parallel) {
        start += ray * window.zero;
    } else {
        const double angle = window.base - ray;
        offset = std::cos(angle) * window.zero + std::sin(angle) * turned_left(window.zero);
    }
    if (!(offset[1] > 0.0)) return offset[0] > 0.0 ? length : 0.0;
    return std::clamp(start[0] - start[1] / offset[1] * offset[0], 0.0, length);
}

// Whether shortest paths bend around the half-edge's tail: where the angles are more than flat, or a wall ends the
// surface behind more than a half turn.
bool SeamDistance::bends(int half_edge) const {
    double total = 0.0;
    int h = half_edge;
    do {
        total += mesh_.opening[h];
        h = mesh_.turned(h);
    } while (h != none && h != half_edge);
    if (h == half_edge) return total > 4.0 * right_angle + roundoff;
    for (h = mesh_.turned_back(half_edge); h != none; h = mesh_.turned_back(h)) total += mesh_.opening[h];
    return total > 2.0 * right_angle + roundoff;
}

// The tail of a half-edge, reached by a ray.
void SeamDistance::touch(int half_edge, double reached, const Window& window, double ray) {
    double& known = vertex_[mesh_.sheet[half_edge]];
    if (!(reached < known)) return;
    known = reached;
    if (reached > reach_ || !bends(half_edge)) return;
    const double wide = width(window, ray);
    sources_.push_back({0.0, 0.0, wide, wide, false, foot(sources_[window.source], ray)});
    queue_.push_back({reached, none, half_edge, static_cast<int>(sources_.size()) - 1});
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

void SeamDistance::propagate(int w) {
    const Window window = windows_[w];
    const int h = window.half_edge;
    const int next = SeamMesh::next(h);
    const int previous = SeamMesh::previous(h);
    const double tolerated = tolerance(window);
    const auto touch_at = [&](int vertex, const Vector2& place, double ray) {
        if (ray > window.first - tolerated && ray < window.last + tolerated)
            touch(vertex, distance(window, place), window, ray);
    };
    const double ray = window.corner ? window.base - mesh_.opening[h] : coordinate(window, mesh_.apex[h]);
    touch_at(previous, mesh_.apex[h], ray);
    if (window.corner) {
        touch_at(next, Vector2(mesh_.length[h], 0.0), window.base);
        pass(window, next, window.first, window.last);
        return;
    }
    if (ray > window.first) pass(window, previous, window.first, std::min(window.last, ray));
    if (ray < window.last) pass(window, next, std::max(window.first, ray), window.last);
}

// Out of a triangle through one of its half-edges, unless other paths to all that lies behind are shorter.
void SeamDistance::pass(const Window& window, int through, double first, double last) {
    const int entered = mesh_.twin[through];
    if (entered == none || mesh_.seam[through] != none) return;
    if (window.crossed > mesh_.triangles.cols()) return;  // a shortest path enters each triangle once
    const bool is_next = through == SeamMesh::next(window.half_edge);
    const Vector2 apex = mesh_.apex[window.half_edge];
    const Vector2 tail = is_next ? apex : Vector2::Zero();
    const Vector2 head = is_next ? Vector2(mesh_.length[window.half_edge], 0.0) : apex;
    const double length = mesh_.length[through];
    if (!(length > 0.0)) return;
    const Vector2 x = (head - tail) / length;
    const auto turned = [&](const Vector2& v) { return Vector2(v.dot(x), cross2(x, v)); };
    Window there = window;
    there.half_edge = entered;
    there.corner = false;
    ++there.crossed;
    there.origin = turned(window.origin - tail);
    there.zero = turned(window.zero);
    there.first = first;
    there.last = last;
    const double a = crossing(there, first);
    const double b = crossing(there, last);
    const double at_a = distance(there, {a, 0.0});
    const double at_b = distance(there, {b, 0.0});
    const double from_tail = vertex_[mesh_.sheet[entered]] + slack_;
    const double from_head = vertex_[mesh_.sheet[SeamMesh::next(entered)]] + slack_;
    if (from_tail + b < at_b || from_head + length - a < at_a) return;
    double key = std::min(at_a, at_b);
    const double foot = there.origin[0];
    if (!sources_[window.source].parallel && foot > a && foot < b) key = window.offset + std::abs(there.origin[1]);
    if (key <= reach_) add(there, key);
}

SeamFoot SeamDistance::foot(const Source& source, double ray) const {
    SeamFoot result = source.foot;
    if (std::isinf(result.along)) result.along = result.corner ? -ray : ray;
    return result;
}

SeamFoot SeamDistance::foot(int triangle, const Vector3& weights) const {
    const Nearest found = nearest(triangle, weights);
    if (found.window == none) return {none, false, 0.0};
    return foot(sources_[windows_[found.window].source], found.ray);
}

SeamPlace SeamDistance::at(int triangle, const Vector3& weights) const { return nearest(triangle, weights).place; }

SeamDistance::Nearest SeamDistance::nearest(int triangle, const Vector3& weights) const {
    Nearest best{{infinite, 0.0}, none, 0.0};
    for (const int w : windows_of_[triangle]) {
        const Window& window = windows_[w];
        const Vector2 place = mesh_.in_frame(window.half_edge, weights);
        const double ray = coordinate(window, place);
        const double reached = distance(window, place);
        // At a corner's own place all of its rays meet.
        const bool meets = window.corner && reached <= window.offset + roundoff * size_;
        const double tolerated = 1e2 * tolerance(window);  // of ten triangles in a row and more
        if (!meets && (ray < window.first - tolerated || ray > window.last + tolerated)) continue;
        const double wide = width(window, ray);
        if (reached - wide < best.place.distance - best.place.width) best = {{reached, wide}, w, ray};
    }
    return best;
}

double SeamDistance::value(int triangle, const Vector3& weights) const {
    const SeamPlace place = at(triangle, weights);
    return place.distance - place.width;
}

double SeamDistance::relative_width(int triangle, const Vector3& weights) const {
    const SeamPlace place = at(triangle, weights);
    return std::isfinite(place.distance) ? place.width / widest_ : 1.0;
}

double SeamDistance::least_value(int triangle, const Vector3& weights, double radius) const {
    double least = infinite;
    for (const int w : windows_of_[triangle]) {
        const Window& window = windows_[w];
        const Source& source = sources_[window.source];
        const Vector2 place = mesh_.in_frame(window.half_edge, weights);
        double reached = distance(window, place);
        if (source.parallel) {
            const double ray = coordinate(window, place);
            reached = std::hypot(reached, std::max({0.0, window.first - ray, ray - window.last}));
        }
        least = std::min(least, reached - std::max(source.width_first, source.width_last));
    }
    return least - radius;
}

}  // namespace fairing
