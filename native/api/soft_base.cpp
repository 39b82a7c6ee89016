#include "api/soft_base.h"

#include <algorithm>

#include "api/component.h"
#include "api/diagnose.h"
#include "detail/old_base.h"
#include "mesh/pieces.h"

namespace fairing {

namespace {

// What the rounding takes away repeats within less than this: longer waves of a limb stay.
double softened_length(const SoftBaseSizes& sizes, double detail) {
    constexpr double widths = 2.0;
    constexpr double most = 0.5;  // of D
    return std::max(detail, std::min(widths * sizes.width / sizes.diameter, most));
}

// One patch, in units of the diameter.
class SoftPatch {
public:
    SoftPatch(const Patch& patch, Points places, const Progress& progress)
        : patch_(patch), places_(std::move(places)), progress_(progress) {
        faces_.update(places_, patch.triangles);
        stiffness_.update(faces_, patch);
    }

    // Without what repeats within less than a wavelength; as it is where that can't be told.
    [[nodiscard]] Points without(const Points& points, double wavelength) const {
        const Points outline = points.rightCols(points.cols() - patch_.free_count);
        std::optional<Points> smooth = old_base(patch_, stiffness_, {points, outline}, wavelength, progress_);
        if (!smooth || !smooth->allFinite()) return points;
        return std::move(*smooth);
    }

private:
    const Patch& patch_;
    Points places_;
    const Progress& progress_;
    FaceGeometry faces_;
    Stiffness stiffness_;
};

void soften(const FairedSurface& surface, const Patch& patch, const SoftBaseSizes& sizes, const Progress& progress,
            SoftBase& result) {
    const Normalisation unit{gather(surface.mesh.vertices, patch.to_input).rowwise().mean(), sizes.diameter};
    const Points places = unit.to_unit(gather(surface.mesh.vertices, patch.to_input));
    if (!places.allFinite() || has_collapsed_fan(patch, places)) return;
    const double detail = sizes.detail > 0.0 ? sizes.detail : detail_wavelength(patch, places);
    const SoftPatch smooth(patch, places, progress);
    Points base = smooth.without(places, detail);
    base.rightCols(places.cols() - patch.free_count) = places.rightCols(places.cols() - patch.free_count);
    const Points fair = unit.to_unit(gather(surface.base, patch.to_input));
    for (int v = 0; v < patch.free_count; ++v) {
        if (surface.faired[at(patch.to_input[at(v)])]) base.col(v) = fair.col(v);
    }
    const Points soft = smooth.without(base, softened_length(sizes, detail));
    const auto free = free_vertices(patch);
    result.base(Eigen::all, free) = unit.from_unit(base).leftCols(patch.free_count);
    result.soft(Eigen::all, free) = unit.from_unit(soft).leftCols(patch.free_count);
}

}  // namespace

SoftBase soft_base(const FairedSurface& surface, const SoftBaseSizes& sizes, const ProgressCallback& callback) {
    const Progress progress(callback);
    const Checkpoints checkpoints(progress);
    const CheckedMesh mesh = check_mesh(surface.mesh);
    SoftBase result{surface.mesh.vertices, surface.mesh.vertices};
    for (const Patch& patch : make_patches(mesh.cut, mesh.roles)) soften(surface, patch, sizes, progress, result);
    return result;
}

}  // namespace fairing
