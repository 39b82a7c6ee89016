#include "fillet/row_strip.h"

#include <Eigen/Geometry>

#include "base/progress.h"
#include "fillet/limits.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

// Share of the bulge over a column's chord: where the surface leaves the quads between two columns by more, another one
// comes between.
constexpr double bent = 0.6;         // where strips meet at corners it is up to .47, between vertices of a ring less
constexpr double flat = 0.02;        // of the width: what bulges less is flat
constexpr double shortest = 0.5;     // of the width: columns as near as that get none between them
constexpr double near_column = 0.1;  // of the width: columns are no nearer to each other at the border
constexpr double pairing = 0.2;      // of the width: so much further a vertex that an edge outside needs is taken
constexpr double skew = 0.4;         // of the width: a column leads no further along the seam
constexpr double seen = 1.05;        // of width · tan(turn / 2): as far along are feet of what lies across from a turn
constexpr std::size_t fewest = 5;    // columns of a closed strip, the first one twice

double station_of(const RowStrip& strip, const Pair& at) {
    return 0.5 * (strip.sides[right].stations[at[right]] + strip.sides[left].stations[at[left]]);
}

double turn_at(const SeamMesh& mesh, const SeamArc& arc, std::size_t k) {
    const auto chord = [&](int h) { return Vector3(mesh.points.col(mesh.head(h)) - mesh.points.col(mesh.tail(h))); };
    const std::size_t count = arc.half_edges.size();
    return radians_between(chord(arc.half_edges[(k + count - 1) % count]), chord(arc.half_edges[k]));
}

// Where the rows of a closed seam begin: where it turns, or across from an edge outside.
double begin_of(const SeamMesh& mesh, const Band& band, const std::vector<char>& must) {
    for (std::size_t k = 0; k < band.arc.half_edges.size(); ++k) {
        if (turn_at(mesh, band.arc, k) >= corner_angle) return band.arc.stations[k];
    }
    for (const BandSide& side : band.sides) {
        const auto found = std::ranges::find_if(side.vertices, [&](int v) { return must[v] != 0; });
        if (found != side.vertices.end()) return side.stations[found - side.vertices.begin()];
    }
    return band.sides[right].stations.front();
}

}  // namespace

Pair RowStrip::last_pair() const {
    return {static_cast<int>(sides[right].vertices.size()) - 1, static_cast<int>(sides[left].vertices.size()) - 1};
}

void RowStrip::turn_to(const Pair& at) {
    for (const Side side : {right, left}) {
        BandSide& own = sides[side];
        own.vertices.pop_back();
        own.stations.pop_back();
        const auto begin = at[side] % std::ssize(own.vertices);
        for (int k = 0; k < begin; ++k) own.stations[k] += arc->length();
        std::rotate(own.vertices.begin(), own.vertices.begin() + begin, own.vertices.end());
        std::rotate(own.stations.begin(), own.stations.begin() + begin, own.stations.end());
        own.vertices.push_back(own.vertices.front());
        own.stations.push_back(own.stations.front() + arc->length());
    }
}

RowStrip strip_of(const SeamMesh& mesh, const Band& band, const std::vector<char>& must) {
    RowStrip strip{&band.arc, band.sides, band.width, band.arc.closed, {RowEnd::open, RowEnd::open}, {}, {},
                   {},        {},         {}};
    for (const BandSide& side : band.sides)
        strip.closed = strip.closed && side.vertices.size() > 3 && side.vertices.front() == side.vertices.back();
    if (!strip.closed) return strip;
    const double length = band.arc.length();
    const double station = begin_of(mesh, band, must);
    Pair at{};
    for (const Side side : {right, left}) {
        BandSide& own = strip.sides[side];
        const auto off = [&](int k) {
            const double bonus = must[own.vertices[k]] != 0 ? pairing * band.width : 0.0;
            return std::abs(std::remainder(own.stations[k] - station, length)) - bonus;
        };
        for (int k = 1; k + 1 < std::ssize(own.vertices); ++k) {
            if (off(k) < off(at[side])) at[side] = k;
        }
        int last = at[side];  // of several that are reached from one place the middle one
        while (last + 2 < std::ssize(own.vertices) && off(last + 1) == off(at[side])) ++last;
        at[side] = (at[side] + last) / 2;
        const double laps = std::round((own.stations[at[side]] - station) / length);
        for (double& each : own.stations) each -= laps * length;
    }
    strip.turn_to(at);
    return strip;
}

void add_quads(const std::vector<Indices>& grid, std::vector<Quad>& quads) {
    for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
        for (std::size_t j = 0; j + 1 < grid[i].size(); ++j)
            quads.push_back({grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]});
    }
}

Vector3 RowColumns::on_seam(const SeamArc& arc, double station, int& half_edge) const {
    const double on_arc = arc.closed ? station - arc.length() * std::floor(station / arc.length()) : station;
    const auto after = std::upper_bound(arc.stations.begin(), arc.stations.end(), on_arc) - arc.stations.begin();
    const auto k = std::clamp<std::ptrdiff_t>(after - 1, 0, std::ssize(arc.half_edges) - 1);
    half_edge = arc.half_edges[k];
    const double along = std::clamp((on_arc - arc.stations[k]) / mesh_.length[half_edge], 0.0, 1.0);
    return (1.0 - along) * mesh_.points.col(mesh_.tail(half_edge)) + along * mesh_.points.col(mesh_.head(half_edge));
}

void RowColumns::lift(int vertex, const SeamArc& arc, double station) {
    int half_edge = none;
    const Vector3 before = on_seam(arc, station, half_edge);
    surface_.lift(vertex, half_edge, before);
}

// On the conic that is tangent to the sides' lines to the seam: between planes it is the arc.
Column RowColumns::column(const RowStrip& strip, const Crossing& crossing) {
    const int from = strip.sides[right].vertices[crossing.at[right]];
    const int to = strip.sides[left].vertices[crossing.at[left]];
    int half_edge = none;
    const Vector3 seam = on_seam(*strip.arc, crossing.station, half_edge);
    const Vector3 come = surface_.place(from) - seam;
    const Vector3 go = surface_.place(to) - seam;
    const double weight = std::sin(0.5 * radians_between(come, go));  // a circle's, between sides of one length
    const auto conic = [&](double t) {
        const double begin = (1.0 - t) * (1.0 - t);
        return Vector3(seam + (begin * come + t * t * go) / (begin + 2.0 * weight * t * (1.0 - t) + t * t));
    };
    Column made{crossing.at, crossing.station, surface_.along(conic, rows_)};
    surface_.lift(made.ids[rows_ / 2 - 1], half_edge, seam);
    made.ids.insert(made.ids.begin(), from);
    made.ids.push_back(to);
    return made;
}

// The vertex on a side that is nearest to a station; one that an edge outside needs comes first if it is near, too.
int RowColumns::nearest(const RowStrip& strip, Side which, double station) const {
    const BandSide& side = strip.sides[which];
    const auto off = [&](int k) {
        return std::abs(side.stations[k] - station) - (must_[side.vertices[k]] != 0 ? pairing * strip.width : 0.0);
    };
    int best = 0;
    for (int k = 1; k < std::ssize(side.stations); ++k) {
        if (off(k) < off(best)) best = k;
    }
    int last = best;  // of several that are reached from one place, as around a corner, the middle one
    while (last + 1 < std::ssize(side.stations) && off(last + 1) == off(best)) ++last;
    return (best + last) / 2;
}

// Turns at the seam's inner vertices.
std::vector<RowColumns::Turn> RowColumns::turns(const SeamArc& arc, double from) const {
    std::vector<Turn> found;
    const std::size_t count = arc.half_edges.size();
    for (std::size_t k = arc.closed ? 0 : 1; k < count; ++k) {
        const double angle = turn_at(mesh_, arc, k);
        const double first = arc.closed ? std::floor((from - arc.stations[k]) / arc.length()) : 0.0;
        for (int lap = 0; lap < (arc.closed ? 3 : 1); ++lap)
            found.push_back({arc.stations[k] + (first + lap) * arc.length(), angle});
    }
    return found;
}

// A point across from a turn has its foot next to it: the column leads over the turn.
double RowColumns::over_turn(double station, const std::vector<Turn>& turns, double width) {
    for (const auto& [at, angle] : turns) {
        if (std::abs(station - at) <= seen * width * std::tan(0.5 * angle)) station = at;
    }
    return station;
}

// Where the seam turns, and across from each vertex that an edge outside needs.
std::vector<RowColumns::Crossing> RowColumns::wanted(const RowStrip& strip, const Pair& first, const Pair& last,
                                                     const std::vector<Turn>& turns) const {
    std::vector<Crossing> found;
    for (const auto& [at, angle] : turns) {
        if (angle >= corner_angle) found.push_back({{nearest(strip, right, at), nearest(strip, left, at)}, at});
    }
    for (const Side side : {right, left}) {
        const BandSide& own = strip.sides[side];
        const Side other = side == right ? left : right;
        const BandSide& across = strip.sides[other];
        for (int k = first[side] + 1; k < last[side]; ++k) {
            if (must_[own.vertices[k]] == 0) continue;
            Pair at{};
            at[side] = k;
            at[other] = nearest(strip, other, own.stations[k]);
            if (std::abs(across.stations[at[other]] - own.stations[k]) <= skew * strip.width)
                found.push_back({at, over_turn(station_of(strip, at), turns, strip.width)});
        }
    }
    std::ranges::stable_sort(found, {}, &Crossing::station);
    return found;
}

bool RowColumns::is_clear(const RowStrip& strip, const Crossing& one, const Crossing& two) const {
    return two.station > one.station && std::ranges::all_of(std::array{right, left}, [&](Side side) {
               const Indices& own = strip.sides[side].vertices;
               return two.at[side] > one.at[side] &&
                      surface_.length_before(own[two.at[side]], own[one.at[side]]) >= near_column * strip.width;
           });
}

std::vector<Column> RowColumns::columns(const RowStrip& strip, const Pair& first, const Pair& last,
                                        const std::array<Indices, 2>& given) {
    const double from = station_of(strip, first);
    const std::vector<Turn> turned = turns(*strip.arc, from);
    const Crossing begin{first, strip.closed ? over_turn(from, turned, strip.width) : from};
    const Crossing end{last, strip.closed ? begin.station + strip.arc->length() : station_of(strip, last)};
    std::vector<Crossing> crossings{begin};
    for (const Crossing& each : wanted(strip, first, last, turned)) {
        if (is_clear(strip, crossings.back(), each) && is_clear(strip, each, end)) crossings.push_back(each);
    }
    std::vector<Column> made;
    made.reserve(crossings.size() + 1);
    for (const Crossing& each : crossings) made.push_back(column(strip, each));
    made.push_back(strip.closed ? Column{end.at, end.station, made.front().ids} : column(strip, end));
    if (!given[0].empty()) made.front().ids = given[0];
    if (!given[1].empty()) made.back().ids = given[1];
    for (std::size_t k = 0; k + 1 < made.size();) {  // more where the surface is not straight
        checkpoint();
        const std::optional<Crossing> at = between(strip, made[k], made[k + 1]);
        const std::optional<Column> middle = at ? std::optional(column(strip, *at)) : std::nullopt;
        if (middle && (is_bent(made[k], *middle, made[k + 1], strip.width) || (strip.closed && made.size() < fewest)))
            made.insert(made.begin() + static_cast<std::ptrdiff_t>(k) + 1, *middle);
        else
            ++k;
    }
    return made;
}

// Half way between two columns, where these are not near.
std::optional<RowColumns::Crossing> RowColumns::between(const RowStrip& strip, const Column& one,
                                                        const Column& two) const {
    Crossing found{{}, 0.5 * (one.station + two.station)};
    if (two.station - one.station <= shortest * strip.width) return std::nullopt;
    for (const Side side : {right, left}) {
        if (two.at[side] - one.at[side] < 2) return std::nullopt;
        found.at[side] = half_way(strip.sides[side], one.at[side], two.at[side]);
    }
    return found;
}

int RowColumns::half_way(const BandSide& side, int begin, int end) const {
    std::vector<double> lengths{0.0};
    for (int k = begin; k < end; ++k)
        lengths.push_back(lengths.back() + surface_.length_before(side.vertices[k + 1], side.vertices[k]));
    const auto found = std::lower_bound(lengths.begin(), lengths.end(), 0.5 * lengths.back()) - lengths.begin();
    return std::clamp(begin + static_cast<int>(found), begin + 1, end - 1);
}

bool RowColumns::is_bent(const Column& one, const Column& middle, const Column& two, double width) const {
    const auto at = [&](int v) { return surface_.place(v); };
    const double share = two.station > one.station ? (middle.station - one.station) / (two.station - one.station) : 0.5;
    const Vector3 chord = 0.5 * (at(middle.ids.front()) + at(middle.ids.back()));
    double off = 0.0;
    double bulge = std::numeric_limits<double>::infinity();
    for (std::size_t j = 1; j + 1 < middle.ids.size(); ++j) {
        const Vector3 along = (at(two.ids[j]) - at(one.ids[j])).normalized();
        const Vector3 leaves = at(middle.ids[j]) - (1.0 - share) * at(one.ids[j]) - share * at(two.ids[j]);
        off = std::max(off, (leaves - leaves.dot(along) * along).norm());
        bulge = std::min(bulge, (at(middle.ids[j]) - chord).norm());
    }
    return off > std::max(bent * bulge, flat * width);
}

}  // namespace fairing
