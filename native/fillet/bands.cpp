#include "fillet/bands.h"

#include <map>

namespace fairing {

namespace {

// Where a vertex of the border has its foot; without a band beside meetings, and at walls.
struct Label {
    int band = none;
    int side = none;  // not known yet beside an inner vertex of the seam
    double station = 0.0;
    [[nodiscard]] bool is_like(const Label& other) const { return band == other.band && side == other.side; }
};

class Finding {
public:
    Finding(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line,
            const std::vector<Indices>& loops, const Indices& point_of)
        : mesh_(mesh), distance_(distance), line_(line), loops_(loops), point_of_(point_of), out_(mesh.points.cols()) {
        for (int h = 0; h < mesh.half_edge_count(); ++h) {
            if (mesh.seam[h] != none && mesh.twin[h] != none) out_[mesh.tail(h)].push_back(h);
        }
    }

    Bands found() {
        make_arcs();
        for (std::size_t loop = 0; loop < loops_.size(); ++loop) add_loop(static_cast<int>(loop));
        for (const Run& run : runs_) take(run);
        for (Band& band : made_.bands) measure(band);
        add_corners();
        return std::move(made_);
    }

private:
    // A part of a loop: so many vertices with one label.
    struct Run {
        int loop, first, count;
        Label label;
    };

    [[nodiscard]] bool is_meeting(int v) const { return out_[v].size() != 2; }

    void make_arcs() {
        at_.assign(mesh_.edge.size(), {none, 0});
        for (const bool from_meetings : {true, false}) {
            for (int v = 0; v < static_cast<int>(out_.size()); ++v) {
                if (from_meetings && !is_meeting(v)) continue;
                for (const int h : out_[v]) {
                    if (at_[h][0] == none) add_arc(h);
                }
            }
        }
    }

    void add_arc(int first) {
        SeamArc arc{{first}, {0.0, mesh_.length[first]}, false};
        while (!is_meeting(mesh_.head(arc.half_edges.back()))) {
            const int last = arc.half_edges.back();
            const Indices& out = out_[mesh_.head(last)];
            const int next = out[0] == mesh_.twin[last] ? out[1] : out[0];
            arc.closed = next == first;
            if (arc.closed) break;
            arc.half_edges.push_back(next);
            arc.stations.push_back(arc.stations.back() + mesh_.length[next]);
        }
        const auto number = static_cast<int>(made_.bands.size());
        for (std::size_t k = 0; k < arc.half_edges.size(); ++k) {
            const int h = arc.half_edges[k];
            at_[h] = at_[mesh_.twin[h]] = {number, static_cast<int>(k)};
        }
        made_.bands.push_back({arc, {}, std::numeric_limits<double>::infinity()});
    }

    [[nodiscard]] Label label(int vertex) const {
        const int p = point_of_[vertex];
        if (p == none) return {};
        const SeamFoot foot = distance_.foot(line_.points[p].triangle, line_.points[p].weights);
        if (foot.half_edge == none) return {};
        if (foot.corner) {
            const int v = mesh_.tail(foot.half_edge);
            if (is_meeting(v)) return {};
            const auto [band, k] = at_[out_[v][0]];
            const SeamArc& arc = made_.bands[band].arc;
            return {band, none, arc.stations[mesh_.tail(arc.half_edges[k]) == v ? k : k + 1]};
        }
        const auto [band, k] = at_[foot.half_edge];
        if (band == none) return {};
        const SeamArc& arc = made_.bands[band].arc;
        const bool is_left = arc.half_edges[k] == foot.half_edge;
        return {band, static_cast<int>(is_left ? left : right),
                is_left ? arc.stations[k] + foot.along : arc.stations[k + 1] - foot.along};
    }

    // Beside inner vertices of a seam the border is on the side on which it was before, or will be.
    void settle_sides(std::vector<Label>& labels) const {
        const std::size_t count = labels.size();
        for (std::size_t step = 0; step < 2 * count; ++step) {
            Label& own = labels[step % count];
            const Label& before = labels[(step + count - 1) % count];
            if (own.side == none && own.band == before.band) own.side = before.side;
        }
        for (std::size_t step = 2 * count; step > 0; --step) {
            Label& own = labels[(step - 1) % count];
            const Label& after = labels[step % count];
            if (own.side == none && own.band == after.band) own.side = after.side;
        }
        for (Label& own : labels) own.band = own.side == none ? none : own.band;
    }

    void add_loop(int loop) {
        std::vector<Label> labels;
        for (const int v : loops_[loop]) labels.push_back(label(v));
        settle_sides(labels);
        const auto count = static_cast<int>(labels.size());
        const auto at = [&](int k) -> const Label& { return labels[(k + count) % count]; };
        const auto begins = [&](int k) {
            return !at(k).is_like(at(k - 1)) || (made_.bands[at(k).band].arc.closed && turns_over(at(k - 1), at(k)));
        };
        for (int k = 0; k < count; ++k) {
            if (at(k).band == none || !begins(k)) continue;
            Run run{loop, k, 1, at(k)};
            while (run.count < count && at(k + run.count).is_like(at(k)) && !begins(k + run.count)) ++run.count;
            runs_.push_back(run);
            for (int j = k; j < k + run.count; ++j) stations_[{loop, j % count}] = at(j).station;
        }
    }

    // Over the place where a closed arc begins.
    [[nodiscard]] bool turns_over(const Label& before, const Label& after) const {
        return std::abs(after.station - before.station) > 0.5 * made_.bands[after.band].arc.length();
    }

    [[nodiscard]] int vertex(const Run& run, int k) const {
        const Indices& loop = loops_[run.loop];
        return loop[(run.first + k) % static_cast<int>(loop.size())];
    }

    // The longest run on each side is that of the band.
    void take(const Run& run) {
        Band& band = made_.bands[run.label.band];
        BandSide& side = band.sides[run.label.side];
        if (std::ssize(side.vertices) >= run.count) return;
        side = {};
        const auto size = static_cast<int>(loops_[run.loop].size());
        for (int k = 0; k < run.count; ++k) {
            const int at = run.label.side == right ? k : run.count - 1 - k;
            side.vertices.push_back(vertex(run, at));
            const double station = stations_.at({run.loop, (run.first + at) % size});
            side.stations.push_back(side.stations.empty() ? station : std::max(station, side.stations.back()));
        }
        if (band.arc.closed && run.count == size) {
            side.vertices.push_back(side.vertices.front());
            side.stations.push_back(side.stations.front() + band.arc.length());
        }
    }

    void measure(Band& band) const {
        for (const BandSide& side : band.sides) {
            for (const int v : side.vertices) {
                const LinePoint& point = line_.points[point_of_[v]];
                band.width = std::min(band.width, distance_.at(point.triangle, point.weights).width);
            }
        }
    }

    // Adds the end of the band's side at each vertex where the border leaves it, or comes to it.
    void add_ends(std::map<int, BandEnd>& leaving, std::map<int, BandEnd>& coming) const {
        for (int b = 0; b < static_cast<int>(made_.bands.size()); ++b) {
            const Band& band = made_.bands[b];
            if (band.arc.closed || band.sides[right].vertices.empty() || band.sides[left].vertices.empty()) continue;
            leaving[band.sides[right].vertices.back()] = {b, true};
            leaving[band.sides[left].vertices.front()] = {b, false};
            coming[band.sides[right].vertices.front()] = {b, false};
            coming[band.sides[left].vertices.back()] = {b, true};
        }
    }

    void add_corners() {
        std::map<int, BandEnd> leaving;
        std::map<int, BandEnd> coming;
        add_ends(leaving, coming);
        std::vector<Sector> sectors;
        for (const Indices& loop : loops_) {
            const std::size_t count = loop.size();
            for (std::size_t k = 0; k < count; ++k) {
                if (!leaving.contains(loop[k])) continue;
                Sector sector{leaving.at(loop[k]), {none, false}, {loop[k]}, false};
                std::size_t step = 1;
                for (; step < count && !coming.contains(loop[(k + step) % count]); ++step) {
                    const int v = loop[(k + step) % count];
                    sector.chain.push_back(v);
                }
                if (step == count) continue;
                sector.chain.push_back(loop[(k + step) % count]);
                sector.to = coming.at(sector.chain.back());
                if (sector.from == sector.to) end_at_walls(sector);
                if (meeting_at(sector.from) == meeting_at(sector.to)) sectors.push_back(sector);
            }
        }
        close(sectors);
    }

    // Where a seam ends at a wall square to it, the line's last points there are reached from the end itself: they are
    // the sides'.
    void end_at_walls(Sector& sector) {
        Indices& chain = sector.chain;
        const bool one = chain.size() > 3 && point_of_[chain[1]] != none && point_of_[chain[2]] == none;
        const bool two = chain.size() > 3 && point_of_[chain[chain.size() - 2]] != none &&
                         point_of_[chain[chain.size() - 3]] == none;
        Band& band = made_.bands[sector.from.band];
        const auto extend = [&](Side which, int vertex) {
            BandSide& side = band.sides[which];
            const bool at_end = sector.from.at_last;
            side.vertices.insert(at_end ? side.vertices.end() : side.vertices.begin(), vertex);
            side.stations.insert(at_end ? side.stations.end() : side.stations.begin(),
                                 at_end ? band.arc.length() : 0.0);
        };
        if (one) {
            extend(sector.from.at_last ? right : left, chain[1]);
            chain.erase(chain.begin());
        }
        if (two) {
            extend(sector.from.at_last ? left : right, chain[chain.size() - 2]);
            chain.pop_back();
        }
        sector.along_walls = chain.size() > 2 && std::all_of(chain.begin() + 1, chain.end() - 1,
                                                             [&](int v) { return point_of_[v] == none; });
    }

    [[nodiscard]] int meeting_at(const BandEnd& end) const {
        const Indices& run = made_.bands[end.band].arc.half_edges;
        return end.at_last ? mesh_.head(run.back()) : mesh_.tail(run.front());
    }

    // Sectors that follow each other all around a vertex, each seam there once.
    void close(const std::vector<Sector>& sectors) {
        std::vector<char> used(sectors.size(), 0);
        for (std::size_t first = 0; first < sectors.size(); ++first) {
            std::vector<Sector> corner;
            for (std::size_t k = first; k < sectors.size() && used[k] == 0;) {
                used[k] = 1;
                corner.push_back(sectors[k]);
                k = 0;
                while (k < sectors.size() && !(sectors[k].from == corner.back().to)) ++k;
            }
            if (corner.empty() || !(corner.back().to == corner.front().from)) continue;
            if (corner.size() == out_[meeting_at(corner.front().from)].size()) made_.corners.push_back(corner);
        }
    }

    const SeamMesh& mesh_;
    const SeamDistance& distance_;
    const LevelLine& line_;
    const std::vector<Indices>& loops_;
    const Indices& point_of_;
    std::vector<Indices> out_;            // of each vertex: the half-edges on seams that begin there
    std::vector<std::array<int, 2>> at_;  // of each half-edge on a seam: its arc, and its place in it
    std::vector<Run> runs_;
    std::map<std::array<int, 2>, double> stations_;  // of places in loops
    Bands made_;
};

}  // namespace

Bands bands_of(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line,
               const std::vector<Indices>& loops, const Indices& point_of) {
    return Finding(mesh, distance, line, loops, point_of).found();
}

}  // namespace fairing
