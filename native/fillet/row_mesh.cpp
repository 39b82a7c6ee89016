#include "fillet/row_mesh.h"

#include <Eigen/Geometry>

#include "fillet/row_pieces.h"

namespace fairing {

namespace {

constexpr double round_corner = 0.6;  // of the width: a longer path around a corner is a side of its own
constexpr double least_spoke = 0.1;   // of the width: so far from a corner a strip ends, or more

class Making {
public:
    Making(const SeamMesh& mesh, const Bands& bands, const std::vector<char>& must, int rows, RowSurface& surface)
        : bands_(bands),
          half_(rows / 2),
          surface_(surface),
          columns_(mesh, must, rows, surface),
          corners_(bands.corners.size()) {
        for (const Band& band : bands.bands) {
            strips_.push_back({strip_of(mesh, band, must)});
            strips_.back().fails = band.sides[right].vertices.size() < 2 || band.sides[left].vertices.size() < 2;
        }
        for (std::size_t c = 0; c < corners_.size(); ++c) prepare(c);
    }

    // A piece that fails takes the pieces that it meets along: these then end before it.
    RowMesh made() {
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t b = 0; b < strips_.size(); ++b) changed = settle_strip(b) || changed;
            for (std::size_t c = 0; c < corners_.size(); ++c) changed = settle_corner(c) || changed;
        }
        RowMesh made;
        const auto append = [](const auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); };
        for (const Strip& strip : strips_) {
            if (strip.fails) continue;
            append(strip.rows.quads, made.quads);
            append(strip.rows.triangles, made.triangles);
            append(strip.rows.edges, made.ends);
        }
        for (const Corner& corner : corners_) {
            if (!corner.fails) append(corner.quads, made.quads);
        }
        return made;
    }

private:
    struct Strip {
        RowStrip rows;
        bool fails = false, is_laid = false;
    };
    struct Corner {
        bool fails = true, is_laid = false;
        std::vector<Quad> quads;
    };

    void prepare(std::size_t c) {
        const std::vector<Sector>& sectors = bands_.corners[c];
        const bool fails =
            std::ranges::any_of(sectors, [&](const Sector& each) { return strips_[each.from.band].fails; });
        if (fails) return;
        if (sectors.size() == 1) return prepare_wall(sectors.front());
        const auto is_good = [&](const Sector& each) { return is_short(each) || std::ssize(each.chain) > 2 * half_; };
        if (!std::ranges::all_of(sectors, is_good)) return;
        corners_[c].fails = false;
        for (const Sector& sector : sectors) {
            strips_[sector.from.band].rows.ends[sector.from.at_last ? 1 : 0] = RowEnd::corner;
            if (is_short(sector)) join_sides(sector);
        }
    }

    void prepare_wall(const Sector& sector) {
        if (!sector.along_walls) return;
        RowStrip& strip = strips_[sector.from.band].rows;
        const int which = sector.from.at_last ? 1 : 0;
        strip.ends[which] = RowEnd::wall;
        strip.walls[which] = sector.chain;
        if (which == 0) std::reverse(strip.walls[which].begin(), strip.walls[which].end());
    }

    [[nodiscard]] bool is_short(const Sector& sector) const {
        double length = 0.0;
        for (std::size_t k = 0; k + 1 < sector.chain.size(); ++k)
            length += surface_.length_before(sector.chain[k + 1], sector.chain[k]);
        return length <= round_corner * strips_[sector.from.band].rows.width;
    }

    // Sides that meet around a corner end in one vertex, where the border turns most.
    void join_sides(const Sector& sector) {
        const Indices& chain = sector.chain;
        const auto middle = std::ranges::max_element(chain, {}, [&](int v) {
            const Vector3 come = surface_.before(v) - surface_.before(surface_.previous(v));
            const Vector3 go = surface_.before(surface_.next(v)) - surface_.before(v);
            return come.cross(go).norm() / std::max(come.norm() * go.norm(), std::numeric_limits<double>::min());
        });
        for (auto v = chain.begin(); v != middle; ++v) extend(sector.from, sector.from.at_last ? right : left, v[1]);
        for (auto v = chain.end() - 1; v != middle; --v) extend(sector.to, sector.to.at_last ? left : right, v[-1]);
    }

    void extend(const BandEnd& end, Side which, int vertex) {
        RowStrip& strip = strips_[end.band].rows;
        auto& [vertices, stations] = strip.sides[which];
        if (end.at_last) {
            const double step = surface_.length_before(vertex, vertices.back());
            vertices.push_back(vertex);
            stations.push_back(std::max(stations.back(), std::min(strip.arc->length(), stations.back() + step)));
        } else {
            const double step = surface_.length_before(vertex, vertices.front());
            vertices.insert(vertices.begin(), vertex);
            stations.insert(stations.begin(), std::min(stations.front(), std::max(0.0, stations.front() - step)));
        }
    }

    // Whether anything changed.
    bool settle_strip(std::size_t b) {
        Strip& strip = strips_[b];
        if (strip.fails || strip.is_laid) return false;
        try {
            RowPieces(columns_, surface_, 2 * half_, strip.rows, static_cast<int>(b)).lay();
            strip.is_laid = true;
            for (const std::size_t c : corners_at(b)) corners_[c].is_laid = false;
        } catch (const NoRows&) {
            strip.fails = strip.rows.ends == std::array{RowEnd::open, RowEnd::open};
            strip.rows.ends = {RowEnd::open, RowEnd::open};
            for (const std::size_t c : corners_at(b)) give_up(c);
        }
        return true;
    }

    bool settle_corner(std::size_t c) {
        Corner& corner = corners_[c];
        if (corner.fails || corner.is_laid) return false;
        try {
            corner.quads.clear();
            lay(bands_.corners[c], corner.quads);
            corner.is_laid = true;
        } catch (const NoRows&) {
            give_up(c);
        }
        return true;
    }

    [[nodiscard]] std::vector<std::size_t> corners_at(std::size_t b) const {
        std::vector<std::size_t> found;
        for (std::size_t c = 0; c < corners_.size(); ++c) {
            const auto is_there = [&](const Sector& each) { return each.from.band == static_cast<int>(b); };
            if (std::ranges::any_of(bands_.corners[c], is_there)) found.push_back(c);
        }
        return found;
    }

    // Its bands end before it.
    void give_up(std::size_t c) {
        if (corners_[c].fails) return;
        corners_[c].fails = true;
        for (const Sector& sector : bands_.corners[c]) {
            Strip& strip = strips_[sector.from.band];
            strip.rows.ends[sector.from.at_last ? 1 : 0] = RowEnd::open;
            strip.is_laid = false;
        }
    }

    [[nodiscard]] const Column& last_column(const BandEnd& end) const {
        const Strip& strip = strips_[end.band];
        if (!strip.is_laid) throw NoRows();
        return strip.rows.last[end.at_last ? 1 : 0];
    }

    // From a corner along the seam to the column where its strip ends.
    Indices spoke(const BandEnd& end, int middle) {
        const SeamArc& arc = bands_.bands[end.band].arc;
        const Column& column = last_column(end);
        const double from = end.at_last ? arc.length() : 0.0;
        if (std::abs(column.station - from) < least_spoke * strips_[end.band].rows.width) throw NoRows();
        Indices found = surface_.between(middle, column.ids[half_], half_);
        for (int k = 1; k < half_; ++k) columns_.lift(found[k - 1], arc, from + (column.station - from) * k / half_);
        found.insert(found.begin(), middle);
        found.push_back(column.ids[half_]);
        return found;
    }

    // From the middle of the last column to the side that the border leaves, or comes to.
    [[nodiscard]] Indices half_column(const BandEnd& end, bool leaves) const {
        const Indices& ids = last_column(end).ids;
        return leaves == end.at_last ? Indices(ids.rbegin() + half_, ids.rend())
                                     : Indices(ids.begin() + half_, ids.end());
    }

    // Blocks around a pole: one in each sector, two where the path around it is long.
    void lay(const std::vector<Sector>& sectors, std::vector<Quad>& quads) {
        Vector3 sum = Vector3::Zero();
        for (const Sector& sector : sectors) sum += surface_.place(last_column(sector.from).ids[half_]);
        const int middle = surface_.add(sum / static_cast<double>(sectors.size()));
        const BandEnd& first = sectors.front().from;
        const SeamArc& arc = bands_.bands[first.band].arc;
        columns_.lift(middle, arc, first.at_last ? arc.length() : 0.0);
        std::vector<Indices> spokes;
        spokes.reserve(sectors.size());
        for (const Sector& sector : sectors) spokes.push_back(spoke(sector.from, middle));
        for (std::size_t k = 0; k < sectors.size(); ++k) {
            const Indices& from = spokes[k];
            const Indices& to = spokes[(k + 1) % sectors.size()];
            const Indices come = half_column(sectors[k].from, true);
            const Indices go = half_column(sectors[k].to, false);
            if (come.back() == go.back()) {
                add_block(from, to, come, go, quads);
                continue;
            }
            const Indices around = parted(sectors[k].chain);
            Indices across = surface_.between(middle, around[half_], half_);
            across.insert(across.begin(), middle);
            across.push_back(around[half_]);
            add_block(from, across, come, Indices(around.rend() - half_ - 1, around.rend()), quads);
            add_block(across, to, Indices(around.begin() + half_, around.end()), go, quads);
        }
        if (!surface_.are_good(quads)) throw NoRows();
    }

    // As many of the vertices as there are rows, evenly.
    [[nodiscard]] Indices parted(const Indices& chain) const {
        Indices found;
        const auto edges = static_cast<double>(chain.size() - 1);
        for (int k = 0; k <= 2 * half_; ++k) found.push_back(chain[std::lround(k * edges / (2 * half_))]);
        return found;
    }

    // By its sides from `along`'s begin and end on: both lead to the corner opposite. Inner vertices by transfinite
    // interpolation (Gordon & Hall 1973).
    void add_block(const Indices& along, const Indices& across, const Indices& far_across, const Indices& far_along,
                   std::vector<Quad>& quads) {
        std::vector<Indices> grid(along.size(), Indices(across.size(), none));
        for (std::size_t i = 0; i < along.size(); ++i) {
            grid[i].front() = along[i];
            grid[i].back() = far_along[i];
        }
        grid.front() = across;
        grid.back() = far_across;
        const int n = half_;
        const auto at = [&](int i, int j) { return surface_.place(grid[i][j]); };
        for (int i = 1; i < n; ++i) {
            for (int j = 1; j < n; ++j) {
                const double u = static_cast<double>(i) / n;
                const double v = static_cast<double>(j) / n;
                const Vector3 sides = (1.0 - u) * at(0, j) + u * at(n, j) + (1.0 - v) * at(i, 0) + v * at(i, n);
                const Vector3 corners =
                    (1.0 - u) * ((1.0 - v) * at(0, 0) + v * at(0, n)) + u * ((1.0 - v) * at(n, 0) + v * at(n, n));
                grid[i][j] = surface_.add(sides - corners);
            }
        }
        add_quads(grid, quads);
    }

    const Bands& bands_;
    int half_;
    RowSurface& surface_;
    RowColumns columns_;
    std::vector<Strip> strips_;
    std::vector<Corner> corners_;
};

}  // namespace

RowMesh row_mesh(const SeamMesh& mesh, const Bands& bands, const std::vector<char>& must, int rows,
                 RowSurface& surface) {
    return Making(mesh, bands, must, rows, surface).made();
}

}  // namespace fairing
