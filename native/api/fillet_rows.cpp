#include "api/fillet_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "api/old_surface.h"
#include "fillet/limits.h"

namespace fairing {

struct FilletSurface::Solved {
    Solved(Points points, Triangles triangles, Indices fixed, Points normals)
        : vertices(std::move(points)),
          input{vertices, std::move(triangles), std::move(fixed), std::move(normals)},
          mesh(check_mesh(input)),
          patches(patches_with_vertices(mesh)),
          old(input, mesh, patches.front()),
          target(old.patch, old.points, old.normals) {}

    [[nodiscard]] PlacesOnFillet given_back(const std::vector<SurfacePoint>& where) const {
        PlacesOnFillet result;
        const auto count = static_cast<Eigen::Index>(where.size());
        Points places(3, count);
        result.weights.resize(3, count);
        for (Eigen::Index k = 0; k < count; ++k) {
            const SurfacePoint& at = where[static_cast<std::size_t>(k)];
            const auto corners = old.patch.triangles.col(at.triangle);
            places.col(k) =
                is_smooth(at.triangle) ? target.position(at) : Vector3(old.points(Eigen::all, corners) * at.weights);
            result.triangle.push_back(old.patch.input_triangle[at.triangle]);
            result.weights.col(k) = at.weights;
        }
        result.places = old.unit.from_unit(places);
        return result;
    }

    // Whether the normals at a triangle's corners are of one side with its own: at walls that meet they are means, over
    // which it must not be curved.
    [[nodiscard]] bool is_smooth(int triangle) const {
        const Vector3 own = target.face_normal(triangle);
        const auto corners = old.patch.triangles.col(triangle);
        return std::all_of(corners.begin(), corners.end(),
                           [&](int v) { return old.normals.col(v).dot(own) > std::cos(corner_angle); });
    }

    const Points vertices;
    const MeshInput input;
    const CheckedMesh mesh;
    const std::vector<Patch> patches;
    const OldSurface old;
    const TargetSurface target;
};

namespace {

// A section's way through one triangle.
struct Crossed {
    int triangle;
    Vector3 from, to;  // weights
    double length;
};

class Sectioning {
public:
    Sectioning(const Patch& patch, const Points& points) : patch_(patch), points_(points) {
        for (int e = 0; e < patch_.edge_count(); ++e) {
            if (patch_.edge_triangles[e][1] == none) border_.push_back(e);
        }
    }

    // None where the plane leaves the surface elsewhere than near its end.
    [[nodiscard]] std::optional<std::vector<Crossed>> way(const Section& section) const {
        const auto is_above = [&](int v) { return height(section, v) >= 0.0; };
        int edge = first_edge(section);
        if (edge == none) return std::nullopt;
        std::vector<Crossed> result;
        int t = patch_.edge_triangles[edge][0];
        while (static_cast<int>(result.size()) <= patch_.triangle_count()) {
            int out = none;
            for (const int e : patch_.triangle_edges.col(t)) {
                if (e != edge && is_above(patch_.edge_ends[e][0]) != is_above(patch_.edge_ends[e][1])) out = e;
            }
            if (out == none) return std::nullopt;
            const Vector3 from = weights(section, t, edge);
            const Vector3 to = weights(section, t, out);
            result.push_back({t, from, to, (place(t, to) - place(t, from)).norm()});
            const auto [left, right] = patch_.edge_triangles[out];
            if (right == none) break;
            t = left == t ? right : left;
            edge = out;
        }
        const double off = (place(result.back().triangle, result.back().to) - section.end).norm();
        const double chord = (section.end - section.start).norm();
        double length = 0.0;
        for (const Crossed& each : result) length += each.length;
        if (off > most_off * chord || length > most_long * chord) return std::nullopt;
        return result;
    }

private:
    static constexpr double most_off = 0.1;   // of its chord: an end that far off is another one
    static constexpr double most_long = 1.7;  // chords: a way that turns by 180° has 1.57

    [[nodiscard]] double height(const Section& section, int v) const {
        return (Vector3(points_.col(v)) - section.start).dot(section.normal);
    }
    [[nodiscard]] Vector3 place(int t, const Vector3& weights) const {
        return points_(Eigen::all, patch_.triangles.col(t)) * weights;
    }
    // Where the plane crosses an edge of a triangle.
    [[nodiscard]] Vector3 weights(const Section& section, int t, int edge) const {
        const auto [a, b] = patch_.edge_ends[edge];
        const double at_a = height(section, a);
        const double share = at_a / (at_a - height(section, b));
        Vector3 result = Vector3::Zero();
        for (int k = 0; k < 3; ++k) {
            if (patch_.triangles(k, t) == a) result[k] = 1.0 - share;
            if (patch_.triangles(k, t) == b) result[k] = share;
        }
        return result;
    }
    [[nodiscard]] int first_edge(const Section& section) const {
        int best = none;
        double least = std::numeric_limits<double>::infinity();
        for (const int e : border_) {
            const auto [a, b] = patch_.edge_ends[e];
            if ((height(section, a) >= 0.0) == (height(section, b) >= 0.0)) continue;
            const int t = patch_.edge_triangles[e][0];
            const double off = (place(t, weights(section, t, e)) - section.start).norm();
            if (off < least) {
                least = off;
                best = e;
            }
        }
        return best;
    }

    const Patch& patch_;
    const Points& points_;
    Indices border_;
};

// Places that part a way into `rows` ways of one length.
void part(const std::vector<Crossed>& way, int rows, std::vector<SurfacePoint>& where) {
    double total = 0.0;
    for (const Crossed& each : way) total += each.length;
    double passed = 0.0;
    auto at = way.begin();
    for (int k = 1; k < rows; ++k) {
        const double wanted = total * k / rows;
        while (std::next(at) != way.end() && passed + at->length < wanted) passed += (at++)->length;
        const double share = at->length > 0.0 ? std::clamp((wanted - passed) / at->length, 0.0, 1.0) : 0.0;
        where.push_back({at->triangle, at->from + share * (at->to - at->from)});
    }
}

}  // namespace

FilletSurface::FilletSurface(Points vertices, Triangles triangles, Indices fixed, Points normals)
    : solved_(std::make_unique<const Solved>(std::move(vertices), std::move(triangles), std::move(fixed),
                                             std::move(normals))) {}

FilletSurface::~FilletSurface() = default;

PlacesOnFillet FilletSurface::sections(const std::vector<Section>& sections, int rows) const {
    const Sectioning sectioning(solved_->old.patch, solved_->old.points);
    const Normalisation& unit = solved_->old.unit;
    std::vector<SurfacePoint> where;
    std::vector<char> found;
    for (const Section& each : sections) {
        const auto way = sectioning.way({unit.to_unit(each.start), unit.to_unit(each.end), each.normal});
        found.push_back(way ? 1 : 0);
        if (way)
            part(*way, rows, where);
        else
            where.resize(where.size() + static_cast<std::size_t>(rows - 1));
    }
    PlacesOnFillet result = solved_->given_back(where);
    result.found = std::move(found);
    return result;
}

PlacesOnFillet FilletSurface::relaxed(const QuadPattern& pattern, const Points& given, int sweeps) const {
    const Patch& patch = solved_->old.patch;
    Points points = solved_->old.unit.to_unit(given);
    Points centres(3, patch.triangle_count());
    for (int t = 0; t < patch.triangle_count(); ++t)
        centres.col(t) = solved_->old.points(Eigen::all, patch.triangles.col(t)).rowwise().mean();
    Points normals = Points::Zero(3, points.cols());
    std::vector<SurfacePoint> where(static_cast<std::size_t>(points.cols()));
    const auto put = [&](Eigen::Index v, const Vector3& wanted, int start) {
        SurfacePoint& at = where[static_cast<std::size_t>(v)];
        at = solved_->target.project(wanted, start);
        normals.col(v) = solved_->target.face_normal(at.triangle);
        if (v >= pattern.boundary_count)
            points.col(v) = solved_->old.points(Eigen::all, patch.triangles.col(at.triangle)) * at.weights;
    };
    for (Eigen::Index v = 0; v < points.cols(); ++v) {
        Eigen::Index nearest = 0;
        (centres.colwise() - Vector3(points.col(v))).colwise().squaredNorm().minCoeff(&nearest);
        put(v, points.col(v), static_cast<int>(nearest));
    }
    SquareSteps steps(pattern);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        const Points wanted = steps.wanted(points, normals);
        for (Eigen::Index v = pattern.boundary_count; v < points.cols(); ++v)
            put(v, wanted.col(v), where[static_cast<std::size_t>(v)].triangle);
    }
    return solved_->given_back(where);
}

}  // namespace fairing
