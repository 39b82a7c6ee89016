#include "geometry/dihedral_bands.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "base/parallel.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double plane_angle = 0.1;  // degrees between triangles of one plane, but for single precision

using WeightedAngle = DihedralBands::WeightedAngle;

// Where so much of the weight is reached. `sorted` isn't empty.
double quantile(const std::vector<WeightedAngle>& sorted, double weight) {
    double sum = 0.0;
    for (const WeightedAngle& entry : sorted) {
        sum += entry.weight;
        if (sum >= weight) return entry.angle;
    }
    return sorted.back().angle;
}

// The range between these two quantiles, extended to zero.
AngleRange middle(double share, const std::vector<WeightedAngle>& sorted) {
    AngleRange range;
    double total = 0.0;
    for (const WeightedAngle& entry : sorted) total += entry.weight;
    if (!(total > 0.0)) return range;
    range.include(quantile(sorted, (1.0 - share) * total));
    range.include(quantile(sorted, share * total));
    return range;
}

}  // namespace

double AngleRange::excess(double angle) const { return std::max({0.0, low - angle, angle - high}); }

void AngleRange::include(double angle) {
    low = std::min(low, angle);
    high = std::max(high, angle);
}

void AngleRange::include(const AngleRange& other) {
    include(other.low);
    include(other.high);
}

double dihedral_angle(const Vector3& first, const Vector3& second, const Vector3& a, const Vector3& opposite) {
    const double angle = degrees_between(first, second);
    return first.dot(opposite - a) > 0.0 ? -angle : angle;
}

std::vector<Meeting> meetings(const EdgeTable& inside, const EdgeTable& outside) {
    std::vector<Meeting> found;
    for (int i = 0, o = 0; i < inside.size() && o < outside.size();) {
        if (inside.ends[i] < outside.ends[o]) {
            ++i;
        } else if (outside.ends[o] < inside.ends[i]) {
            ++o;
        } else {
            if (inside.side_count(i) == 1 && outside.side_count(o) == 1)
                found.push_back({inside.ends[i], inside.side(i, 0), outside.side(o, 0)});
            ++i, ++o;
        }
    }
    return found;
}

DihedralBands::DihedralBands(const Points& points, const Triangles& triangles)
    : points_(points),
      triangles_(triangles),
      edges_(make_edges(triangles, static_cast<int>(points.cols()))),
      normals_(3, triangles.cols()),
      begin_(static_cast<std::size_t>(points.cols()) + 1, 0),
      at_vertex_(static_cast<std::size_t>(triangles.size())) {
    for (int v : triangles.reshaped()) ++begin_[v + 1];
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    Indices cursor(begin_.begin(), begin_.end() - 1);
    for (int t = 0; t < triangles.cols(); ++t) {
        for (int v : triangles.col(t)) at_vertex_[cursor[v]++] = t;
        normals_.col(t) = direction(area_vector(points, triangles.col(t)));
    }
    measure_edges();
}

void DihedralBands::measure_edges() {
    angles_ = VectorX::Zero(edges_.size());
    lengths_ = VectorX::Zero(edges_.size());
    directions_.resize(3, edges_.size());
    for_ranges(edges_.size(), fine_grain, [&](int begin, int end) {
        for (int e = begin; e < end; ++e) measure(e);
    });
}

void DihedralBands::measure(int edge) {
    const auto [a, b] = edges_.ends[edge];
    lengths_[edge] = (points_.col(a) - points_.col(b)).norm();
    directions_.col(edge) = direction(points_.col(b) - points_.col(a));
    if (edges_.side_count(edge) != 2) return;
    const int first = edges_.side(edge, 0);
    const int side = edges_.side(edge, 1);
    const int opposite = triangles_((side % 3 + 2) % 3, side / 3);
    // Triangles that pass the edge in the same direction have opposite windings.
    const double winding = side_tail(triangles_, first) == side_tail(triangles_, side) ? -1.0 : 1.0;
    angles_[edge] = dihedral_angle(normals_.col(first / 3), winding * normals_.col(side / 3), points_.col(a),
                                   points_.col(opposite));
}

// The mean normal of the triangles beyond the vertex opposite to a side, weighted by area and direction.
Vector3 DihedralBands::normal_beyond(int side) const {
    const Vector3 tail = points_.col(side_tail(triangles_, side));
    const Vector3 along = direction(points_.col(side_head(triangles_, side)) - tail);
    const int opposite = triangles_((side % 3 + 2) % 3, side / 3);
    const Vector3 apex = points_.col(opposite);
    const Vector3 onwards = direction(apex - tail - along.dot(apex - tail) * along);
    Vector3 sum = Vector3::Zero();
    for (int k = begin_[opposite]; k < begin_[opposite + 1]; ++k) {
        const auto corners = triangles_.col(at_vertex_[k]);
        const Vector3 a = points_.col(corners[0]) - apex;
        const Vector3 b = points_.col(corners[1]) - apex;
        const Vector3 c = points_.col(corners[2]) - apex;
        const double cosine = onwards.dot(direction(a + b + c));
        if (cosine > 0.0) sum += cosine * area_vector(a, b, c);
    }
    return sum.isZero(0.0) ? Vector3(normals_.col(side / 3)) : sum;
}

double DihedralBands::angle_over_rows(int edge) const {
    if (edges_.side_count(edge) != 2) return 0.0;
    const auto [a, b] = edges_.ends[edge];
    const Vector3 along = direction(points_.col(b) - points_.col(a));
    const auto turn = [&](const Vector3& first, const Vector3& second) {
        const Vector3 p = direction(first - along.dot(first) * along);
        const Vector3 q = direction(second - along.dot(second) * along);
        return std::atan2(along.dot(p.cross(q)), p.dot(q)) * 180.0 / std::numbers::pi;
    };
    const int first = edges_.side(edge, 0);
    const int second = edges_.side(edge, 1);
    if (side_tail(triangles_, first) == side_tail(triangles_, second)) return 0.0;  // opposite windings
    const double own = turn(normals_.col(first / 3), normals_.col(second / 3));
    const double whole = turn(normal_beyond(first), normal_beyond(second));
    return own * whole > 0.0 ? std::copysign(whole, angles_[edge]) : 0.0;
}

DihedralBands::Walk DihedralBands::walk() const {
    return {Indices(begin_.size() - 1, 0), Indices(static_cast<std::size_t>(triangles_.cols()), 0),
            Indices(edges_.size(), 0)};
}

Indices DihedralBands::triangles_near(int a, int b, Walk& walk) const {
    ++walk.stamp;
    Indices found;
    Indices front{a, b};
    for (const int v : front) walk.vertices[v] = walk.stamp;
    for (int ring = 0; ring < rings; ++ring) {
        Indices next;
        for (int v : front) {
            for (int k = begin_[v]; k < begin_[v + 1]; ++k) {
                const int t = at_vertex_[k];
                if (walk.triangles[t] == walk.stamp) continue;
                walk.triangles[t] = walk.stamp;
                found.push_back(t);
                for (const int corner : triangles_.col(t)) {
                    if (walk.vertices[corner] == walk.stamp) continue;
                    walk.vertices[corner] = walk.stamp;
                    next.push_back(corner);
                }
            }
        }
        front = std::move(next);
    }
    return found;
}

Indices DihedralBands::inner_edges(const Indices& triangles, Walk& walk) const {
    Indices found;
    for (const int t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const int e = edges_.edge_of_side[3 * t + k];
            if (edges_.side_count(e) != 2 || walk.edges[e] == walk.stamp) continue;
            walk.edges[e] = walk.stamp;
            found.push_back(e);
        }
    }
    return found;
}

std::vector<DihedralBands::WeightedAngle> DihedralBands::weighted(const Indices& edges, int a, int b) const {
    const Vector3 along = direction(points_.col(b) - points_.col(a));
    std::vector<WeightedAngle> result;
    result.reserve(edges.size());
    for (const int e : edges) result.push_back({angles_[e], weight_across(e, along), e});
    std::ranges::sort(result, {}, &WeightedAngle::angle);
    return result;
}

AngleRange DihedralBands::usual(int a, int b, Walk& walk) const {
    return middle(half, weighted(inner_edges(triangles_near(a, b, walk), walk), a, b));
}

double DihedralBands::mean_height(int edge) const {
    double sum = 0.0;
    for (int k = 0; k < edges_.side_count(edge); ++k) sum += 2.0 * area(edges_.side(edge, k) / 3);
    return lengths_[edge] > 0.0 ? sum / (lengths_[edge] * edges_.side_count(edge)) : 0.0;
}

double DihedralBands::area(int triangle) const { return 0.5 * area_vector(points_, triangles_.col(triangle)).norm(); }

double DihedralBands::weight_across(int edge, const Vector3& along) const {
    const double cosine = along.dot(directions_.col(edge));
    return lengths_[edge] * cosine * cosine;
}

// The plane face that the triangle over a side belongs to, followed up to its third triangle.
DihedralBands::PlaneFace DihedralBands::plane_face(int side) const {
    const int edge = edges_.edge_of_side[side];
    const double least = 0.5 * std::abs(angles_[edge]);
    Indices found{side / 3};
    bool bends_away = true;
    for (std::size_t k = 0; k < found.size() && found.size() <= 2; ++k) {
        for (int corner = 0; corner < 3; ++corner) {
            const int e = edges_.edge_of_side[3 * found[k] + corner];
            if (e == edge || edges_.side_count(e) != 2) continue;
            if (std::abs(angles_[e]) >= plane_angle) {
                bends_away = bends_away && std::abs(angles_[e]) >= least;
                continue;
            }
            for (const int other : {0, 1}) {
                const int next = edges_.side(e, other) / 3;
                if (std::find(found.begin(), found.end(), next) == found.end()) found.push_back(next);
            }
        }
    }
    const bool is_quad = found.size() > 1;
    return {is_quad, found.size() > 2 || (is_quad && bends_away)};
}

bool DihedralBands::is_between_planes(int edge) const {
    if (edges_.side_count(edge) != 2 || std::abs(angles_[edge]) < plane_angle) return false;
    const PlaneFace first = plane_face(edges_.side(edge, 0));
    const PlaneFace second = plane_face(edges_.side(edge, 1));
    return first.has_several && second.has_several && (first.is_of_solid || second.is_of_solid);
}

AngleRange DihedralBands::usual_across(int edge, double share, const std::vector<char>& between_planes,
                                       Walk& walk) const {
    const auto [a, b] = edges_.ends[edge];
    std::vector<WeightedAngle> near = weighted(inner_edges(triangles_near(a, b, walk), walk), a, b);
    const AngleRange most = middle(share, near);
    for (WeightedAngle& entry : near)
        if (between_planes[entry.edge] != 0) entry.weight = 0.0;  // they bend by design, not by noise
    const AngleRange central = middle(half, near);
    return angles_[edge] > 0.0 ? AngleRange{central.low, most.high} : AngleRange{most.low, central.high};
}

std::optional<DihedralBands::Curvatures> DihedralBands::curvatures_beyond(int edge, Walk& walk) const {
    const auto [a, b] = edges_.ends[edge];
    const Vector3 start = points_.col(a);
    const Vector3 along = direction(points_.col(b) - start);
    const Vector3 across = along.cross(Vector3(normals_.col(edges_.side(edge, 0) / 3)));
    const double height = mean_height(edge);
    // 0 and 1: beyond the edge on its first and second side.
    const auto side_of = [&](const Vector3& place) {
        const Vector3 offset = place - start;
        const double apart = (offset - along.dot(offset) * along).norm();
        if (apart <= std::max(1.5 * height, std::abs(along.dot(offset)))) return none;
        return offset.dot(across) > 0.0 ? 1 : 0;
    };
    std::array<double, 2> covered{0.0, 0.0};
    std::array<double, 2> bend{0.0, 0.0};
    const Indices near = triangles_near(a, b, walk);
    for (const int t : near) {
        const auto corners = triangles_.col(t);
        const int side = side_of((points_.col(corners[0]) + points_.col(corners[1]) + points_.col(corners[2])) / 3.0);
        if (side != none) covered[static_cast<std::size_t>(side)] += area(t);
    }
    for (const int e : inner_edges(near, walk)) {
        const auto [tail, head] = edges_.ends[e];
        const int side = side_of(0.5 * (points_.col(tail) + points_.col(head)));
        if (side != none) bend[static_cast<std::size_t>(side)] += angles_[e] * weight_across(e, along);
    }
    const double row = lengths_[edge] * height;
    if (!(covered[0] + covered[1] >= row)) return std::nullopt;
    Curvatures result{std::abs(bend[0] + bend[1]) / (covered[0] + covered[1]), 0.0};
    result.least = result.mean;
    for (const std::size_t side : {0, 1}) {
        if (covered[side] >= row) result.least = std::min(result.least, std::abs(bend[side]) / covered[side]);
    }
    return result;
}

}  // namespace fairing
