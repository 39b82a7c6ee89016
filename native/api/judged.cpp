#include "api/judged.h"

#include "api/input.h"
#include "base/columns.h"
#include "base/parallel.h"
#include "geometry/flips.h"
#include "geometry/self_intersection.h"
#include "mesh/edges.h"
#include "mesh/pieces.h"
#include "shape/kinks.h"
#include "shape/limits.h"
#include "shape/rounded_edges.h"

namespace fairing {

namespace {

using Marks = std::vector<char>;

constexpr int rings = 4;  // around the surface's boundary that tell what is usual, and where hard edges run on

Marks marks_of(const Triangles& triangles, Eigen::Index count) {
    Marks marks(static_cast<std::size_t>(count), 0);
    for (const int v : triangles.reshaped()) marks[v] = 1;
    return marks;
}

Triangles joined(const Triangles& first, const Triangles& second) {
    Triangles all(3, first.cols() + second.cols());
    all << first, second;
    return all;
}

template <typename Keep>
Triangles chosen(const Triangles& triangles, const Keep& keep) {
    Indices kept;
    for (int t = 0; t < triangles.cols(); ++t) {
        checkpoint(t);
        if (keep(triangles.col(t))) kept.push_back(t);
    }
    return triangles(Eigen::all, kept);
}

// The triangles within so many steps of the marked vertices.
Triangles within_rings(const Triangles& triangles, Marks reached) {
    const auto is_reached = [&](const auto& corners) {
        return reached[corners[0]] || reached[corners[1]] || reached[corners[2]];
    };
    Triangles near;
    for (int ring = 0; ring < rings; ++ring) {
        near = chosen(triangles, is_reached);
        for (const int v : near.reshaped()) reached[v] = 1;
    }
    return near;
}

// The others, turned round where most of them are wound against the surface along its boundary.
Triangles wound_alike(const Triangles& surface, Triangles others, Eigen::Index count) {
    std::vector<std::array<int, 2>> sides;
    sides.reserve(surface.size());
    for (int side = 0; side < surface.size(); ++side)
        sides.push_back({side_tail(surface, side), side_head(surface, side)});
    std::sort(sides.begin(), sides.end());
    const Marks own = marks_of(surface, count);
    int alike = 0;
    for (int side = 0; side < others.size(); ++side) {
        checkpoint(side);
        const std::array<int, 2> ends{side_tail(others, side), side_head(others, side)};
        if (!own[ends[0]] || !own[ends[1]]) continue;
        alike += std::binary_search(sides.begin(), sides.end(), std::array<int, 2>{ends[1], ends[0]}) ? 1 : 0;
        alike -= std::binary_search(sides.begin(), sides.end(), ends) ? 1 : 0;
    }
    if (alike < 0) others.row(0).swap(others.row(1));
    return others;
}

// Some triangles by numbers of their own vertices alone, which go up with the mesh's.
struct Part {
    Indices vertices;
    Indices number;

    Part(const Triangles& triangles, Eigen::Index count) : number(static_cast<std::size_t>(count), none) {
        for (const int v : triangles.reshaped()) number[v] = 0;
        for (int v = 0; v < static_cast<int>(number.size()); ++v) {
            if (number[v] == none) continue;
            number[v] = static_cast<int>(vertices.size());
            vertices.push_back(v);
        }
    }

    [[nodiscard]] Points of(const Points& points) const { return points(Eigen::all, vertices); }
    [[nodiscard]] Triangles own(const Triangles& triangles) const {
        return triangles.unaryExpr([&](int v) { return number[v]; });
    }
    // Those that are there.
    [[nodiscard]] Indices own(const Indices& of_mesh) const {
        Indices found;
        for (const int v : of_mesh) {
            if (number[v] != none) found.push_back(number[v]);
        }
        return found;
    }
    [[nodiscard]] Indices of_mesh(Indices own) const {
        for (int& v : own) v = vertices[v];
        return own;
    }
};

// A surface alone.
struct Sheet {
    Part part;
    Points points;
    Triangles triangles;

    Sheet(const Points& of_mesh, const Triangles& surface)
        : part(surface, of_mesh.cols()), points(part.of(of_mesh)), triangles(part.own(surface)) {}
};

Indices folded(const Sheet& sheet, const Indices& held) {
    Indices found;
    const CheckedMesh mesh = check_mesh({sheet.points, sheet.triangles, sheet.part.own(held), {}});
    for_each_piece(mesh.cut, mesh.roles, sheet.points, [&](const Patch& patch, const Points& points) {
        for (const int t : flipped_by_solution(patch, points)) found.push_back(patch.input_triangle[t]);
    });
    std::sort(found.begin(), found.end());
    return found;
}

// Those of the others that cross the sheet or each other; with `few`, of pairs that have one of these.
Indices crossed(const Points& points, const Triangles& sheet, const Triangles& others, const Indices* few) {
    const Triangles all = joined(sheet, others);
    const Part part(all, points.cols());
    const auto own = static_cast<int>(sheet.cols());
    Indices among;
    if (few) std::transform(few->begin(), few->end(), std::back_inserter(among), [&](int t) { return t + own; });
    const Triangles triangles = part.own(all);
    Indices found =
        few ? crossings_with(triangles, part.of(points), among) : crossing_triangles(triangles, part.of(points));
    std::erase_if(found, [&](int t) { return t < own; });
    for (int& t : found) t -= own;
    return found;
}

// The surface's triangles that pass through others, and did not before.
Indices pierced(const JudgedMesh& now, const std::optional<JudgedBefore>& before) {
    Eigen::AlignedBox3d box;
    for (const int v : now.surface.reshaped()) box.extend(now.points.col(v));
    const Triangles others = chosen(now.others, [&](const auto& corners) {
        Eigen::AlignedBox3d own;
        for (int k = 0; k < 3; ++k) own.extend(now.points.col(corners[k]));
        return box.intersects(own);
    });
    Indices hit = crossed(now.points, now.surface, others, nullptr);
    if (before && !hit.empty()) hit = without(hit, crossed(before->points, before->surface, others, &hit));
    if (hit.empty()) return {};
    const Triangles all = joined(now.surface, others(Eigen::all, hit));
    const Part part(all, now.points.cols());
    Indices few(hit.size());
    std::iota(few.begin(), few.end(), static_cast<int>(now.surface.cols()));
    Indices found = crossings_with(part.own(all), part.of(now.points), few);
    std::erase_if(found, [&](int t) { return t >= now.surface.cols(); });
    return found;
}

// What is measured at the surface and the rings around it.
class Surroundings {
public:
    Surroundings(const JudgedMesh& now, const std::optional<JudgedBefore>& before)
        : now_(now),
          before_(before),
          around_(within_rings(now.others, ends(now, before))),
          part_(joined(now.surface, around_), now.points.cols()) {}

    void add_join(Judged& found) const {
        const Points points = part_.of(now_.points);
        const Triangles inside = part_.own(now_.surface);
        found.join = visible_join({points, inside, part_.own(around_)}, part_.own(now_.rim));
        found.seams = part_.of_mesh(seam_kinks(points, inside, part_.own(now_.held), found.join.limit));
    }

    void add_edges(Judged& found) const {
        if (!before_ || before_->moved.empty()) return;
        const Points old = part_.of(before_->points);
        const Points points = part_.of(now_.points);
        const Indices moved = part_.own(before_->moved);
        // Far inside an edge may be a feature of its own.
        const Triangles near = within_rings(joined(now_.surface, around_), ends(now_, before_));
        found.rounded = part_.of_mesh(rounded_edges({old, points, part_.own(near), moved}));
        VertexPairs marked;
        for (const auto& [a, b] : before_->marked) {
            const std::array<int, 2> own{part_.number[a], part_.number[b]};
            if (own[0] != none && own[1] != none)
                marked.push_back({std::min(own[0], own[1]), std::max(own[0], own[1])});
        }
        found.blunt = part_.of_mesh(rounded_marks({old, points, part_.own(now_.surface), moved}, marked));
    }

private:
    // From where the surroundings reach: where the surface ends, and what moves outside.
    static Marks ends(const JudgedMesh& now, const std::optional<JudgedBefore>& before) {
        const Marks outside = marks_of(now.others, now.points.cols());
        Marks found = marks_of(now.surface, now.points.cols());
        for (std::size_t v = 0; v < found.size(); ++v) found[v] = found[v] && outside[v];
        if (before) {
            for (const int v : before->moved) found[v] = found[v] || outside[v];
        }
        return found;
    }

    const JudgedMesh& now_;
    const std::optional<JudgedBefore>& before_;
    Triangles around_;
    Part part_;
};

}  // namespace

Judged judged(const JudgedMesh& given, const std::optional<JudgedBefore>& before, bool is_clear,
              const ProgressCallback& callback) {
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    const Threads threads(0);
    JudgedMesh now = given;
    now.others = chosen(wound_alike(given.surface, given.others, given.points.cols()), [&](const auto& corners) {
        return given.points(Eigen::all, corners).allFinite() &&
               (!before || before->points(Eigen::all, corners).allFinite());
    });
    Judged found;
    const Surroundings surroundings(now, before);
    const Sheet sheet(now.points, now.surface);
    const std::array<std::function<void()>, 3> parts{[&] { surroundings.add_join(found); },
                                                     [&] { surroundings.add_edges(found); },
                                                     [&] { found.now.folded = folded(sheet, now.held); }};
    progress.report(0.0, "measurement");
    run_pieces(static_cast<int>(parts.size()), [&](int k) { parts[static_cast<std::size_t>(k)](); });
    progress.report(0.4, "measurement");
    if (!is_clear) found.now.crossing = crossing_triangles(sheet.triangles, sheet.points);
    progress.report(0.6, "measurement");
    found.pierced = pierced(now, before);
    progress.report(0.8, "measurement");
    if (before) {
        const Sheet old(before->points, before->surface);
        found.before = Faults{folded(old, now.held), {}};
        if (!found.now.crossing.empty()) found.before->crossing = crossing_triangles(old.triangles, old.points);
    }
    return found;
}

}  // namespace fairing
