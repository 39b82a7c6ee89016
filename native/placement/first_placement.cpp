#include "placement/first_placement.h"

#include "geometry/limits.h"
#include "geometry/vertex_normal.h"

namespace fairing {

namespace {

// Walks from the places of neighbours that are projected already.
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

}  // namespace

Placement by_history(const Problem& problem, const ProxyMesh& mesh, const ProxyMesh::Snapshot& snapshot,
                     const TargetSurface& target) {
    // For every vertex that the proxy mesh ever had; known where the triangle is.
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

}  // namespace fairing
