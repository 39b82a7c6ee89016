#include "api/holes.h"

#include <map>

#include "api/loops_meant.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "boundary/surrounding_fit.h"
#include "fill/loop_check.h"
#include "fill/short_edges.h"
#include "fill/small_hole.h"
#include "geometry/triangle.h"
#include "mesh/hole_loops.h"

namespace fairing {

namespace {

// How far the loop turns to the right at each vertex, by the angles of all triangles there: π less these, each pass its
// share where the border passes a vertex several times.
VectorX turns_by_angles(const LocalMesh& local, BoundaryLoop& loop) {
    std::map<int, double> angles;
    std::map<int, int> sides;  // border sides that end at each vertex
    for (const int v : loop.vertices) angles[local.local(v)] = 0.0;
    for (const auto& [a, b] : border_sides(local.triangles, static_cast<int>(local.points.cols()))) {
        ++sides[a];
        ++sides[b];
    }
    for (const auto corners : local.triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const auto here = angles.find(corners[k]);
            if (here == angles.end()) continue;
            const Vector3 place = local.points.col(corners[k]);
            here->second += radians_between(local.points.col(corners[(k + 1) % 3]) - place,
                                            local.points.col(corners[(k + 2) % 3]) - place);
        }
    }
    VectorX turns(static_cast<Eigen::Index>(loop.vertices.size()));
    Eigen::Index k = 0;
    for (const int v : loop.vertices) {
        const double passes = std::max(1.0, 0.5 * sides[local.local(v)]);
        loop.is_pinched = loop.is_pinched || passes > 1.0;
        turns[k++] = (angles[local.local(v)] - (2.0 - passes) * std::numbers::pi) / passes;
    }
    return turns;
}

Indices vertices_of(const Hole& hole) {
    Indices all;
    for (const BoundaryLoop& loop : hole.loops) all.insert(all.end(), loop.vertices.begin(), loop.vertices.end());
    return all;
}

// For all loops of a hole, one after the other.
SurroundingFit fit_around(const LocalMesh& local, const Indices& at, const VertexPairs& marked) {
    return fit_surroundings(local.points, local.triangles, local.local(at), local.local(marked));
}

void check_known(const Indices& at, const Points& around) {
    Indices missing;
    for (std::size_t k = 0; k < at.size(); ++k) {
        if (!(around.col(static_cast<Eigen::Index>(k)).norm() > 0.0)) missing.push_back(at[k]);
    }
    if (missing.empty()) return;
    const std::string text = "no triangle touches " + listed(missing) + ": pass `normals`";
    throw MeshError(at_vertices(Code::zero_normal, text, std::move(missing)));
}

// Throws where normals given are none, or point against the triangles around.
void check_given(const Indices& at, const Points& given, const Points& around) {
    constexpr double beyond_crease = -0.5;  // cosine: a few may do so at a mere crease
    Indices bad;
    Indices against;
    Indices far;
    for (std::size_t k = 0; k < at.size(); ++k) {
        const Vector3 normal = given.col(static_cast<Eigen::Index>(k));
        const double size = normal.norm();
        if (!(std::isfinite(size) && size > 0.0)) bad.push_back(at[k]);
        const double cosine = normal.dot(around.col(static_cast<Eigen::Index>(k))) / size;
        if (cosine < 0.0) against.push_back(at[k]);
        if (cosine < beyond_crease) far.push_back(at[k]);
    }
    if (!bad.empty()) {
        const std::string text = "normals: zero or not finite at " + listed(bad);
        throw MeshError(at_vertices(Code::zero_normal, text, std::move(bad)));
    }
    if (2 * against.size() <= at.size()) against = std::move(far);
    if (against.empty()) return;
    const std::string text = "normals: " + std::to_string(against.size()) + " of " + std::to_string(at.size()) +
                             " point against the triangles around: turn them";
    throw MeshError(at_vertices(Code::normals_oppose_winding, text, std::move(against)));
}

// Normals along the boundary belong to other vertices.
void check_across(const Hole& hole) {
    int wrong = 0;
    int count = 0;
    for (const BoundaryLoop& loop : hole.loops) {
        const LoopShape& shape = loop.shape;
        for (int k = 0; k < shape.size(); ++k, ++count) {
            const Vector3 along = shape.edge(k) + shape.edge((k + shape.size() - 1) % shape.size());
            wrong += std::abs(shape.normals.col(k).dot(along)) > std::sqrt(0.5) * along.norm() ? 1 : 0;
        }
    }
    if (2 * wrong <= count) return;
    throw std::invalid_argument("normals: " + std::to_string(wrong) + " of " + std::to_string(count) +
                                " point along the boundary, not across it: are the rows in the order of the vertices, "
                                "or of the loops as they were named?");
}

// One hole under work: what is known about it, and what stops it.
class Candidate {
public:
    Candidate(const HoledMesh& mesh, Hole& hole, const NamedLoops& named) : mesh_(mesh), hole_(hole), named_(named) {}

    // `is_found`: nobody named it, so that outer borders stay open.
    std::optional<LeftOpen> prepared(bool bridge, bool is_found) {
        std::vector<Indices> loops;
        std::vector<char> is_bare;
        for (const BoundaryLoop& loop : hole_.loops) {
            loops.push_back(loop.vertices);
            is_bare.push_back(loop.is_bare ? 1 : 0);
        }
        for (BoundaryLoop& loop : hole_.loops) loop.shape.points = mesh_.mesh().vertices(Eigen::all, loop.vertices);
        // Both sides of a seam, cut up otherwise, cross where faces close it: no surface has to be found.
        check_boundary(loops, is_bare, mesh_.mesh().vertices, !bridge && is_crack(hole_.loops[0].shape));
        for (BoundaryLoop& loop : hole_.loops) {
            loop.begin_anew();
            if (named_.vertex_normals.cols() > 0) loop.shape.normals = named_.vertex_normals(Eigen::all, loop.vertices);
            if (named_.vertex_curvatures.size() > 0) loop.curvatures = named_.vertex_curvatures(loop.vertices);
        }
        const Indices at = vertices_of(hole_);
        const LocalMesh local = mesh_.around(at);
        for (BoundaryLoop& loop : hole_.loops) {
            if (!loop.is_bare) loop.shape.angles = turns_by_angles(local, loop);
        }
        const SurroundingFit fit = fit_around(local, at, mesh_.mesh().marked);
        for (const auto& [a, b] : fit.hard) hole_.hard.push_back({local.to_mesh[a], local.to_mesh[b]});
        take_normals(at, normals_of(fit).normals);
        if (is_found && is_outer(plain_shape(local, at)))
            return LeftOpen{hole_.loops[0].vertices, outer_borders_left({hole_.loops[0].vertices}), true};
        settle_sides(hole_.loops, bridge);
        if (!bridge && is_endless(hole_.loops[0].shape))
            return LeftOpen{hole_.loops[0].vertices, endless(hole_.loops[0].vertices)};
        for (BoundaryLoop& loop : hole_.loops) share_normals(loop);
        return std::nullopt;
    }

private:
    static Diagnostic endless(Indices loop) {
        const std::string text =
            "the border loop at " + listed(loop) + " goes around the outside of a flat sheet: no surface closes it";
        std::sort(loop.begin(), loop.end());
        return at_vertices(Code::not_a_hole, text, std::move(loop), {{"loops", 1.0}, {"endless", 1.0}});
    }

    void take_normals(const Indices& at, const Points& around) {
        if (hole_.loops[0].shape.normals.cols() == 0) {
            check_known(at, around);
            split(around);
            return;
        }
        Points given(3, static_cast<Eigen::Index>(at.size()));
        Eigen::Index first = 0;
        for (const BoundaryLoop& loop : hole_.loops) {
            given.middleCols(first, loop.shape.size()) = loop.shape.normals;
            first += loop.shape.size();
        }
        check_given(at, given, around);
        split(given.colwise().normalized());
        check_across(hole_);
    }

    void split(const Points& normals) {
        Eigen::Index first = 0;
        for (BoundaryLoop& loop : hole_.loops) {
            loop.shape.normals = normals.middleCols(first, loop.shape.size());
            first += loop.shape.size();
        }
    }

    // With normals that marked edges don't stop: how a border turns is a matter of all that is around it.
    [[nodiscard]] LoopShape plain_shape(const LocalMesh& local, const Indices& at) const {
        LoopShape shape = hole_.loops[0].shape;
        if (!local.local(mesh_.mesh().marked).empty()) shape.normals = normals_of(fit_around(local, at, {})).normals;
        return shape;
    }

    const HoledMesh& mesh_;
    Hole& hole_;
    const NamedLoops& named_;
};

[[noreturn]] void refuse_all(const std::vector<LeftOpen>& left) {
    for (const LeftOpen& each : left) {
        if (!each.is_outer) throw MeshError(each.reason);
    }
    std::vector<Indices> outer;
    outer.reserve(left.size());
    for (const LeftOpen& each : left) outer.push_back(each.loop);
    throw MeshError(outer_borders_left(outer));
}

}  // namespace

HoledMesh::HoledMesh(BorderedMesh mesh)
    : mesh_(std::move(mesh)), stars_(mesh_.triangles, static_cast<int>(mesh_.vertices.cols())) {}

LocalMesh HoledMesh::around(const Indices& vertices, const Indices& also) const {
    constexpr int rings = 8;  // that slopes and the hard edges around them depend on (boundary/surrounding_fit)
    Indices near = stars_.around(vertices, rings);
    std::erase_if(near, [&](int t) { return !mesh_.vertices(Eigen::all, mesh_.triangles.col(t)).allFinite(); });
    Indices first = vertices;
    first.insert(first.end(), also.begin(), also.end());
    return {mesh_.vertices, mesh_.triangles, near, first};
}

namespace {

// Leaves open what is no hole; without names, outer borders.
Holes prepared(const HoledMesh& mesh, Holes found, const NamedLoops& named, bool bridge, bool is_found) {
    std::vector<std::optional<LeftOpen>> reasons(found.holes.size());
    run_pieces(static_cast<int>(found.holes.size()), [&](int k) {
        try {
            reasons[k] = Candidate(mesh, found.holes[k], named).prepared(bridge, is_found);
        } catch (const MeshError& error) {
            if (bridge) throw;
            reasons[k] = LeftOpen{found.holes[k].loops[0].vertices, error.diagnostic()};
        }
    });
    Holes result{{}, std::move(found.left)};
    for (std::size_t k = 0; k < reasons.size(); ++k) {
        if (reasons[k]) {
            result.left.push_back(std::move(*reasons[k]));
        } else {
            result.holes.push_back(std::move(found.holes[k]));
        }
    }
    if (result.holes.empty()) refuse_all(result.left);
    return result;
}

}  // namespace

Diagnostic outer_borders_left(const std::vector<Indices>& loops) {
    Indices vertices;
    for (const Indices& loop : loops) vertices.insert(vertices.end(), loop.begin(), loop.end());
    std::sort(vertices.begin(), vertices.end());
    const bool is_one = loops.size() == 1;
    const std::string text = counted(loops.size(), "border loop goes", "border loops go") +
                             " around the outside of a sheet, at " + listed(vertices) + ", and " +
                             (is_one ? "stays" : "stay") +
                             " open: name a loop in `loops` to have it filled all the same";
    return at_vertices(Code::not_a_hole, text, std::move(vertices), {{"loops", static_cast<double>(loops.size())}});
}

std::vector<LoopShape> loop_shapes(const HoledMesh& mesh, const std::vector<Indices>& loops) {
    if (loops.empty()) return {};
    Holes found = named_loops(mesh, {loops}, true, false);
    std::vector<LoopShape> shapes;
    for (BoundaryLoop& loop : found.holes[0].loops) {
        const LocalMesh local = mesh.around(loop.vertices);
        loop.shape.points = mesh.mesh().vertices(Eigen::all, loop.vertices);
        loop.shape.normals = normals_of(fit_around(local, loop.vertices, mesh.mesh().marked)).normals;
        if (!loop.is_bare) loop.shape.angles = turns_by_angles(local, loop);
        shapes.push_back(std::move(loop.shape));
    }
    return shapes;
}

Holes find_holes(const HoledMesh& mesh, const NamedLoops& named, bool bridge) {
    if (!named.loops.empty()) return prepared(mesh, named_loops(mesh, named, bridge), named, bridge, false);
    Holes found = prepared(mesh, found_loops(mesh, named), named, false, true);
    if (!bridge) return found;
    Hole all;
    for (Hole& hole : found.holes) {
        all.loops.push_back(std::move(hole.loops[0]));
        all.loops.back().shape = {};
    }
    return prepared(mesh, {{std::move(all)}, std::move(found.left)}, named, true, false);
}

}  // namespace fairing
