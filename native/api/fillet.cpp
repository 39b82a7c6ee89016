#include "api/fillet.h"

#include <map>

#include "api/prepared_fillet.h"
#include "fillet/end_cuts.h"
#include "fillet/limits.h"
#include "geometry/flips.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double roundoff = 1e-9;   // of a triangle: places that near to its sides are on them
constexpr double resolution = 0.5;  // of the spacing: how finely the line is sought

}  // namespace

LevelLine fillet_line(PreparedFillet& made) {
    const SeamMesh& mesh = made.mesh;
    const SeamDistance& distance = made.distance;
    const FilletInput& input = made.input;
    const LevelLine found = level_line(mesh, distance, resolution * input.spacing, snap * input.spacing);
    LevelLine line = resampled(mesh, distance, found, input.spacing, made.sides);
    join_at_walls(mesh, distance, input.spacing, line);
    part_seams(mesh, distance, input.spacing, line);
    part_walls(mesh, distance, made.sides, input.spacing, line);
    return line;
}

namespace {

// Vertices of the cut mesh.
Points all_points(const Points& old, const SplitMesh& cut) {
    Points points(3, old.cols() + cut.points.cols());
    points << old, cut.points;
    return points;
}

// A side of a piece of the fillet beyond which there is none.
struct EndSide {
    int piece;
    int from, to;
};

std::vector<EndSide> ends_of(const SplitMesh& cut) {
    std::map<std::array<int, 2>, int> inner;
    for (Eigen::Index t = 0; t < cut.triangles.cols(); ++t) {
        if (cut.inside[t] == 0) continue;
        for (int k = 0; k < 3; ++k) inner[{cut.triangles(k, t), cut.triangles((k + 1) % 3, t)}] = static_cast<int>(t);
    }
    std::vector<EndSide> ends;
    for (const auto& [side, piece] : inner) {
        if (!inner.contains({side[1], side[0]})) ends.push_back({piece, side[0], side[1]});
    }
    return ends;
}

void add_boundary(const SeamMesh& mesh, const Points& points, const SideNormals& sides, FilletCut& result) {
    std::map<int, std::vector<std::pair<Vector3, double>>> seen;
    for (const EndSide& end : ends_of(result.mesh)) {
        const int parent = result.mesh.parent[end.piece];
        for (const int v : {end.from, end.to}) {
            const Vector3 weights = barycentric(mesh.points, mesh.triangles, parent, points.col(v));
            seen[v].emplace_back(sides.normal(parent, weights), sides.curvature(parent, weights));
        }
    }
    result.normals.resize(3, static_cast<Eigen::Index>(seen.size()));
    result.curvatures.resize(static_cast<Eigen::Index>(seen.size()));
    for (const auto& [v, found] : seen) {
        const auto k = static_cast<Eigen::Index>(result.boundary.size());
        Vector3 normal = Vector3::Zero();
        double curvature = 0.0;
        bool parted = false;
        Vector3 first = Vector3::Zero();
        for (const auto& [n, h] : found) {
            if (first.isZero()) first = n;
            parted = parted || (!n.isZero() && radians_between(n, first) > corner_angle);
            normal += n;
            curvature += h / static_cast<double>(found.size());
        }
        result.boundary.push_back(v);
        result.normals.col(k) = normal.normalized();
        result.curvatures[k] = curvature;
        if (parted) result.corners.push_back(v);
    }
}

Points weights_in_parents(const FilletInput& input, const SplitMesh& cut) {
    Points weights(3, cut.triangles.size());
    const Points points = all_points(input.vertices, cut);
    for (Eigen::Index c = 0; c < cut.triangles.size(); ++c) {
        const Vector3 place = points.col(cut.triangles(c % 3, c / 3));
        weights.col(c) = barycentric(input.vertices, input.triangles, cut.parent[c / 3], place);
    }
    return weights;
}

// At each vertex within the fillet; elsewhere none counts.
VectorX spacings_of(const PreparedFillet& made, const Points& points, const SplitMesh& cut) {
    VectorX found = VectorX::Constant(points.cols(), made.input.spacing);
    for (Eigen::Index c = 0; c < cut.triangles.size(); ++c) {
        if (cut.inside[c / 3] == 0) continue;
        const int v = cut.triangles(c % 3, c / 3);
        const int parent = cut.parent[c / 3];
        const Vector3 weights = barycentric(made.mesh.points, made.mesh.triangles, parent, points.col(v));
        found[v] = std::min(found[v], made.input.spacing * made.distance.relative_width(parent, weights));
    }
    return found;
}

void set_sections(const FilletInput& given, const EndSections& sections, FilletCut& cut) {
    std::map<int, Vector3> before;
    for (std::size_t k = 0; k < sections.vertices.size(); ++k) {
        const int v = sections.vertices[k];
        before[v] = sections.before[k];
        const auto at = std::ranges::lower_bound(cut.boundary, v) - cut.boundary.begin();
        if (at == std::ssize(cut.boundary) || cut.boundary[at] != v) continue;
        cut.normals.col(at) = sections.normals[k];
        cut.curvatures[at] = std::numeric_limits<double>::quiet_NaN();
        std::erase(cut.corners, v);
    }
    for (Eigen::Index c = 0; c < cut.weights.cols(); ++c) {
        const auto found = before.find(cut.mesh.triangles(c % 3, c / 3));
        if (found == before.end() || cut.mesh.inside[c / 3] == 0) continue;
        cut.weights.col(c) = barycentric(given.vertices, given.triangles, cut.mesh.parent[c / 3], found->second);
    }
}

void turn_caps_inside(const FilletInput& input, const Points& points, SplitMesh& cut) {
    for (const TurnedCap& turned :
         turn_caps(points, cut.inside, cut.inside, snap * finest_spacing(input), cut.triangles))
        cut.parent[turned.cap] = cut.parent[turned.beside];
}

}  // namespace

void finish_cut(const FilletInput& given, PreparedFillet& made, FilletCut& cut) {
    const Points points = all_points(made.input.vertices, cut.mesh);
    add_boundary(made.mesh, points, made.sides, cut);
    cut.spacings = spacings_of(made, points, cut.mesh);
    for (int& parent : cut.mesh.parent) parent = made.plane[parent];
    turn_caps_inside(made.input, points, cut.mesh);
    cut.weights = weights_in_parents(given, cut.mesh);
}

GivenPlace given_place(const FilletInput& given, const PreparedFillet& made, int triangle, const Vector3& place) {
    const int parent = made.plane[triangle];
    Vector3 weights = barycentric(given.vertices, given.triangles, parent, place);
    weights = (weights.array() < roundoff).select(0.0, weights);
    return {parent, weights / weights.sum()};
}

FilletCut cut_fillet(const FilletInput& given, const ProgressCallback& callback) {
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    PreparedFillet made(given);
    progress.report(0.3, "distance");
    FilletCut result;
    result.mesh = cut_along(made.mesh, made.distance, fillet_line(made));
    result.eaten = eaten_parts(made.mesh, made.distance, result.mesh, 0.5 * finest_spacing(made.input));
    progress.report(0.7, "cut");
    if (std::all_of(result.eaten.begin(), result.eaten.end(), [](const EatenPart& part) { return part.held; })) {
        EndSections sections;
        if (given.through) sections = cut_ends(made.mesh, made.sides, result.mesh);
        finish_cut(given, made, result);
        set_sections(given, sections, result);
    }
    progress.report(1.0, "done");
    return result;
}

}  // namespace fairing
