#include "api/fillet_rows.h"

#include <set>

#include "api/kept_skin.h"
#include "api/prepared_fillet.h"
#include "fillet/limits.h"
#include "fillet/row_cut.h"
#include "geometry/nearest_point.h"
#include "geometry/target_surface.h"

namespace fairing {

namespace {

constexpr double most_wide = 175.0;  // degrees: short of a quad that is not convex
constexpr double resolution = 0.5;   // of the spacing: how finely the line is sought

// The surface as curved triangles.
class SmoothSurface {
public:
    explicit SmoothSurface(const SolvedFillet& surface)
        : surface_(surface),
          input_{surface.vertices, surface.triangles, surface.fixed, surface.normals},
          mesh_(check_mesh(input_)),
          patches_(patches_with_vertices(mesh_)),
          at_(static_cast<std::size_t>(surface.triangles.cols()), {none, none}),
          beneath_(surface.before, surface.triangles, all(surface.triangles.cols())) {
        for (const Patch& patch : patches_) {
            const int number = static_cast<int>(parts_.size());
            parts_.push_back(std::make_unique<Part>(input_, mesh_, patch));
            for (int t = 0; t < patch.triangle_count(); ++t) at_[patch.input_triangle[t]] = {number, t};
        }
    }

    [[nodiscard]] NearestPlace under(const Vector3& before) const { return beneath_.to(before); }

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
        const Vector3 flat = part.old.points(Eigen::all, corners) * weights;
        return part.old.unit.from_unit(Points(is_smooth(part, t) ? part.target.position({t, weights}) : flat));
    }

private:
    struct Part {
        Part(const MeshInput& input, const CheckedMesh& mesh, const Patch& patch)
            : old(input, mesh, patch), target(old.patch, old.points, old.normals) {}
        const OldSurface old;
        const TargetSurface target;
    };

    static Indices all(Eigen::Index count) {
        Indices numbers(static_cast<std::size_t>(count));
        std::iota(numbers.begin(), numbers.end(), 0);
        return numbers;
    }

    // Whether the normals at a triangle's corners are of one side with its own: at walls that meet they are means, over
    // which it must not be curved.
    static bool is_smooth(const Part& part, int triangle) {
        const Vector3 own = part.target.face_normal(triangle);
        const auto corners = part.old.patch.triangles.col(triangle);
        return std::all_of(corners.begin(), corners.end(),
                           [&](int v) { return part.old.normals.col(v).dot(own) > std::cos(corner_angle); });
    }

    const SolvedFillet& surface_;
    const MeshInput input_;
    const CheckedMesh mesh_;
    const std::vector<Patch> patches_;
    std::vector<std::unique_ptr<const Part>> parts_;
    std::vector<std::array<int, 2>> at_;  // of each triangle: its patch, and its number there
    const NearestTriangles beneath_;
};

// Of each point of a line: whether an edge that counts comes to it, or a vertex is there.
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

void put_on(const SmoothSurface& surface, const FilletInput& given, const PreparedFillet& made, const RowMesh& mesh,
            FilletRows& rows) {
    const auto count = static_cast<Eigen::Index>(mesh.places.size());
    rows.places.resize(3, count);
    rows.on_solved.resize(3, count);
    rows.on_given.resize(3, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const RowMesh::Place& at = mesh.places[static_cast<std::size_t>(k)];
        const Vector3 before = made.mesh.place(at.triangle, at.weights);
        const NearestPlace under = surface.under(before);
        const GivenPlace origin = given_place(given, made, at.triangle, before);
        rows.places.col(k) = surface.place(under);
        rows.solved.push_back(under.triangle);
        rows.on_solved.col(k) = under.weights;
        rows.given.push_back(origin.triangle);
        rows.on_given.col(k) = origin.weights;
        rows.on_seam.push_back(at.on_seam ? 1 : 0);
    }
}

FilletRows made_rows(const FilletInput& given, const WantedRows& wanted, const SolvedFillet& solved) {
    PreparedFillet made(given);
    LevelLine found = level_line(made.mesh, made.distance, resolution * given.spacing, snap * given.spacing);
    join_at_walls(made.mesh, given.spacing, found);
    const SmoothSurface surface(solved);
    const RowSizes sizes{made.least_width, wanted.spacing};
    const SeamWalks walks(made.mesh, made.distance, found);
    const std::vector<char> must = needed_outside(made.mesh, found, wanted);
    const RowStrips strips = row_strips(made.mesh, walks, found, must, sizes);
    RowLine line(made.mesh, walks, found, must);
    const RowMesh mesh = row_mesh(
        made.mesh, walks, strips, sizes, [&](const Vector3& before) { return surface.place(surface.under(before)); },
        line);
    FilletRows rows{cut_along_line(made, line.line()), mesh.quads, {}, {}, {}, {}, {}, {}};
    const Indices dropped = line.dropped();
    check_border(rows.cut.mesh, dropped, rows.quads);
    put_on(surface, given, made, mesh, rows);
    Points vertices(3, given.vertices.cols() + rows.cut.mesh.points.cols() + rows.places.cols());
    vertices << given.vertices, rows.cut.mesh.points, rows.places;
    for (const Quad& quad : rows.quads) {
        if (widest_angle(quad, vertices) > most_wide) throw NoRows();
    }
    drop_points(vertices, dropped, rows.cut.mesh);
    finish_cut(given, made, rows.cut);
    return rows;
}

}  // namespace

std::optional<FilletRows> fillet_rows(const FilletInput& input, const WantedRows& wanted, const SolvedFillet& surface,
                                      const ProgressCallback& callback) {
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    try {
        return made_rows(input, wanted, surface);
    } catch (const NoRows&) {
        return std::nullopt;
    }
}

}  // namespace fairing
