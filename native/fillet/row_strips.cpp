#include "fillet/row_strips.h"

#include <Eigen/Geometry>

namespace fairing {

namespace {

constexpr double round_corner = 0.6;  // of the width: a longer way around a corner is a side of its own
constexpr double near_column = 0.3;   // of the spacing: nearer columns come together
constexpr double straight = 1e-3;     // of the spacing: nearer to the chord is no corner of the line
constexpr double roundoff = 1e-6;     // of a length
constexpr double least_block = 0.3;   // of the width, and of an arc: as far from a meeting its strip ends
constexpr double least_turn = 0.02;   // sine: a line that turns by less has no corner

// The line beside a walk with a spot for each of its corners.
struct WalkLine {
    LinePart line;        // closed: its last segment leads to the first spot
    Indices first, last;  // of each corner: where the line comes to it, and where it goes on
};

class Making {
public:
    Making(const SeamMesh& mesh, const SeamWalks& walks, const LevelLine& line, const std::vector<char>& must,
           const RowSizes& sizes)
        : mesh_(mesh), walks_(walks), points_(line), must_(must), near_(near_column * sizes.spacing), sizes_(sizes) {}

    RowStrips made() {
        for (int w = 0; w < static_cast<int>(walks_.walks().size()); ++w) add_walk(w);
        for (const SeamArc& arc : walks_.arcs()) add_strip(arc);
        return std::move(made_);
    }

private:
    [[nodiscard]] bool is_must(const Spot& spot) const { return spot.point != none && must_[spot.point] != 0; }

    void add_walk(int w) {
        const SeamWalk& walk = walks_.walks()[w];
        WalkLine found;
        Indices spot_of;  // of each of the walk's points
        std::size_t k = 0;
        const auto take_while = [&](double last) {
            for (; k < walk.points.size() && walk.at[k] <= last; ++k) {
                spot_of.push_back(static_cast<int>(found.line.spots.size()));
                found.line.spots.push_back({points_.points[walk.points[k]].place, walk.points[k], none});
                found.line.segments.push_back(walk.segments[k]);
            }
        };
        const double near = roundoff * walk.ways.back();
        std::vector<std::array<int, 3>> at_walls;  // corners, and the first and the last point there
        for (int i = 0; i < static_cast<int>(walk.half_edges.size()); ++i) {
            const std::size_t begin = k;
            take_while(walk.ways[i] + near);
            add_corner(w, i, {begin, k}, found);
            const int gap = gap_at(w, i, {begin, k});
            if (gap != none) at_walls.push_back(beside_gap(walk, gap, {begin, k}, made_.corners.back().turns, i));
            take_while(walk.ways[i + 1] - near);
        }
        take_while(walk.ways.back());
        for (const auto& [i, first, last] : at_walls) {
            found.first[i] = spot_of[first];
            found.last[i] = spot_of[last];
        }
        for (Indices* spots : {&found.first, &found.last}) {  // the one before the first is the last
            for (int& spot : *spots) spot = spot < 0 ? static_cast<int>(found.line.spots.size()) - 1 : spot;
        }
        lines_.push_back(std::move(found));
    }

    [[nodiscard]] bool is_end(const SeamWalk& walk, int i) const {
        const int before = walk.half_edges[(i + walk.half_edges.size() - 1) % walk.half_edges.size()];
        return mesh_.twin[walk.half_edges[i]] == before;
    }

    // Where the line has ended at a wall before it goes on beyond the seam's end: the number of that point. `fan`: of
    // the walk's points, those reached from the corner itself.
    [[nodiscard]] int gap_at(int w, int i, const std::array<std::size_t, 2>& fan) const {
        const SeamWalk& walk = walks_.walks()[w];
        if (!is_end(walk, i) || walk.walled[i] == 0) return none;
        const std::size_t count = walk.points.size();
        for (std::size_t k = fan[0] + count - 1; k < fan[1] + count; ++k) {
            if (walk.segments[k % count] == none) return static_cast<int>(k % count);
        }
        return none;
    }

    // Ways of some length around the corner to the walls and from them on do not belong to the strip.
    [[nodiscard]] std::array<int, 3> beside_gap(const SeamWalk& walk, int gap, const std::array<std::size_t, 2>& fan,
                                                std::array<LinePart, 2>& turns, int corner) const {
        const int count = static_cast<int>(walk.points.size());
        const int begin = static_cast<int>(fan[0]);
        const int end = static_cast<int>(fan[1]);
        std::array<int, 3> found{corner, gap, (gap + 1) % count};
        const auto part = [&](int first, int last) {
            LinePart result;
            for (int k = first; k <= last; ++k) {
                result.spots.push_back({points_.points[walk.points[k]].place, walk.points[k], none});
                if (k < last) result.segments.push_back(walk.segments[k]);
            }
            result.measure();
            return result.length() > round_corner * sizes_.width ? result : LinePart();
        };
        if (gap >= begin && gap < end) turns[0] = part(begin, gap);
        if (found[2] >= begin && found[2] < end) turns[1] = part(found[2], end - 1);
        if (!turns[0].spots.empty()) found[1] = begin;
        if (!turns[1].spots.empty()) found[2] = end - 1;
        return found;
    }

    void add_corner(int w, int i, const std::array<std::size_t, 2>& fan, WalkLine& found) {
        const SeamWalk& walk = walks_.walks()[w];
        const bool meets = walks_.is_meeting(mesh_.tail(walk.half_edges[i]));
        LinePart around;
        LinePart& line = found.line;
        const auto end = static_cast<std::ptrdiff_t>(line.spots.size());
        const auto count = static_cast<std::ptrdiff_t>(fan[1] - fan[0]);
        found.first.push_back(static_cast<int>(end - count));
        found.last.push_back(static_cast<int>(end) - 1);
        const bool walled = gap_at(w, i, fan) != none;
        if (!walled && count == 0) {
            if (is_end(walk, i)) throw NoRows();
            add_turn(walk, fan[0], found);
        } else if (!walled) {
            around.spots.assign(line.spots.end() - count, line.spots.end());
            around.segments.assign(line.segments.end() - count, line.segments.end() - 1);
            around.measure();
            if (!is_end(walk, i) && (!meets || around.length() <= round_corner * sizes_.width)) {
                add_middle(around, end - count, found);
                around = {};
            }
        }
        if (meets) made_.corners.push_back({w, i, walled, around, {}});
    }

    // Half way around a corner; an end of an edge outside that is near takes its place.
    void add_middle(const LinePart& around, std::ptrdiff_t begin, WalkLine& found) const {
        const double half = 0.5 * around.length();
        Spot middle = around.at(half);
        std::ptrdiff_t before = 0;
        for (std::size_t k = 0; k < around.spots.size(); ++k) {
            if (is_must(around.spots[k]) && std::abs(around.ways[k] - half) < near_) middle = around.spots[k];
            if (around.ways[k] <= half) before = static_cast<std::ptrdiff_t>(k);
        }
        for (std::size_t k = 0; k < around.spots.size(); ++k) {
            if (middle.point == around.spots[k].point) {
                found.first.back() = found.last.back() = static_cast<int>(begin + static_cast<std::ptrdiff_t>(k));
                return;
            }
        }
        put(found, begin + before + 1, middle);
    }

    static void put(WalkLine& found, std::ptrdiff_t at, const Spot& spot) {
        found.line.spots.insert(found.line.spots.begin() + at, spot);
        found.line.segments.insert(found.line.segments.begin() + at, spot.segment);
        found.first.back() = found.last.back() = static_cast<int>(at);
    }

    // Where the line turns between two of its points: its ways before and after, prolonged, meet. `after`: of the
    // walk's points the next one.
    void add_turn(const SeamWalk& walk, std::size_t after, WalkLine& found) const {
        const std::size_t count = walk.points.size();
        const auto at = [&](std::size_t k) { return Vector3(points_.points[walk.points[(k + count) % count]].place); };
        const auto direction = [&](std::size_t to, std::size_t step) {
            Vector3 way = Vector3::Zero();
            for (std::size_t k = 1; k < 4 && way.norm() <= straight * sizes_.spacing; ++k)
                way = at(to) - at(to + k * step);
            return Vector3(way.normalized());
        };
        const int segment = walk.segments[(after + count - 1) % count];
        const Vector3 start = at(after + count - 1);
        const Vector3 end = at(after);
        const Vector3 come = direction(after + count - 1, count - 1);
        const Vector3 go = direction(after, 1);
        Vector3 place = 0.5 * (start + end);
        const Vector3 normal = come.cross(go);
        if (normal.norm() > least_turn) {
            const Vector3 met = start + (end - start).cross(go).dot(normal) / normal.squaredNorm() * come;
            if ((met - place).norm() <= 0.6 * (end - start).norm() + straight * sizes_.spacing) place = met;
        }
        const auto last = static_cast<std::ptrdiff_t>(found.line.spots.size());
        for (const auto& [point, number] : {std::pair(after + count - 1, last - 1), std::pair(after, last)}) {
            const int p = walk.points[point % count];
            const double most = must_[p] != 0 ? near_ : straight * sizes_.spacing;
            if ((points_.points[p].place - place).norm() > most) continue;
            place = points_.points[p].place;
            found.first.back() = found.last.back() = static_cast<int>(number);
            return;
        }
        put(found, last, {place, none, segment});
    }

    [[nodiscard]] LinePart part(const WalkLine& from, int first, int last) const {
        const int count = static_cast<int>(from.line.spots.size());
        LinePart result;
        for (int k = first % count;; k = (k + 1) % count) {
            result.spots.push_back(from.line.spots[k]);
            if (k == last % count && (result.spots.size() > 1 || first != last)) break;
            if (static_cast<int>(result.spots.size()) > count + 1) throw NoRows();
            result.segments.push_back(from.line.segments[k]);
            if (result.segments.back() == none) throw NoRows();
        }
        result.measure();
        return result;
    }

    void add_strip(const SeamArc& arc) {
        Strip strip{arc, {}, {}};
        const int count = static_cast<int>(arc.half_edges.size());
        std::array<Indices, 2> inner;  // spots of the inner vertices
        for (const Side side : {right, left}) {
            const int h = side == left ? arc.half_edges.front() : mesh_.twin[arc.half_edges.back()];
            const auto [w, begin] = walks_.at(h);
            const WalkLine& from = lines_[w];
            const int corners = static_cast<int>(from.first.size());
            const int start = from.last[begin];
            const int end = from.first[(begin + count) % corners];
            if (start == end && corners != count) throw NoRows();
            strip.sides[side] = part(from, start, end);
            const int spots = static_cast<int>(from.line.spots.size());
            for (int k = 1; k < count; ++k) inner[side].push_back((from.first[begin + k] - start + spots) % spots);
            if (side == left) continue;
            strip.sides[side].reverse();
            std::reverse(inner[side].begin(), inner[side].end());
            for (int& k : inner[side]) k = static_cast<int>(strip.sides[side].spots.size()) - 1 - k;
        }
        strip.columns = columns(strip, inner, {end_way(strip, 0), strip.arc.length() - end_way(strip, 1)});
        made_.strips.push_back(std::move(strip));
    }

    // From an arc's end to the column where its strip ends: half way between the feet of both spots there.
    [[nodiscard]] double end_way(const Strip& strip, int which) const {
        const int h = which == 0 ? strip.arc.half_edges.front() : mesh_.twin[strip.arc.half_edges.back()];
        if (strip.arc.closed || !walks_.is_meeting(mesh_.tail(h)) || walks_.degree(mesh_.tail(h)) == 1) return 0.0;
        const Vector3 start = mesh_.points.col(mesh_.tail(h));
        const Vector3 along = (Vector3(mesh_.points.col(mesh_.head(h))) - start).normalized();
        double sum = 0.0;
        for (const LinePart& side : strip.sides) {
            const Spot& spot = which == 0 ? side.spots.front() : side.spots.back();
            sum += std::max(0.0, (spot.place - start).dot(along));
        }
        const double most = least_block * strip.arc.length();
        return std::clamp(0.5 * sum, std::min(least_block * sizes_.width, most), std::max(most, 0.5 * sum));
    }

    // Of the inner vertices those that are clear of each other, with edges outside that are near; and one for each
    // other edge outside, and the one across from it.
    [[nodiscard]] std::vector<Column> columns(const Strip& strip, const std::array<Indices, 2>& inner,
                                              const std::array<double, 2>& ends) const {
        const Column last{ends[1], {strip.sides[right].length(), strip.sides[left].length()}};
        std::vector<Column> anchors{{ends[0], {0.0, 0.0}}};
        if (ends[1] <= ends[0] || std::min(last.at[right], last.at[left]) <= roundoff * sizes_.width) throw NoRows();
        const auto clear = [&](const Column& before, const Column& after) {
            return after.way > before.way && after.at[right] - before.at[right] > near_ &&
                   after.at[left] - before.at[left] > near_;
        };
        for (std::size_t k = 0; k < inner[left].size(); ++k) {
            Column column{strip.arc.ways[k + 1], {}};
            for (const Side side : {right, left}) column.at[side] = strip.sides[side].ways[inner[side][k]];
            if (clear(anchors.back(), column) && clear(column, last)) anchors.push_back(column);
        }
        anchors.push_back(last);
        for (std::size_t k = 1; k + 1 < anchors.size(); ++k) {
            for (const Side side : {right, left})
                anchors[k].at[side] = nearest_must(strip.sides[side], anchors, k, side);
        }
        std::vector<Column> result;
        for (std::size_t k = 0; k + 1 < anchors.size(); ++k) {
            result.push_back(anchors[k]);
            add_musts(strip, anchors[k], anchors[k + 1], result);
        }
        result.push_back(last);
        return result;
    }

    [[nodiscard]] double nearest_must(const LinePart& line, const std::vector<Column>& anchors, std::size_t k,
                                      Side side) const {
        const double own = anchors[k].at[side];
        double best = own;
        double least = near_;
        for (std::size_t s = 0; s < line.spots.size(); ++s) {
            const double way = line.ways[s];
            if (!is_must(line.spots[s]) || std::abs(way - own) >= least) continue;
            if (way <= anchors[k - 1].at[side] || way >= anchors[k + 1].at[side]) continue;
            best = way;
            least = std::abs(way - own);
        }
        return best;
    }

    void add_musts(const Strip& strip, const Column& before, const Column& after, std::vector<Column>& result) const {
        std::vector<std::pair<double, Side>> shares;
        for (const Side side : {right, left}) {
            const double size = after.at[side] - before.at[side];
            for (std::size_t s = 0; s < strip.sides[side].spots.size(); ++s) {
                const double way = strip.sides[side].ways[s] - before.at[side];
                if (!is_must(strip.sides[side].spots[s]) || way <= roundoff * size || way >= (1.0 - roundoff) * size)
                    continue;
                shares.emplace_back(way / size, side);
            }
        }
        std::sort(shares.begin(), shares.end());
        const double size = std::max(after.at[right] - before.at[right], after.at[left] - before.at[left]);
        for (std::size_t k = 0; k < shares.size(); ++k) {
            std::array<double, 2> pair{shares[k].first, shares[k].first};
            const bool paired = k + 1 < shares.size() && shares[k + 1].second != shares[k].second &&
                                (shares[k + 1].first - shares[k].first) * size < near_;
            if (paired) pair[shares[k + 1].second] = shares[k + 1].first;
            if (paired) ++k;
            const double share = 0.5 * (pair[right] + pair[left]);
            Column column{before.way + share * (after.way - before.way), {}};
            for (const Side side : {right, left})
                column.at[side] = before.at[side] + pair[side] * (after.at[side] - before.at[side]);
            result.push_back(column);
        }
    }

    const SeamMesh& mesh_;
    const SeamWalks& walks_;
    const LevelLine& points_;
    const std::vector<char>& must_;
    double near_;
    RowSizes sizes_;
    std::vector<WalkLine> lines_;
    RowStrips made_;
};

}  // namespace

void LinePart::measure() {
    ways.assign(1, 0.0);
    for (std::size_t k = 1; k < spots.size(); ++k)
        ways.push_back(ways.back() + (spots[k].place - spots[k - 1].place).norm());
}

void LinePart::reverse() {
    std::reverse(spots.begin(), spots.end());
    std::reverse(segments.begin(), segments.end());
    measure();
}

Spot LinePart::at(double way) const {
    const auto after = std::upper_bound(ways.begin(), ways.end(), way) - ways.begin();
    const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, std::ssize(ways) - 2));
    const double step = ways[k + 1] - ways[k];
    const double share = step > 0.0 ? std::clamp((way - ways[k]) / step, 0.0, 1.0) : 0.0;
    if (share * step <= roundoff * length()) return spots[k];
    if ((1.0 - share) * step <= roundoff * length()) return spots[k + 1];
    return {(1.0 - share) * spots[k].place + share * spots[k + 1].place, none, segments[k]};
}

RowStrips row_strips(const SeamMesh& mesh, const SeamWalks& walks, const LevelLine& line, const std::vector<char>& must,
                     const RowSizes& sizes) {
    return Making(mesh, walks, line, must, sizes).made();
}

}  // namespace fairing
