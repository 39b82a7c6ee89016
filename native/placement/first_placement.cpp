#include "placement/first_placement.h"

#include "geometry/limits.h"
#include "geometry/vertex_normal.h"
#include "tangential/tangential_step.h"

namespace fairing {

namespace {

// Walks from the places of neighbours that are placed already.
class Follower {
public:
    Follower(const Problem& problem, const Points& surface, const Patch& proxy, const TargetSurface& target)
        : patch_(problem.patch),
          surface_(surface),
          target_(target),
          normals_(max_normals(patch_, surface, problem.fixed_normals)),
          where_(patch_.vertex_count(), SurfacePoint{none, Vector3::Zero()}) {
        for (int k = 0; k < problem.fixed_points.cols(); ++k) {
            place(patch_.free_count + k, target.at_vertex(proxy.free_count + k));
        }
    }

    // Breadth first: every vertex has a path to the boundary.
    std::vector<SurfacePoint> run() {
        std::size_t next = 0;
        while (next < placed_.size()) {
            const int from = placed_[next++];
            for (const int v : patch_.ring(from).vertices) {
                if (where_[v].triangle == none) place(v, best_walk(v));
            }
        }
        where_.resize(patch_.free_count);
        return std::move(where_);
    }

private:
    void place(int vertex, const SurfacePoint& where) {
        where_[vertex] = where;
        placed_.push_back(vertex);
    }

    [[nodiscard]] SurfacePoint best_walk(int vertex) const {
        SurfacePoint best;
        std::pair least{true, HUGE_VAL};
        Indices tried;
        for (const int neighbour : patch_.ring(vertex).vertices) {
            const int start = where_[neighbour].triangle;
            if (start == none || std::find(tried.begin(), tried.end(), start) != tried.end()) continue;
            tried.push_back(start);
            const SurfacePoint where = target_.project(surface_.col(vertex), start);
            const std::pair here = cost(vertex, where);
            if (here < least) {
                least = here;
                best = where;
            }
        }
        return best;
    }

    // The distance; places on another sheet, whose normal disagrees, come last.
    [[nodiscard]] std::pair<bool, double> cost(int vertex, const SurfacePoint& where) const {
        const bool agrees = normals_.col(vertex).dot(target_.normal(where)) > cos_of_widest_turn;
        return {!agrees, (target_.position(where) - surface_.col(vertex)).norm()};
    }

    const Patch& patch_;
    const Points& surface_;
    const TargetSurface& target_;
    const Points normals_;
    std::vector<SurfacePoint> where_;  // local vertices
    Indices placed_;                   // in their order
};

// V − E + F = 1 with the whole boundary as its only fixed vertices.
bool is_disc(const Patch& patch) {
    const std::vector<Indices> loops = patch.loops();
    const int fixed = patch.vertex_count() - patch.free_count;
    return loops.size() == 1 && static_cast<int>(loops.front().size()) == fixed &&
           patch.vertex_count() - patch.edge_count() + patch.triangle_count() == 1;
}

// The boundary on the unit circle, as far apart as its vertices are: 3 × fixed count, z = 0.
Points on_circle(const Problem& problem) {
    const Patch& patch = problem.patch;
    const Indices loop = patch.loops().front();
    const auto place = [&](std::size_t k) {
        return problem.fixed_points.col(loop[k % loop.size()] - patch.free_count);
    };
    VectorX reached(static_cast<Eigen::Index>(loop.size()) + 1);
    reached[0] = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        reached[column + 1] = reached[column] + (place(k + 1) - place(k)).norm();
    }
    Points circle = Points::Zero(3, problem.fixed_points.cols());
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const double angle =
            2.0 * std::numbers::pi * reached[static_cast<Eigen::Index>(k)] / reached[reached.size() - 1];
        circle.col(loop[k] - patch.free_count) << std::cos(angle), std::sin(angle), 0.0;
    }
    return circle;
}

Points upright(Eigen::Index count) { return Vector3(0.0, 0.0, 1.0).replicate(1, count); }

Points laid_out(const Patch& patch, const Points& circle) {
    Points result(3, patch.vertex_count());
    result << make_tangential_step(patch, uniform_weights(patch), circle, {})->harmonic_positions(), circle;
    return result;
}

}  // namespace

Placement by_history(const Problem& problem, const ProxyMesh& mesh, const ProxyMesh::Snapshot& snapshot,
                     const TargetSurface& target) {
    // Of every vertex that the proxy mesh ever had; known where the triangle is.
    Points points(3, mesh.number_count());
    std::vector<SurfacePoint> where(mesh.number_count(), SurfacePoint{none, Vector3::Zero()});
    const auto put_number = [&](int number, const SurfacePoint& place) {
        where[number] = place;
        points.col(number) = target.position(place);
    };
    for (int v = 0; v < snapshot.patch.vertex_count(); ++v) put_number(snapshot.patch.to_input[v], target.at_vertex(v));
    for (auto entry = mesh.removed().rbegin(); entry != mesh.removed().rend(); ++entry) {
        Vector3 mean = Vector3::Zero();
        for (int v : entry->ring) mean += points.col(v) / static_cast<double>(entry->ring.size());
        // Walk from the neighbour that is nearest to the mean.
        const int nearest = *std::min_element(entry->ring.begin(), entry->ring.end(), [&](int a, int b) {
            return (points.col(a) - mean).squaredNorm() < (points.col(b) - mean).squaredNorm();
        });
        put_number(entry->vertex, target.project(mean, where[nearest].triangle));
    }
    where.resize(problem.patch.free_count);
    return placed_at(problem, target, std::move(where));
}

Placement by_surface(const Problem& problem, const Points& surface, const Patch& proxy, const TargetSurface& target) {
    return placed_at(problem, target, Follower(problem, surface, proxy, target).run());
}

std::optional<Placement> by_disc(const Problem& problem, const Patch& proxy, const TargetSurface& target) {
    if (!is_disc(problem.patch) || !is_disc(proxy)) return std::nullopt;
    const Points circle = on_circle(problem);
    const Points surface = laid_out(proxy, circle);
    const Points normals = upright(surface.cols());
    const TargetSurface disc(proxy, surface, normals);
    const Problem flat{problem.patch, circle, upright(circle.cols()), uniform_weights(problem.patch), problem.options};
    return placed_at(problem, target, by_surface(flat, laid_out(problem.patch, circle), proxy, disc).where);
}

}  // namespace fairing
