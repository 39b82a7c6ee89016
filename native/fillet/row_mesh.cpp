#include "fillet/row_mesh.h"

#include "base/progress.h"
#include "geometry/nearest_point.h"

namespace fairing {

namespace {

constexpr int samples = 4;  // for each edge: ways on the fillet are measured in so many chords

// Of the bulge over a column's chord: where the surface leaves the quads between two columns by more, another one comes
// between.
constexpr double bent = 0.6;            // where strips meet at corners it is up to .47, between vertices of a ring less
constexpr double bent_at_walls = 0.25;  // where it ends at a wall and fades, 1.4 from one end to the other
constexpr double flat = 0.02;           // of the width: what bulges less is flat
constexpr double shortest = 0.5;        // of the width: columns as near as that get none between them

using Grid = std::vector<Indices>;

// The triangles between seams, whatever walls are there.
UnionFind sides_of(const SeamMesh& mesh) {
    UnionFind found = mesh.parts();
    std::map<int, int> known;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] != none || mesh.twin[h] != none) continue;
        const auto [other, is_new] = known.try_emplace(mesh.edge[h], h);
        if (!is_new) found.join(h / 3, other->second / 3);
    }
    return found;
}

class Making {
public:
    Making(const SeamMesh& mesh, const SeamWalks& walks, const RowStrips& strips, const RowSizes& sizes,
           const Carried& carried, RowLine& line)
        : mesh_(mesh),
          walks_(walks),
          strips_(strips),
          width_(sizes.width),
          rows_(2 * std::max(1, static_cast<int>(std::lround(sizes.width / sizes.spacing)))),
          half_(rows_ / 2),
          carried_(carried),
          line_(line),
          parts_(sides_of(mesh)) {}

    RowMesh made() {
        choose();
        line_.number();
        for (Walls& each : walls_) number_walls(each);
        for (std::size_t arc = 0; arc < strips_.strips.size(); ++arc) add_strip(static_cast<int>(arc));
        add_corners();
        return std::move(made_);
    }

private:
    struct Walls {
        std::array<std::vector<WallPoint>, 2> ways;  // right, left
        std::array<Indices, 2> numbers;
        std::array<std::vector<Spot>, 2> turns;  // the line from the strip to the walls and back, as the walk runs
    };

    // All points of the line that quads need, and those on walls.
    void choose() {
        for (const RowCorner& corner : strips_.corners) {
            if (!corner.walled) continue;
            ends_[end_at(corner).end] = walls_.size();
            walls_.push_back(walls_at(corner));
        }
        for (std::size_t k = 0; k < strips_.strips.size(); ++k) {
            Strip& strip = strips_.strips[k];
            refine(static_cast<int>(k), strip);
            for (const Column& column : strip.columns) {
                for (const Side side : {right, left}) line_.add(strip.spot(column, side));
            }
        }
        for (const RowCorner& corner : strips_.corners) {
            if (!corner.around.spots.empty())
                around_.push_back(parted(corner.around, corner_rows(corner)));
            else
                around_.emplace_back();
            for (const Spot& spot : around_.back()) line_.add(spot);
        }
    }

    [[nodiscard]] int corner_rows(const RowCorner& corner) const {
        if (is_cap(corner) && rows_ < 4) throw NoRows();
        return rows_;
    }

    // In edges of one length; where an edge outside comes to it, that takes the place of the nearest spot.
    [[nodiscard]] std::vector<Spot> parted(const LinePart& part, int count) const {
        std::vector<Spot> found;
        for (int k = 0; k <= count; ++k) found.push_back(part.at(part.length() * k / count));
        std::vector<char> taken(found.size(), 0);
        for (std::size_t s = 1; s + 1 < part.spots.size(); ++s) {
            if (!line_.is_must(part.spots[s])) continue;
            const auto slot = static_cast<std::size_t>(
                std::clamp(static_cast<int>(std::lround(part.ways[s] / part.length() * count)), 1, count - 1));
            if (taken[slot] != 0) throw NoRows();
            taken[slot] = 1;
            found[slot] = part.spots[s];
        }
        return found;
    }

    struct ArcEnd {
        std::array<int, 2> end;  // an arc, and 0 where it begins or 1
        Side side;               // of the arc on which a walk passes
    };

    // Of a half-edge on a seam at an arc's end: forwards at its begin, or backwards at its last vertex.
    [[nodiscard]] ArcEnd end_of(int half_edge) const {
        for (int arc = 0; arc < static_cast<int>(strips_.strips.size()); ++arc) {
            const Indices& run = strips_.strips[arc].arc.half_edges;
            if (run.front() == half_edge) return {{arc, 0}, left};
            if (mesh_.twin[run.back()] == half_edge) return {{arc, 1}, right};
        }
        throw NoRows();
    }
    [[nodiscard]] int before(const RowCorner& corner) const {
        const Indices& run = walks_.walks()[corner.walk].half_edges;
        return run[(corner.index + run.size() - 1) % run.size()];
    }
    [[nodiscard]] int after(const RowCorner& corner) const {
        return walks_.walks()[corner.walk].half_edges[corner.index];
    }
    [[nodiscard]] ArcEnd end_at(const RowCorner& corner) const { return end_of(after(corner)); }
    [[nodiscard]] bool is_cap(const RowCorner& corner) const { return mesh_.twin[before(corner)] == after(corner); }

    [[nodiscard]] int vertex_at(const std::array<int, 2>& end) const {
        const Indices& run = strips_.strips[end[0]].arc.half_edges;
        return end[1] == 0 ? mesh_.tail(run.front()) : mesh_.head(run.back());
    }

    // As many quarters of a disc as fit into a turn best, each with a pole.
    [[nodiscard]] int quarters(const LinePart& turn) const {
        if (half_ < 2) throw NoRows();
        return std::max(1, static_cast<int>(std::lround(turn.length() / (0.5 * std::numbers::pi * width_))));
    }

    [[nodiscard]] Walls walls_at(const RowCorner& corner) {
        const ArcEnd at = end_at(corner);
        const Strip& strip = strips_.strips[at.end[0]];
        const Column& column = at.end[1] == 0 ? strip.columns.front() : strip.columns.back();
        Walls found;
        for (const Side side : {right, left}) {
            const bool leaves = side == at.side;
            const LinePart& turn = corner.turns[leaves ? 1 : 0];
            Spot wall = strip.spot(column, side);
            if (!turn.spots.empty()) {
                wall = leaves ? turn.spots.front() : turn.spots.back();
                found.turns[side] = parted(turn, quarters(turn) * 2 * (half_ / 2));
                for (const Spot& spot : found.turns[side]) line_.add(spot);
            }
            found.ways[side] = line_.wall_way(wall, vertex_at(at.end), half_);
        }
        return found;
    }

    void number_walls(Walls& walls) {
        for (const Side side : {right, left}) {
            for (const WallPoint& point : walls.ways[side]) walls.numbers[side].push_back(line_.add(point));
        }
    }

    [[nodiscard]] Vector3 before_of(int vertex) const {
        if (vertex < line_.vertex_count()) return line_.place(vertex);
        const RowMesh::Place& at = made_.places[vertex - line_.vertex_count()];
        return mesh_.place(at.triangle, at.weights);
    }

    int add(int triangle, const Vector3& weights, bool on_seam = false) {
        made_.places.push_back({triangle, weights, on_seam});
        return line_.vertex_count() + static_cast<int>(made_.places.size()) - 1;
    }

    const NearestTriangles& part(int triangle) {
        const int root = parts_.root(triangle);
        std::unique_ptr<NearestTriangles>& found = nearest_[root];
        if (!found) {
            Indices own;
            for (int t = 0; t < mesh_.triangles.cols(); ++t) {
                if (parts_.root(t) == root) own.push_back(t);
            }
            found = std::make_unique<NearestTriangles>(mesh_.points, mesh_.triangles, own);
        }
        return *found;
    }

    // Places that part the straight way between two others of a side into `count` edges, of one length on the fillet.
    std::vector<NearestPlace> parted(const Vector3& from, const Vector3& to, int count, int triangle) {
        const NearestTriangles& side = part(triangle);
        const int steps = samples * count;
        std::vector<NearestPlace> places;
        std::vector<double> ways{0.0};
        Vector3 last = Vector3::Zero();
        for (int k = 0; k <= steps; ++k) {
            const double share = static_cast<double>(k) / steps;
            places.push_back(side.to((1.0 - share) * from + share * to));
            const Vector3 now = carried_(places.back().foot);
            if (k > 0) ways.push_back(ways.back() + (now - last).norm());
            last = now;
        }
        std::vector<NearestPlace> found;
        for (int k = 1, at = 0; k < count; ++k) {
            const double wanted = ways.back() * k / count;
            while (at + 1 < steps && ways[at + 1] < wanted) ++at;
            const double step = ways[at + 1] - ways[at];
            const double share = step > 0.0 ? (wanted - ways[at]) / step : 0.0;
            found.push_back(side.to((1.0 - share) * places[at].foot + share * places[at + 1].foot));
        }
        return found;
    }

    Indices between(const Vector3& from, const Vector3& to, int count, int triangle) {
        Indices found;
        for (const NearestPlace& place : parted(from, to, count, triangle))
            found.push_back(add(place.triangle, place.weights));
        return found;
    }

    struct OnSeam {
        int half_edge;
        Vector3 weights;
    };
    [[nodiscard]] OnSeam on_seam(const SeamArc& arc, double way) const {
        const auto after = std::upper_bound(arc.ways.begin(), arc.ways.end(), way) - arc.ways.begin();
        const auto k = std::clamp<std::ptrdiff_t>(after - 1, 0, std::ssize(arc.half_edges) - 1);
        const int h = arc.half_edges[k];
        const double along = std::clamp((way - arc.ways[k]) / mesh_.length[h], 0.0, 1.0);
        Vector3 weights = Vector3::Zero();
        weights[h % 3] = 1.0 - along;
        weights[(h + 1) % 3] = along;
        return {h, weights};
    }

    // Where a column is on the fillet, from the right to the left.
    std::vector<Vector3> section(const Strip& strip, const Column& at, const Walls* walls) {
        const OnSeam seam = on_seam(strip.arc, at.way);
        const Vector3 middle = mesh_.place(seam.half_edge / 3, seam.weights);
        std::array<std::vector<Vector3>, 2> halves;
        for (const Side side : {right, left}) {
            const int triangle = side == left ? seam.half_edge / 3 : mesh_.twin[seam.half_edge] / 3;
            halves[side].push_back(strip.spot(at, side).place);
            if (walls != nullptr && walls->turns[side].empty()) {
                for (const WallPoint& point : walls->ways[side]) halves[side].push_back(line_.place(point));
            } else {
                for (const NearestPlace& place : parted(halves[side].front(), middle, half_, triangle))
                    halves[side].push_back(carried_(place.foot));
            }
        }
        std::vector<Vector3> result = halves[right];
        result.push_back(walls != nullptr ? middle : carried_(middle));
        result.insert(result.end(), halves[left].rbegin(), halves[left].rend());
        return result;
    }

    // Columns between others where the surface is not straight.
    void refine(int number, Strip& strip) {
        const auto at_end = [&](int which) {
            const auto found = ends_.find({number, which});
            return found == ends_.end() ? nullptr : &walls_[found->second];
        };
        const double most = at_end(0) != nullptr || at_end(1) != nullptr ? bent_at_walls : bent;
        std::vector<std::vector<Vector3>> sections;
        for (std::size_t k = 0; k < strip.columns.size(); ++k) {
            const bool is_last = k + 1 == strip.columns.size();
            sections.push_back(section(strip, strip.columns[k], k == 0 ? at_end(0) : is_last ? at_end(1) : nullptr));
        }
        for (std::size_t k = 0; k + 1 < strip.columns.size();) {
            checkpoint();
            const Column& before = strip.columns[k];
            const Column& after = strip.columns[k + 1];
            const Column middle{0.5 * (before.way + after.way),
                                {0.5 * (before.at[0] + after.at[0]), 0.5 * (before.at[1] + after.at[1])}};
            const double size = std::max(after.at[0] - before.at[0], after.at[1] - before.at[1]);
            if (size > shortest * width_) {
                const std::vector<Vector3> found = section(strip, middle, nullptr);
                if (is_bent(sections[k], found, sections[k + 1], most)) {
                    sections.insert(sections.begin() + static_cast<std::ptrdiff_t>(k) + 1, found);
                    strip.columns.insert(strip.columns.begin() + static_cast<std::ptrdiff_t>(k) + 1, middle);
                    continue;
                }
            }
            ++k;
        }
    }

    [[nodiscard]] bool is_bent(const std::vector<Vector3>& before, const std::vector<Vector3>& middle,
                               const std::vector<Vector3>& after, double most) const {
        const Vector3 chord = 0.5 * (middle.front() + middle.back());
        double off = 0.0;
        double bulge = std::numeric_limits<double>::infinity();
        for (std::size_t j = 1; j + 1 < middle.size(); ++j) {
            off = std::max(off, (middle[j] - 0.5 * (before[j] + after[j])).norm());
            bulge = std::min(bulge, (middle[j] - chord).norm());
        }
        return off > std::max(most * bulge, flat * width_);
    }

    // From the right to the left.
    Indices column(const Strip& strip, const Column& at) {
        const OnSeam seam = on_seam(strip.arc, at.way);
        const Vector3 middle = mesh_.place(seam.half_edge / 3, seam.weights);
        const Spot from = strip.spot(at, right);
        const Spot to = strip.spot(at, left);
        Indices found{line_.vertex(from)};
        const auto append = [&](const Indices& more) { found.insert(found.end(), more.begin(), more.end()); };
        append(between(from.place, middle, half_, mesh_.twin[seam.half_edge] / 3));
        found.push_back(add(seam.half_edge / 3, seam.weights, true));
        append(between(middle, to.place, half_, seam.half_edge / 3));
        found.push_back(line_.vertex(to));
        return found;
    }

    Indices walled_column(const std::array<int, 2>& end, const Walls& walls) {
        const Strip& strip = strips_.strips[end[0]];
        const Column& at = end[1] == 0 ? strip.columns.front() : strip.columns.back();
        const OnSeam seam = on_seam(strip.arc, at.way);
        std::array<Indices, 2> halves;  // from the line on
        for (const Side side : {right, left}) {
            const Spot from = strip.spot(at, side);
            halves[side] = walls.numbers[side];
            const int triangle = side == left ? seam.half_edge / 3 : mesh_.twin[seam.half_edge] / 3;
            if (!walls.turns[side].empty())
                halves[side] = between(from.place, mesh_.points.col(vertex_at(end)), half_, triangle);
            halves[side].insert(halves[side].begin(), line_.vertex(from));
        }
        Indices found = halves[right];
        found.push_back(vertex_at(end));
        found.insert(found.end(), halves[left].rbegin(), halves[left].rend());
        return found;
    }

    void add_strip(int number) {
        checkpoint();
        const Strip& strip = strips_.strips[number];
        Grid grid;
        for (std::size_t k = 0; k < strip.columns.size(); ++k) {
            const bool is_last = k + 1 == strip.columns.size();
            const auto walls = ends_.find({number, is_last ? 1 : 0});
            if (is_last && strip.arc.closed)
                grid.push_back(grid.front());
            else if ((k == 0 || is_last) && walls != ends_.end())
                grid.push_back(walled_column(walls->first, walls_[walls->second]));
            else
                grid.push_back(column(strip, strip.columns[k]));
        }
        columns_[{number, 0}] = grid.front();
        columns_[{number, 1}] = grid.back();
        add_quads(grid);
    }

    // Of vertices by place along and across, counter-clockwise where across is on the left of along.
    void add_quads(const Grid& grid) {
        for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
            for (std::size_t j = 0; j + 1 < grid[i].size(); ++j)
                made_.quads.push_back({grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]});
        }
    }

    // With the inner vertices of a grid whose border is known, from that by transfinite interpolation (Gordon & Hall
    // 1973), on the side of a triangle.
    void add_block(Grid grid, int triangle) {
        const std::size_t n = grid.size() - 1;
        const std::size_t m = grid.front().size() - 1;
        const NearestTriangles& side = part(triangle);
        const auto at = [&](std::size_t i, std::size_t j) { return before_of(grid[i][j]); };
        for (std::size_t i = 1; i < n; ++i) {
            for (std::size_t j = 1; j < m; ++j) {
                const double u = static_cast<double>(i) / static_cast<double>(n);
                const double v = static_cast<double>(j) / static_cast<double>(m);
                const Vector3 along = (1.0 - u) * at(0, j) + u * at(n, j) + (1.0 - v) * at(i, 0) + v * at(i, m);
                const Vector3 corners =
                    (1.0 - u) * ((1.0 - v) * at(0, 0) + v * at(0, m)) + u * ((1.0 - v) * at(n, 0) + v * at(n, m));
                const NearestPlace place = side.to(along - corners);
                grid[i][j] = add(place.triangle, place.weights);
            }
        }
        add_quads(grid);
    }

    // A block in a corner, by its sides from `first`'s begin and end on: both lead to the corner opposite.
    void add_block(const Indices& along, const Indices& across, const Indices& far_across, const Indices& far_along,
                   int triangle) {
        Grid grid(along.size(), Indices(across.size(), none));
        for (std::size_t i = 0; i < along.size(); ++i) {
            grid[i].front() = along[i];
            grid[i].back() = far_along[i];
        }
        grid.front() = across;
        grid.back() = far_across;
        add_block(std::move(grid), triangle);
    }

    void add_corners() {
        for (std::size_t k = 0; k < strips_.corners.size(); ++k) {
            const RowCorner& corner = strips_.corners[k];
            checkpoint();
            if (corner.walled) {
                add_turns(corner);
                continue;
            }
            Indices around;
            for (const Spot& spot : around_[k]) around.push_back(line_.vertex(spot));
            if (is_cap(corner))
                add_cap(corner, around);
            else
                add_meeting(corner, around);
        }
    }

    // Around a seam's end to the walls there, or from these to the strip.
    void add_turns(const RowCorner& corner) {
        const ArcEnd at = end_at(corner);
        const Walls& walls = walls_[ends_.at(at.end)];
        for (const Side side : {right, left}) {
            const std::vector<Spot>& turn = walls.turns[side];
            if (turn.empty()) continue;
            const bool leaves = side == at.side;
            Indices around;
            for (const Spot& spot : turn) around.push_back(line_.vertex(spot));
            const Indices strip = half_column({at.end, side});
            Indices wall{vertex_at(at.end)};
            wall.insert(wall.end(), walls.numbers[side].rbegin(), walls.numbers[side].rend());
            wall.push_back(leaves ? around.front() : around.back());
            const int triangle = (side == left ? strips_.strips[at.end[0]].arc.half_edges.front()
                                               : mesh_.twin[strips_.strips[at.end[0]].arc.half_edges.front()]) /
                                 3;
            add_quarters(around, leaves ? wall : strip, leaves ? strip : wall, triangle);
        }
    }

    // Between two rays from one vertex to a line around it, clockwise.
    void add_quarters(const Indices& around, const Indices& first, const Indices& last, int triangle) {
        const int size = 2 * (half_ / 2);
        Indices ray = first;
        for (int begin = 0; begin + size < std::ssize(around); begin += size) {
            Indices next = last;
            if (begin + size + 1 < std::ssize(around)) {
                next = {first.front()};
                const int far = around[begin + size];
                const Indices inner = between(before_of(first.front()), before_of(far), half_, triangle);
                next.insert(next.end(), inner.begin(), inner.end());
                next.push_back(far);
            }
            add_quarter(ray, {around.begin() + begin, around.begin() + begin + size + 1}, next, triangle);
            ray = next;
        }
    }

    // Three blocks around a pole: between two rays and the line from the first one's end to that of the other.
    void add_quarter(const Indices& from, const Indices& line, const Indices& to, int triangle) {
        const int near = half_ / 2;
        const auto part_of = [](const Indices& all, int begin, int end) {
            return Indices(all.begin() + begin, all.begin() + end + 1);
        };
        const Vector3 middle = (before_of(from[near]) + before_of(to[near]) + before_of(line[near])) / 3.0;
        const NearestPlace place = part(triangle).to(middle);
        const int pole = add(place.triangle, place.weights);
        const auto to_pole = [&](int vertex, int count) {
            Indices way{vertex};
            const Indices inner = between(before_of(vertex), before_of(pole), count, triangle);
            way.insert(way.end(), inner.begin(), inner.end());
            way.push_back(pole);
            return way;
        };
        const Indices before = to_pole(from[near], near);
        const Indices after = to_pole(to[near], near);
        Indices out = to_pole(line[near], half_ - near);
        std::reverse(out.begin(), out.end());
        add_block(part_of(to, 0, near), part_of(from, 0, near), after, before, triangle);
        add_block(before, part_of(from, near, half_), out, part_of(line, 0, near), triangle);
        Indices back = part_of(line, near, 2 * near);
        std::reverse(back.begin(), back.end());
        add_block(part_of(to, near, half_), after, back, out, triangle);
    }

    // From the middle of the column at an arc's end to the line, as a walk passes it.
    Indices half_column(const ArcEnd& at) {
        const Indices& column = columns_.at(at.end);
        Indices found(column.begin() + half_, column.end());
        if (at.side == right) found.assign(column.rbegin() + half_, column.rend());
        return found;
    }

    // From a meeting along the seam to the column where its strip ends.
    const Indices& spoke(const std::array<int, 2>& end) {
        Indices& found = spokes_[end];
        if (!found.empty()) return found;
        const Strip& strip = strips_.strips[end[0]];
        const double first = end[1] == 0 ? 0.0 : strip.arc.length();
        const double last = end[1] == 0 ? strip.columns.front().way : strip.columns.back().way;
        found.push_back(middle(vertex_at(end)));
        for (int k = 1; k < half_; ++k) {
            const OnSeam at = on_seam(strip.arc, first + (last - first) * k / half_);
            found.push_back(add(at.half_edge / 3, at.weights, true));
        }
        found.push_back(columns_.at(end)[half_]);
        return found;
    }

    int middle(int vertex) {
        const auto [found, is_new] = middles_.try_emplace(vertex, 0);
        if (is_new) {
            const int h = walks_.out(vertex).front();
            found->second = add(h / 3, Vector3::Unit(h % 3), true);
        }
        return found->second;
    }

    // The corner between two seams: a block, or two beside the middle of a long way around.
    void add_meeting(const RowCorner& corner, const Indices& around) {
        const ArcEnd come = reversed(before(corner));
        const ArcEnd go = end_of(after(corner));
        const Indices from = spoke(come.end);
        const Indices to = spoke(go.end);
        const int triangle = after(corner) / 3;
        if (around.empty()) {
            add_block(to, from, half_column(go), half_column(come), triangle);
            return;
        }
        Indices across{from.front()};
        const int far = around[half_];
        const Indices inner = between(before_of(across.front()), before_of(far), half_, triangle);
        across.insert(across.end(), inner.begin(), inner.end());
        across.push_back(far);
        const Indices first(around.rend() - half_ - 1, around.rend());  // from the middle back
        const Indices second(around.begin() + half_, around.end());
        add_block(across, from, first, half_column(come), triangle);
        add_block(to, across, half_column(go), second, triangle);
    }

    // Of the half-edge with which a walk arrives at an arc's end.
    [[nodiscard]] ArcEnd reversed(int half_edge) const {
        const ArcEnd at = end_of(mesh_.twin[half_edge]);
        return {at.end, at.side == left ? right : left};
    }

    // The half disc around a seam's end: outer rows lead around it and back, inner ones end, with poles at the corners
    // of their last edge.
    void add_cap(const RowCorner& corner, const Indices& around) {
        const ArcEnd come = reversed(before(corner));
        Indices column = columns_.at(come.end);
        if (come.side == left) std::reverse(column.begin(), column.end());
        const int inner = 2 * std::max(1, rows_ / 4);
        const int deep = (rows_ - inner) / 2;
        const Vector3 centre = mesh_.points.col(vertex_at(come.end));
        const double share = static_cast<double>(inner) / rows_;
        const auto corner_of = [&](int end) {  // of the inner rows' last edge
            return Vector3(centre + share * (before_of(around[end]) + before_of(around[half_]) - 2.0 * centre));
        };
        const std::array<Vector3, 4> core{before_of(column[deep]), corner_of(0), corner_of(rows_),
                                          before_of(column[rows_ - deep])};
        const NearestTriangles& side = part(after(corner) / 3);
        Grid rings{around};
        for (int level = 1; level <= deep; ++level) {
            Indices ring{column[level]};
            for (int k = 1; k < rows_; ++k) {
                const std::size_t leg = k < deep ? 0 : k <= rows_ - deep ? 1 : 2;
                const double along = leg == 0   ? static_cast<double>(k) / deep
                                     : leg == 1 ? static_cast<double>(k - deep) / inner
                                                : static_cast<double>(k - rows_ + deep) / deep;
                const Vector3 inside = (1.0 - along) * core[leg] + along * core[leg + 1];
                const double depth = static_cast<double>(level) / deep;
                const NearestPlace place = side.to((1.0 - depth) * before_of(around[k]) + depth * inside);
                ring.push_back(add(place.triangle, place.weights));
            }
            ring.push_back(column[rows_ - level]);
            rings.push_back(ring);
        }
        for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
            for (int j = 0; j < rows_; ++j)
                made_.quads.push_back({rings[k][j], rings[k + 1][j], rings[k + 1][j + 1], rings[k][j + 1]});
        }
        const Indices& last = rings.back();
        const Indices across(last.begin() + deep, last.end() - deep);
        const Indices far(column.begin() + deep, column.end() - deep);
        const Indices along(last.rend() - deep - 1, last.rend());
        const Indices far_along(last.end() - deep - 1, last.end());
        add_block(along, across, far, far_along, after(corner) / 3);
    }

    const SeamMesh& mesh_;
    const SeamWalks& walks_;
    RowStrips strips_;
    double width_;
    int rows_;
    int half_;
    const Carried& carried_;
    RowLine& line_;
    UnionFind parts_;
    std::map<int, std::unique_ptr<NearestTriangles>> nearest_;  // of each part
    std::vector<std::vector<Spot>> around_;                     // of each corner
    std::vector<Walls> walls_;
    std::map<std::array<int, 2>, std::size_t> ends_;  // of arcs' ends at walls: which
    std::map<std::array<int, 2>, Indices> columns_;   // at arcs' ends
    std::map<std::array<int, 2>, Indices> spokes_;
    std::map<int, int> middles_;  // of the vertices where seams meet
    RowMesh made_;
};

}  // namespace

RowMesh row_mesh(const SeamMesh& mesh, const SeamWalks& walks, const RowStrips& strips, const RowSizes& sizes,
                 const Carried& carried, RowLine& line) {
    return Making(mesh, walks, strips, sizes, carried, line).made();
}

}  // namespace fairing
