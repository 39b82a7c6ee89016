// The rules by which OpenMesh's decimater chooses half-edge collapses (paper §7.4), and the record of what it did.
#pragma once

// clang-format off
#include "mesh/surface_mesh.h"
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
// clang-format on

#include "paper/hierarchy.h"

namespace fairing {

using DecimationInfo = OpenMesh::Decimater::CollapseInfoT<SurfaceMesh>;

// Whether the half-edge collapse removes a free vertex (one that is not locked) and keeps the topology: the ends of the
// edge have no common neighbours but the two vertices opposite to it.
bool keeps_topology(const DecimationInfo& info);

}  // namespace fairing

// The framework's own test asks the library several times for each neighbour: half of the whole time. Only vertices
// with triangles all round are removed here, for which the link condition is enough.
template <>
inline bool OpenMesh::Decimater::BaseDecimaterT<fairing::SurfaceMesh>::is_collapse_legal(const CollapseInfo& info) {
    return fairing::keeps_topology(info);
}

// Observers live in a library of their own, which nothing else here needs; no observer is ever set.
template <>
inline bool OpenMesh::Decimater::BaseDecimaterT<fairing::SurfaceMesh>::notify_observer(size_t) {
    return true;
}

namespace fairing {

// Priority: the length of the edge, so that the shortest goes first, weighted by the shape of the new triangles.
class CollapseModule : public OpenMesh::Decimater::ModBaseT<SurfaceMesh> {
public:
    using Base = OpenMesh::Decimater::ModBaseT<SurfaceMesh>;
    using Handle = OpenMesh::Decimater::ModHandleT<CollapseModule>;
    using Mesh = SurfaceMesh;
    using CollapseInfo = Base::CollapseInfo;
    [[nodiscard]] const std::string& name() const override {
        static const std::string text = "FairingCollapse";
        return text;
    }

    explicit CollapseModule(SurfaceMesh& mesh) : Base(mesh, false) {}

    // Levels are noted when so many collapses have been made (ascending).
    void note_at(std::vector<std::size_t> counts) { counts_ = std::move(counts); }

    float collapse_priority(const CollapseInfo& info) override;
    void preprocess_collapse(const CollapseInfo& info) override;

    // Notes the present mesh, whatever its count.
    void note_level();

    struct NotedLevel {
        std::size_t collapsed;
        Triangles triangles;
    };
    [[nodiscard]] const std::vector<NotedLevel>& levels() const { return levels_; }
    [[nodiscard]] std::vector<Collapse> take_collapses() { return std::move(collapses_); }

private:
    // The triangles around a vertex as they are; kept while its half-edges are tried one after the other.
    struct Fan {
        int vertex = none;
        std::size_t made = 0;  // collapses at the time
        double worst = 1.0;    // roundness
        double best_priority = 0.0;
        std::vector<Vector3> points;      // of the neighbours, all round
        std::vector<double> rim;          // length of the edge from neighbour k to k + 1
        std::vector<Vector3> normals;     // unit, of the triangle at that edge
        std::vector<double> from_target;  // distances of the neighbours from the one that is tried
    };

    [[nodiscard]] static bool joins_fixed(const CollapseInfo& info);
    void look_at(const CollapseInfo& info);
    // Roundness of the worst new triangle; negative where one is turned over, where the collapse is vetoed, or where it
    // can't be better than the vertex's best one so far.
    [[nodiscard]] double worst_after(const Vector3& target, double length);

    Fan fan_;
    std::vector<std::size_t> counts_;
    std::vector<NotedLevel> levels_;
    std::vector<Collapse> collapses_;
};

}  // namespace fairing
