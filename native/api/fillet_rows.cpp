#include "api/fillet_rows.h"

#include <map>
#include <set>

#include "api/kept_skin.h"
#include "api/prepared_fillet.h"
#include "base/columns.h"
#include "fillet/limits.h"
#include "fillet/row_cut.h"
#include "fillet/row_mesh.h"
#include "geometry/target_surface.h"
#include "mesh/loops.h"

namespace fairing {

namespace {

constexpr double whatever = -1.0;  // of triangles in a quad's place: there is no other way

// The surface as curved triangles.
class SmoothSurface {
public:
    explicit SmoothSurface(const FilletSurface& surface)
        : surface_(surface),
          input_{surface.vertices, surface.triangles, surface.fixed, surface.normals},
          mesh_(check_mesh(input_)),
          patches_(patches_with_vertices(mesh_)),
          at_(static_cast<std::size_t>(surface.triangles.cols()), {none, none}) {
        for (const Patch& patch : patches_) {
            const int number = static_cast<int>(parts_.size());
            parts_.push_back(std::make_unique<Part>(input_, mesh_, patch));
            for (int t = 0; t < patch.triangle_count(); ++t) at_[patch.input_triangle[t]] = {number, t};
        }
    }

    [[nodiscard]] Vector3 place(const NearestPlace& under) const {
        const auto [number, t] = at_[under.triangle];
        if (number == none)
            return surface_.vertices(Eigen::all, surface_.triangles.col(under.triangle)) * under.weights;
        const Part& part = *parts_[number];
        const auto corners = part.old.patch.triangles.col(t);
        Vector3 weights;  // in the patch's order of corners
        for (int k = 0; k < 3; ++k) {
            const int v = part.old.patch.to_input[corners[k]];
            for (int c = 0; c < 3; ++c) {
                if (surface_.triangles(c, under.triangle) == v) weights[k] = under.weights[c];
            }
        }
        return part.old.unit.from_unit(Points(part.target.position({t, weights})));
    }

private:
    struct Part {
        Part(const MeshInput& input, const CheckedMesh& mesh, const Patch& patch)
            : old(input, mesh, patch), target(old.patch, old.points, old.normals) {}
        const OldSurface old;
        const TargetSurface target;
    };

    const FilletSurface& surface_;
    const MeshInput input_;
    const CheckedMesh mesh_;
    const std::vector<Patch> patches_;
    std::vector<std::unique_ptr<const Part>> parts_;
    std::vector<std::array<int, 2>> at_;  // of each triangle: its patch, and its number there
};

// For each point of a line: whether an edge that counts comes to it, or a vertex is there.
std::vector<char> needed_outside(const SeamMesh& mesh, const LevelLine& line, const WantedRows& wanted) {
    std::map<int, VertexPair> ends;
    const auto sorted = [](int a, int b) { return VertexPair{std::min(a, b), std::max(a, b)}; };
    for (int h = 0; h < mesh.half_edge_count(); ++h) ends[mesh.edge[h]] = sorted(mesh.tail(h), mesh.head(h));
    std::set<VertexPair> counted;
    for (const auto& [a, b] : wanted.counted.value_or(std::vector<VertexPair>{})) counted.insert(sorted(a, b));
    std::vector<char> result;
    for (const LinePoint& point : line.points) {
        const bool counts = point.edge != none && (!wanted.counted || counted.contains(ends.at(point.edge)));
        result.push_back(point.vertex != none || counts ? 1 : 0);
    }
    return result;
}

class Rows {
public:
    Rows(const FilletInput& given, const WantedRows& wanted, const FilletSurface& surface)
        : given_(given),
          surface_(surface),
          made_(given),
          line_(fillet_line(made_)),
          smooth_(surface),
          carried_([this](const NearestPlace& under) { return smooth_.place(under); }) {
        rows_.cut.mesh = cut_along(made_.mesh, made_.distance, line_);
        rows_.cut.mesh.inside = surface.inside;
        const auto count = static_cast<int>(surface.vertices.cols());
        must_.assign(count, 1);
        Indices point_of(count, none);
        std::set<int> on_line;
        for (const LineSegment& segment : line_.segments) on_line.insert({segment.from, segment.to});
        const std::vector<char> needed = needed_outside(made_.mesh, line_, wanted);
        int number = static_cast<int>(given.vertices.cols());
        for (int p = 0; p < std::ssize(line_.points); ++p) {
            const int vertex = line_.points[p].vertex != none ? line_.points[p].vertex : number++;
            if (!on_line.contains(p)) continue;
            point_of[vertex] = p;
            must_[vertex] = needed[p];
        }
        loops_ = boundary_loops(surface.triangles, count);
        const Bands bands = bands_of(made_.mesh, made_.distance, line_, loops_, point_of);
        const int rows = 2 * std::max(1, static_cast<int>(std::lround(made_.largest_width / wanted.spacing)));
        on_ = std::make_unique<RowSurface>(surface.vertices, surface.triangles, surface.before, loops_, carried_);
        mesh_ = row_mesh(made_.mesh, bands, must_, rows, *on_);
    }

    std::optional<FilletRows> found() {
        if (mesh_.quads.empty()) return std::nullopt;
        close_line();
        add_rest();
        if (!is_whole()) return std::nullopt;
        rows_.triangles = as_columns(triangles_);
        put();
        finish_cut(given_, made_, rows_.cut);
        return std::move(rows_);
    }

private:
    // Where quads pass over points of the line, these go; where they can't, triangles are in the quad's place.
    void close_line() {
        std::map<int, int> next;
        for (const Indices& loop : loops_) {
            for (std::size_t k = 0; k < loop.size(); ++k) next[loop[k]] = loop[(k + 1) % loop.size()];
        }
        std::set<VertexPair> sides;
        for (const auto& quad : mesh_.quads) {
            for (std::size_t k = 0; k < 4; ++k) sides.insert({quad[k], quad[(k + 1) % 4]});
        }
        Points vertices(3, given_.vertices.cols() + rows_.cut.mesh.points.cols());
        vertices << given_.vertices, rows_.cut.mesh.points;
        ClosedPieces pieces(vertices, rows_.cut.mesh);
        for (const auto& quad : mesh_.quads) {
            bool whole = true;
            for (std::size_t k = 0; k < 4; ++k) {
                const int a = quad[k];
                const int b = quad[(k + 1) % 4];
                if (!next.contains(a) || !next.contains(b) || sides.contains({b, a})) continue;
                Indices passed;
                for (int v = next.at(a); v != b && passed.size() < next.size(); v = next.at(v)) passed.push_back(v);
                covered_.insert({a, next.at(a)});
                for (const int v : passed) covered_.insert({v, next.at(v)});
                if (passed.empty() || !whole) continue;
                const Indices kept = left_of(passed, pieces);
                if (kept.empty()) continue;
                whole = false;
                Indices from{a};
                from.insert(from.end(), kept.begin(), kept.end());
                from.insert(from.end(), {b, quad[(k + 2) % 4], quad[(k + 3) % 4]});
                const auto at = [&](int v) { return on_->place(v); };
                const Vector3 up = (at(quad[2]) - at(quad[0])).cross(at(quad[3]) - at(quad[1]));
                for (const Eigen::Vector3i& each : roundest(from, at, [&](int) { return up; }, whatever))
                    triangles_.push_back(each);
            }
            if (whole) rows_.quads.push_back(quad);
        }
        pieces.finish();
    }

    // Those of some points of the line that can't go.
    [[nodiscard]] Indices left_of(const Indices& passed, ClosedPieces& pieces) const {
        Indices kept;
        Indices group;
        const auto drop = [&] {
            if (!group.empty() && !pieces.drop(group)) kept.insert(kept.end(), group.begin(), group.end());
            group.clear();
        };
        for (const int v : passed) {
            if (must_[v] == 0) {
                group.push_back(v);
                continue;
            }
            drop();
            kept.push_back(v);
        }
        drop();
        return kept;
    }

    // The surface's triangles that rows don't cover, and those where these end.
    void add_rest() {
        for (const Eigen::Vector3i& t : mesh_.triangles) {
            triangles_.push_back(t);
            for (int k = 0; k < 3; ++k) zipped_.insert({t[k], t[(k + 1) % 3]});
        }
        std::map<VertexPair, int> at;
        for (int t = 0; t < surface_.triangles.cols(); ++t) {
            for (int k = 0; k < 3; ++k) at[{surface_.triangles(k, t), surface_.triangles((k + 1) % 3, t)}] = t;
        }
        std::set<VertexPair> ends;
        for (const auto& [a, b] : mesh_.ends) ends.insert({{a, b}, {b, a}});
        std::vector<char> gone(static_cast<std::size_t>(surface_.triangles.cols()), 0);
        Indices open;
        const auto take = [&](const VertexPair& side) {
            const auto found = at.find(side);
            if (found == at.end() || gone[found->second] != 0) return;
            gone[found->second] = 1;
            open.push_back(found->second);
        };
        for (const VertexPair& side : covered_) take(side);
        for (const VertexPair& side : zipped_) {
            if (at.contains(side) && !at.contains({side[1], side[0]})) take(side);
        }
        while (!open.empty()) {
            const int t = open.back();
            open.pop_back();
            for (int k = 0; k < 3; ++k) {
                const VertexPair side{surface_.triangles((k + 1) % 3, t), surface_.triangles(k, t)};
                if (!ends.contains(side)) take(side);
            }
        }
        for (int t = 0; t < std::ssize(gone); ++t) {
            if (gone[t] == 0) triangles_.emplace_back(surface_.triangles.col(t));
        }
    }

    // Whether the new faces and the pieces outside still fit.
    [[nodiscard]] bool is_whole() const {
        std::set<VertexPair> sides;
        bool twice = false;
        const auto add = [&](int a, int b) { twice = !sides.insert({a, b}).second || twice; };
        for (const auto& quad : rows_.quads) {
            for (std::size_t k = 0; k < 4; ++k) add(quad[k], quad[(k + 1) % 4]);
        }
        for (const Eigen::Vector3i& t : triangles_) {
            for (int k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3]);
        }
        std::set<int> border;
        for (const Indices& loop : loops_) border.insert(loop.begin(), loop.end());
        return !twice && std::all_of(sides.begin(), sides.end(), [&](const VertexPair& side) {
            return sides.contains({side[1], side[0]}) || (border.contains(side[0]) && border.contains(side[1]));
        });
    }

    void put() {
        const auto count = static_cast<Eigen::Index>(on_->made().size());
        rows_.places.resize(3, count);
        rows_.on_solved.resize(3, count);
        rows_.on_given.resize(3, count);
        Indices near;  // triangles that the fillet reaches
        for (int t = 0; t < made_.mesh.triangles.cols(); ++t) {
            if (made_.distance.reaches(t)) near.push_back(t);
        }
        const NearestTriangles beneath(made_.mesh.points, made_.mesh.triangles, near);
        for (Eigen::Index k = 0; k < count; ++k) {
            const RowVertex& vertex = on_->made()[static_cast<std::size_t>(k)];
            const Vector3 before =
                surface_.before(Eigen::all, surface_.triangles.col(vertex.under.triangle)) * vertex.under.weights;
            const NearestPlace found = beneath.to(before);
            const GivenPlace origin = vertex.half_edge == none
                                          ? given_place(given_, made_, found.triangle, found.foot)
                                          : given_place(given_, made_, vertex.half_edge / 3, vertex.before);
            rows_.places.col(k) = vertex.place;
            rows_.solved.push_back(vertex.under.triangle);
            rows_.on_solved.col(k) = vertex.under.weights;
            rows_.given.push_back(origin.triangle);
            rows_.on_given.col(k) = origin.weights;
            rows_.on_seam.push_back(vertex.half_edge == none ? 0 : 1);
        }
    }

    const FilletInput& given_;
    const FilletSurface& surface_;
    PreparedFillet made_;
    const LevelLine line_;
    std::vector<Indices> loops_;
    std::vector<char> must_;  // of each vertex: whether the mesh outside needs it
    const SmoothSurface smooth_;
    const Carried carried_;
    std::unique_ptr<RowSurface> on_;
    RowMesh mesh_;
    std::set<VertexPair> covered_, zipped_;
    std::vector<Eigen::Vector3i> triangles_;
    FilletRows rows_;
};

}  // namespace

std::optional<FilletRows> fillet_rows(const FilletInput& input, const WantedRows& wanted, const FilletSurface& surface,
                                      const ProgressCallback& callback) {
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    return Rows(input, wanted, surface).found();
}

}  // namespace fairing
