#include "paper/prolongation.h"

#include <Eigen/Geometry>

#include "fairness/row_weights.h"
#include "geometry/triangle.h"
#include "mesh/surface_mesh.h"
#include "paper/disk_curvature.h"

namespace fairing {

namespace {

constexpr int rounds = 2;            // of steps (2) and (3)
constexpr int curvature_sweeps = 3;  // of H in each round of step (3)

// Zero where the triangle is degenerate, as in FaceGeometry.
Vector3 unit_normal(const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 cross = area_vector(a, b, c);
    const double length = cross.norm();
    return length > 0.0 ? Vector3(cross / length) : Vector3(Vector3::Zero());
}

}  // namespace

// The half-edge mesh of the moment and the disks around the vertex inserted last.
class Prolongation::Neighbourhood {
public:
    Neighbourhood(const ProlongationSetting& setting, const Triangles& coarsest) : setting_(setting) {
        const int count = setting.patch.vertex_count();
        mesh_.reserve(count, 3 * count, 2 * count);
        for (int v = 0; v < count; ++v) mesh_.add_vertex(SurfaceMesh::Point::Zero());
        for (const auto corners : coarsest.colwise())
            mesh_.add_face(handle(corners[0]), handle(corners[1]), handle(corners[2]));
        slot_.assign(count, none);
        normals_.setZero(3, count);
        normals_.rightCols(setting.fixed_normals.cols()) = setting.fixed_normals;
        H_.setZero(count);
        arcs_.setZero(3, setting.patch.edge_count());
        arc_round_.assign(setting.patch.edge_count(), 0);
    }

    void insert(const Collapse& collapse, bool completed, Points& points) {
        mesh_.vertex_split(handle(collapse.removed), handle(collapse.kept), handle(collapse.left),
                           handle(collapse.right));
        gather(collapse.removed);
        points.col(collapse.removed) = weighted_mean(stored_[0], points);
        for (int sweep = 0; sweep < rounds; ++sweep) {
            for_each_movable([&](std::size_t k) { points.col(stored_[k].centre) = weighted_mean(stored_[k], points); });
        }
        for (int round = 0; round < rounds; ++round) make_fair(completed, points);
        for (std::size_t k = 0; k < stored_count_; ++k) slot_[stored_[k].centre] = none;
    }

private:
    struct StoredDisk {
        int centre;
        Indices neighbours;
        Indices rim;     // columns of arcs_
        Indices apexes;  // beyond the rim edges
        std::vector<double> lambda;
        std::vector<double> curvature_weights;
        std::vector<double> cotangents;  // cot α + cot β of the spokes
    };

    static SurfaceMesh::VertexHandle handle(int v) { return SurfaceMesh::VertexHandle(v); }

    template <typename Action>
    void for_each_movable(Action action) const {
        for (std::size_t k = 0; k < inner_count_; ++k) {
            if (setting_.patch.is_free(stored_[k].centre)) action(k);
        }
    }

    // The disks of the vertex and its neighbours (the inner ones, with weights), then of the neighbours of those.
    void gather(int vertex) {
        stored_count_ = 0;
        store(vertex);
        // By index: storing a disk may move the others. NOLINTBEGIN(modernize-loop-convert)
        for (std::size_t k = 0; k < stored_[0].neighbours.size(); ++k) store(stored_[0].neighbours[k]);
        inner_count_ = stored_count_;
        for (std::size_t k = 1; k < inner_count_; ++k) {
            for (std::size_t j = 0; j < stored_[k].neighbours.size(); ++j) store(stored_[k].neighbours[j]);
        }
        // NOLINTEND(modernize-loop-convert)
        for_each_movable([&](std::size_t k) { find_lambda(stored_[k]); });
    }

    void store(int vertex) {
        if (slot_[vertex] != none) return;
        slot_[vertex] = static_cast<int>(stored_count_);
        if (stored_count_ == stored_.size()) stored_.emplace_back();
        StoredDisk& disk = stored_[stored_count_++];
        disk.centre = vertex;
        disk.neighbours.clear();
        disk.rim.clear();
        disk.apexes.clear();
        walk(disk);
    }

    // As Patch does it: counter-clockwise, on the border from the first border edge to the last.
    void walk(StoredDisk& disk) const {
        const auto next_ccw = [&](SurfaceMesh::HalfedgeHandle h) {
            return mesh_.opposite_halfedge_handle(mesh_.prev_halfedge_handle(h));
        };
        SurfaceMesh::HalfedgeHandle first = mesh_.halfedge_handle(handle(disk.centre));
        if (mesh_.is_boundary(first)) first = next_ccw(first);
        SurfaceMesh::HalfedgeHandle h = first;
        do {
            disk.neighbours.push_back(mesh_.to_vertex_handle(h).idx());
            if (mesh_.is_boundary(h)) break;
            const auto rim = mesh_.next_halfedge_handle(h);
            const auto beyond = mesh_.opposite_halfedge_handle(rim);
            disk.rim.push_back(mesh_.edge_handle(rim).idx());
            disk.apexes.push_back(
                mesh_.is_boundary(beyond) ? none : mesh_.to_vertex_handle(mesh_.next_halfedge_handle(beyond)).idx());
            h = next_ccw(h);
        } while (h != first);
    }

    void find_lambda(StoredDisk& disk) {
        ring_.clear();
        for (int v : disk.neighbours) ring_.emplace_back(setting_.reference.col(v));
        ring_weights({setting_.reference.col(disk.centre), ring_, true}, setting_.inner_fairness, disk.lambda);
    }

    [[nodiscard]] static Vector3 weighted_mean(const StoredDisk& disk, const Points& points) {
        Vector3 sum = Vector3::Zero();
        for (std::size_t j = 0; j < disk.lambda.size(); ++j) sum += disk.lambda[j] * points.col(disk.neighbours[j]);
        return sum;
    }

    // Step (3): one update of the construction on the 1-disk, with H held on the vertices around it.
    void make_fair(bool completed, Points& points) {
        measure(completed, points);
        for (int sweep = 0; sweep < curvature_sweeps; ++sweep) {
            for_each_movable([&](std::size_t k) { relax_curvature(k); });
        }
        for_each_movable([&](std::size_t k) { move(stored_[k], completed, points); });
    }

    void move(const StoredDisk& stored, bool completed, Points& points) const {
        const VertexTarget target{normals_.col(stored.centre), stored.curvature_weights, weighted_mean(stored, points),
                                  H_[stored.centre], setting_.paper.damping};
        points.col(stored.centre) = updated_position(disk_of(stored, completed), {points, arcs_}, target);
    }

    [[nodiscard]] bool prescribed(int v) const {
        return setting_.solver.equation != Equation::soap_film && !setting_.patch.is_free(v) && !setting_.patch.pin[v];
    }

    [[nodiscard]] Disk disk_of(const StoredDisk& disk, bool completed) const {
        const bool full = completed || disk.neighbours.size() < 5 || !setting_.patch.is_free(disk.centre);
        return {disk.centre, {disk.neighbours, {}, disk.rim}, full};
    }

    void measure(bool completed, const Points& points) {
        for (std::size_t k = 0; k < stored_count_; ++k) {
            const int v = stored_[k].centre;
            if (!prescribed(v)) normals_.col(v) = disk_normal(disk_of(stored_[k], completed), points);
        }
        ++round_;
        for (std::size_t k = 0; k < stored_count_; ++k) {
            const Disk disk = disk_of(stored_[k], completed);
            if (disk.completed) measure_arcs(stored_[k], points);
            H_[disk.centre] = fit_(disk, {points, arcs_}, normals_.col(disk.centre)).mean();
            if (k >= inner_count_) continue;
            stored_[k].curvature_weights.resize(weight_count(disk));
            fit_.weights(stored_[k].curvature_weights);
        }
        if (setting_.solver.equation == Equation::soap_film) return;
        for_each_movable([&](std::size_t k) { measure_cotangents(stored_[k], points); });
    }

    void measure_arcs(const StoredDisk& disk, const Points& points) {
        const Vector3 centre = points.col(disk.centre);
        for (std::size_t k = 0; k < disk.rim.size(); ++k) {
            if (arc_round_[disk.rim[k]] == round_) continue;
            arc_round_[disk.rim[k]] = round_;
            const int a = disk.neighbours[k];
            const int b = disk.neighbours[k + 1 < disk.neighbours.size() ? k + 1 : 0];
            Vector3 triangle_normals = unit_normal(centre, points.col(a), points.col(b));
            if (disk.apexes[k] != none) {
                triangle_normals += unit_normal(points.col(b), points.col(a), points.col(disk.apexes[k]));
            }
            arcs_.col(disk.rim[k]) =
                arc_over({points.col(a), points.col(b), normals_.col(a), normals_.col(b), triangle_normals});
        }
    }

    static void measure_cotangents(StoredDisk& disk, const Points& points) {
        const std::size_t m = disk.neighbours.size();
        disk.cotangents.assign(m, 0.0);
        const Vector3 centre = points.col(disk.centre);
        for (std::size_t k = 0; k < m; ++k) {
            const std::size_t next = k + 1 < m ? k + 1 : 0;
            const Vector3 a = points.col(disk.neighbours[k]);
            const Vector3 b = points.col(disk.neighbours[next]);
            disk.cotangents[next] += cotangent(centre - a, b - a);
            disk.cotangents[k] += cotangent(centre - b, a - b);
        }
    }

    // The homogeneous equation: right-hand sides are left to the fairing of the whole level.
    void relax_curvature(std::size_t k) {
        const StoredDisk& disk = stored_[k];
        double sum = 0.0;
        double diagonal = 0.0;
        if (setting_.solver.equation != Equation::soap_film) {
            for (std::size_t j = 0; j < disk.cotangents.size(); ++j) {
                sum += disk.cotangents[j] * H_[disk.neighbours[j]];
                diagonal += disk.cotangents[j];
            }
        }
        H_[disk.centre] = diagonal > 0.0 ? sum / diagonal : 0.0;
    }

    ProlongationSetting setting_;
    SurfaceMesh mesh_;
    Points normals_;
    VectorX H_;
    DiskFit fit_;
    Points arcs_;                 // a column for each edge of the finest mesh
    std::vector<int> arc_round_;  // the round of measurement in which a column was written
    int round_ = 0;
    std::vector<StoredDisk> stored_;  // reused from vertex to vertex
    std::size_t stored_count_ = 0;
    std::size_t inner_count_ = 0;
    Indices slot_;  // vertex → place in stored_
    std::vector<Vector3> ring_;
};

namespace {

// The coarsest connectivity in the patch's own vertices.
Triangles coarsest_triangles(const Hierarchy& hierarchy, const Patch& patch) {
    if (hierarchy.patches.empty()) return patch.triangles;
    const Patch& coarsest = hierarchy.patches.front();
    return coarsest.triangles.unaryExpr([&](int v) { return coarsest.to_input[v]; });
}

}  // namespace

Prolongation::Prolongation(const Hierarchy& hierarchy, const ProlongationSetting& setting)
    : hierarchy_(hierarchy),
      neighbourhood_(std::make_unique<Neighbourhood>(setting, coarsest_triangles(hierarchy, setting.patch))),
      collapsed_(hierarchy.collapsed.front()),
      paper_(setting.paper) {}

Prolongation::~Prolongation() = default;

void Prolongation::refine(int level, Points& points, const Progress& progress) {
    const std::size_t target = hierarchy_.collapsed[level];
    const bool completed = paper_.virtual_points == VirtualPoints::everywhere ||
                           (paper_.virtual_points == VirtualPoints::coarse && !hierarchy_.is_finest(level));
    const auto total = static_cast<double>(collapsed_ - target);
    for (std::size_t done = 0; collapsed_ > target; ++done) {
        if (done % 256 == 0) progress.report(static_cast<double>(done) / total, "prolongation");
        neighbourhood_->insert(hierarchy_.collapses[--collapsed_], completed, points);
    }
}

}  // namespace fairing
