#include "api/soft_base.h"

#include "api/component.h"
#include "api/diagnose.h"
#include "detail/skin.h"
#include "mesh/pieces.h"

namespace fairing {

namespace {

// What the rounding takes away repeats within less than this: longer waves of a limb stay.
double softened_length(const SoftBaseSizes& sizes, double detail) {
    constexpr double widths = 2.0;  // of the rounded band
    constexpr double most = 0.5;    // of D
    return std::max(detail, std::min(widths * sizes.width / sizes.diameter, most));
}

// As it is where that is not known.
Points without(BaseFilter& filter, const Points& surface, double wavelength, const Progress& progress) {
    std::optional<Points> smooth = filter.without(surface, wavelength, progress);
    if (!smooth || !smooth->allFinite()) return surface;
    return std::move(*smooth);
}

void soften(const FairedSurface& surface, const Patch& patch, const SoftBaseSizes& sizes, const Progress& progress,
            SoftBase& result) {
    const Normalisation unit{gather(surface.mesh.vertices, patch.to_input).rowwise().mean(), sizes.diameter};
    const Points places = unit.to_unit(gather(surface.mesh.vertices, patch.to_input));
    if (!places.allFinite() || has_collapsed_fan(patch, places)) return;
    const double detail = sizes.detail > 0.0 ? sizes.detail : detail_wavelength(patch, places);
    const Stiffness stiffness(patch, places);
    BaseFilter filter(patch, stiffness, {places, places.rightCols(places.cols() - patch.free_count)}, detail);
    Points base = without(filter, places, detail, progress);
    const Points fair = unit.to_unit(gather(surface.base, patch.to_input));
    for (int v = 0; v < patch.free_count; ++v) {
        if (surface.faired[patch.to_input[v]]) base.col(v) = fair.col(v);
    }
    const Points soft = without(filter, base, softened_length(sizes, detail), progress);
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
