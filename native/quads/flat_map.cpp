#include "quads/flat_map.h"

#include <map>

#include "base/errors.h"
#include "fill/conformal_map.h"
#include "geometry/triangle.h"
#include "mesh/nearest_first.h"

namespace fairing {

namespace {

constexpr double inner_radius = 0.3;  // of the ring that a tube is mapped to

// By how much the angle along an edge exceeds the difference at its ends: whole turns times the edge's weight.
struct Turns {
    Eigen::MatrixXd sources;
    explicit Turns(int vertex_count) : sources(Eigen::MatrixXd::Zero(vertex_count, 2)) {}
    void add(int a, int b, double weight) {
        sources(a, 0) += weight * full_turn;
        sources(b, 0) -= weight * full_turn;
    }
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

FlatMap::FlatMap(const Patch& patch, const Points& points) : patch_(patch), points_(points), loops_(patch.loops()) {
    if (is_tube()) cut_tube();
    flat_ = on_plane(inside());
    sort_triangles();
}

// The shortest path along edges from the first vertex of one loop to the other loop, which then begins there.
void FlatMap::cut_tube() {
    NearestFirst away(VectorX::Constant(patch_.vertex_count(), std::numeric_limits<double>::infinity()));
    Indices before(static_cast<std::size_t>(patch_.vertex_count()), none);
    std::vector<char> is_goal(before.size(), 0);
    for (const int v : loops_[1]) is_goal[v] = 1;
    const int first = loops_[0].front();
    away.lower(first, 0.0);
    for (int v = away.next(); v != none; v = away.next()) {
        if (is_goal[v] != 0) {
            for (int at = v; at != none; at = before[at]) cut_.push_back(at);
            std::reverse(cut_.begin(), cut_.end());
            std::rotate(loops_[1].begin(), std::find(loops_[1].begin(), loops_[1].end(), v), loops_[1].end());
            return;
        }
        for (const int next : patch_.ring(v).vertices) {
            if (!patch_.is_free(next) && is_goal[next] == 0) continue;
            if (v == first && is_goal[next] != 0) continue;  // an edge from loop to loop leaves no side to tell
            if (away.lower(next, away[v] + (points_.col(next) - points_.col(v)).norm())) before[next] = v;
        }
    }
    throw SolverError("the surface can't be flattened");
}

// Crossing the cut from right to left subtracts a turn: spokes that leave it to the left begin a turn later.
FlatMap::Flat FlatMap::inside() const {
    const InnerWeights edges = harmonic_weights(patch_, points_);
    Turns turns(patch_.vertex_count());
    for (std::size_t k = 0; k < cut_.size(); ++k) {
        const RingView ring = patch_.ring(cut_[k]);
        const int count = static_cast<int>(ring.valence());
        const auto place_of = [&](int v) {
            return static_cast<int>(std::find(ring.vertices.begin(), ring.vertices.end(), v) - ring.vertices.begin());
        };
        // Counter-clockwise from the vertex after to the one before lies the left side.
        const int begin = k + 1 < cut_.size() ? place_of(cut_[k + 1]) + 1 : 0;
        int end = k > 0 ? place_of(cut_[k - 1]) : count;
        if (end < begin) end += count;
        for (int j = begin; j < end; ++j)
            turns.add(cut_[k], ring.vertices[j % count], -edges[ring.spokes[j % count]].weight);
    }
    std::vector<char> is_known(static_cast<std::size_t>(patch_.vertex_count()), 0);
    Flat flat = Flat::Zero(2, patch_.vertex_count());
    const Flat rim = known();
    Eigen::Index k = 0;
    for (const Indices& loop : loops_) {
        for (const int v : loop) {
            is_known[v] = 1;
            flat.col(v) = rim.col(k++);
        }
    }
    return solved({edges, std::move(is_known), points_, std::move(turns.sources)}, flat);
}

VectorX FlatMap::along(const Indices& loop) const {
    const std::size_t count = loop.size();
    VectorX at(static_cast<Eigen::Index>(count + 1));
    at[0] = 0.0;
    for (std::size_t k = 0; k < count; ++k)
        at[k + 1] = at[k] + (points_.col(loop[(k + 1) % count]) - points_.col(loop[k])).norm();
    return at;
}

// Positions of the loops' vertices: on the unit circle, or angle and height on a cylinder.
FlatMap::Flat FlatMap::known() const {
    const auto first = static_cast<Eigen::Index>(loops_[0].size());
    const VectorX outer = along(loops_[0]);
    Flat result(2, is_tube() ? first + static_cast<Eigen::Index>(loops_[1].size()) : first);
    for (Eigen::Index k = 0; k < first; ++k) {
        const double angle = full_turn * outer[k] / outer[first];
        result.col(k) = is_tube() ? Eigen::Vector2d(angle, 0.0) : Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    if (!is_tube()) return result;
    const VectorX inner = along(loops_[1]);
    for (Eigen::Index k = 0; k < inner.size() - 1; ++k)
        result.col(first + k) =
            Eigen::Vector2d(k == 0 ? 0.0 : full_turn * (1.0 - inner[k] / inner[inner.size() - 1]), 1.0);
    return result;
}

FlatMap::Flat FlatMap::solved(const HarmonicProblem& problem, const Flat& flat) {
    const auto found = harmonic_values(problem, flat.transpose());
    if (!found) throw SolverError("the surface can't be flattened");
    return found->transpose();
}

FlatMap::Flat FlatMap::on_plane(Flat flat) const {
    for (Eigen::Index v = 0; is_tube() && v < flat.cols(); ++v) {
        const double radius = 1.0 - (1.0 - inner_radius) * flat(1, v);
        flat.col(v) = Eigen::Vector2d(radius * std::cos(flat(0, v)), radius * std::sin(flat(0, v)));
    }
    return flat;
}

FlatMap::Flat FlatMap::places(const QuadPattern& pattern) const {
    std::map<std::pair<int, int>, int> turns;
    const auto add = [&turns](const auto& face) {
        for (std::size_t k = 0; k < face.size(); ++k) turns[std::minmax(face[k], face[(k + 1) % face.size()])] = 0;
    };
    for (const auto& quad : pattern.quads) add(quad);
    for (const auto& triangle : pattern.triangles) add(triangle);
    for (const auto& [a, b] : pattern.over_seam) turns[std::minmax(a, b)] = a < b ? 1 : -1;
    InnerWeights edges;
    Turns sources(pattern.vertex_count);
    for (const auto& [ends, each] : turns) {
        edges.push_back({ends.first, ends.second, 1.0});
        sources.add(ends.first, ends.second, each);
    }
    std::vector<char> is_known(static_cast<std::size_t>(pattern.vertex_count), 0);
    std::fill_n(is_known.begin(), pattern.boundary_count, 1);
    Flat flat = Flat::Zero(2, pattern.vertex_count);
    flat.leftCols(pattern.boundary_count) = known();
    return on_plane(solved({edges, std::move(is_known), Points(3, 0), std::move(sources.sources)}, flat));
}

VectorX FlatMap::angles() const {
    VectorX at = VectorX::Zero(patch_.vertex_count());
    for (const auto corners : patch_.triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const Vector3 here = points_.col(corners[k]);
            at[corners[k]] +=
                degrees_between(points_.col(corners[(k + 1) % 3]) - here, points_.col(corners[(k + 2) % 3]) - here);
        }
    }
    return at;
}

double FlatMap::area() const {
    double sum = 0.0;
    for (const auto corners : patch_.triangles.colwise()) {
        const Vector3 here = points_.col(corners[0]);
        sum += 0.5 * (points_.col(corners[1]) - here).cross(points_.col(corners[2]) - here).norm();
    }
    return sum;
}

double FlatMap::edge_length() const {
    double sum = 0.0;
    double count = 0.0;
    for (const Indices& loop : loops_) {
        sum += along(loop)[static_cast<Eigen::Index>(loop.size())];
        count += static_cast<double>(loop.size());
    }
    return sum / count;
}

HoleBoundary FlatMap::hole() const {
    HoleBoundary result;
    const Indices& loop = loops_.front();
    result.angles = angles()(loop);
    result.cells = area() / (edge_length() * edge_length());
    const int opposite = loop[loop.size() / 2];
    Eigen::MatrixXd given = Eigen::MatrixXd::Zero(2, 2);
    given(1, 0) = (points_.col(opposite) - points_.col(loop[0])).norm();
    const Eigen::MatrixXd flat = conformal_map(points_, patch_.triangles, {loop[0], opposite}, given);
    result.places = flat(loop, Eigen::all).transpose();
    return result;
}

TubeBoundary FlatMap::tube() const {
    const VectorX all = angles();
    const double edge = edge_length();
    const double length = area() / (0.5 * edge * static_cast<double>(loops_[0].size() + loops_[1].size()));
    return {all(loops_[0]), all(loops_[1]), length / edge, area() / (edge * edge)};
}

std::array<int, 2> FlatMap::bin_of(const Eigen::Vector2d& place) const {
    const auto at = [this](double x) { return std::clamp(static_cast<int>(0.5 * (x + 1.0) * bins_), 0, bins_ - 1); };
    return {at(place.x()), at(place.y())};
}

void FlatMap::sort_triangles() {
    bins_ = std::max(1, static_cast<int>(std::sqrt(patch_.triangle_count())));
    in_bin_.resize(static_cast<std::size_t>(bins_) * static_cast<std::size_t>(bins_));
    for (int t = 0; t < patch_.triangle_count(); ++t) {
        const auto corners = flat_(Eigen::all, patch_.triangles.col(t));
        const auto low = bin_of(corners.rowwise().minCoeff());
        const auto high = bin_of(corners.rowwise().maxCoeff());
        for (int x = low[0]; x <= high[0]; ++x) {
            for (int y = low[1]; y <= high[1]; ++y) in_bin_[x * bins_ + y].push_back(t);
        }
    }
}

SurfacePoint FlatMap::located(const Eigen::Vector2d& place) const {
    const auto [x, y] = bin_of(place);
    SurfacePoint best;
    double most = -std::numeric_limits<double>::infinity();
    for (const int t : in_bin_[x * bins_ + y]) {
        const auto corners = patch_.triangles.col(t);
        const Eigen::Vector2d a = flat_.col(corners[0]) - place;
        const Eigen::Vector2d b = flat_.col(corners[1]) - place;
        const Eigen::Vector2d c = flat_.col(corners[2]) - place;
        const Vector3 parts(cross(b, c), cross(c, a), cross(a, b));
        const double sum = parts.sum();
        if (!(sum > 0.0) || parts.minCoeff() / sum <= most) continue;
        most = parts.minCoeff() / sum;
        best = {t, (parts / sum).cwiseMax(0.0)};
        best.weights /= best.weights.sum();
    }
    return best;
}

}  // namespace fairing
