// The rules by which OpenMesh's decimater chooses half-edge collapses (paper §7.4), and the record of what it did.
#pragma once

// clang-format off
#include "paper/collapse_legality.h"
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
// clang-format on

#include "paper/collapse_fan.h"
#include "paper/hierarchy.h"

namespace fairing {

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
    [[nodiscard]] static bool joins_fixed(const CollapseInfo& info);
    void look_at(const CollapseInfo& info);

    CollapseFan fan_;  // kept while the half-edges of its vertex are tried one after the other
    int fan_vertex_ = none;
    std::size_t fan_made_ = 0;  // collapses at the time
    std::vector<std::size_t> counts_;
    std::vector<NotedLevel> levels_;
    std::vector<Collapse> collapses_;
};

}  // namespace fairing
