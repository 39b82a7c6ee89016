// The detail of one component's old patch, kept between calls, and the boundary without detail that both bases meet.
#pragma once

#include "api/component.h"
#include "base/progress.h"
#include "detail/skin.h"
#include "fill/edge_lengths.h"

namespace fairing {

// Where a base meets its boundary: 3 × fixed vertices, in the caller's units.
struct BaseBoundary {
    Points points;
    Points normals;      // unit; zero at pins
    bool moved = false;  // whether it is low-passed
};

// A surface with detail: 3 × local vertices each, in the caller's units.
struct Dressed {
    Points base;
    Points detail;  // all of it; zero where nothing may change
    Indices turned_over;
};

// Refers to the patch.
class KeptSkin {
public:
    explicit KeptSkin(const Patch& patch) : patch_(patch) {}

    // Reads the skin off data.reference, unless it was read off the same one. `size`: of FairOptions. Throws Cancelled.
    void read(const ComponentData& data, double size, const Progress& progress);
    void forget() { skin_.reset(); }
    // False where no detail can be read off; warnings() has the reason.
    [[nodiscard]] bool found() const { return skin_ != nullptr; }
    [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }
    // Low-passed where triangles lie outside. The caller's normals are kept where they differ from those of the
    // triangles outside.
    [[nodiscard]] BaseBoundary boundary(const ComponentData& data);
    [[nodiscard]] const Points& base() const { return skin_->base(); }
    // The detail on a new base (3 × local vertices, in the caller's units).
    [[nodiscard]] Dressed put_back(const ComponentData& data, const Points& new_base) const;
    // Seconds spent on reading since the last call of this.
    [[nodiscard]] double take_seconds() { return std::exchange(seconds_, 0.0); }

private:
    [[nodiscard]] BaseBoundary low_pass_boundary(const ComponentData& data, const View<Points>& given) const;

    const Patch& patch_;
    std::unique_ptr<Skin> skin_;
    Points read_off_;                        // 3 × local vertices, the caller's
    std::optional<BaseBoundary> just_read_;  // data.reference's boundary, until `boundary` is asked for
    Normalisation unit_{};                   // of the boundary of read_off_
    double wavelength_ = 0.0;                // share of D
    double seconds_ = 0.0;
    Diagnostics warnings_;
};

// A component of the input with its normals, in units of D, for sizing new meshes. The arguments must outlive it.
struct OldSurface {
    OldSurface(const MeshInput& input, const CheckedMesh& mesh, const Patch& component);

    [[nodiscard]] VectorX lengths(const WantedLengths& wanted, const KeptEdges& kept = {}) const;

    const Patch& patch;
    Normalisation unit;
    Points points;
    Points normals;

private:
    void fit_at_creases(const std::vector<char>& free_slope);
};

// Patches with free and with fixed vertices. Throws NO_FREE_VERTICES where there are none.
std::vector<Patch> patches_with_vertices(const CheckedMesh& mesh);

}  // namespace fairing
