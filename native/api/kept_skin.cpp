#include "api/kept_skin.h"

#include <cmath>

#include "api/diagnose.h"
#include "base/stopwatch.h"
#include "detail/low_pass.h"
#include "geometry/surface_fit.h"

namespace fairing {

namespace {

// The places in `fixed` of the vertices that triangles outside touch.
Indices places_at_rim(std::span<const int> fixed, const Triangles& outside, Eigen::Index count) {
    std::vector<char> touched(static_cast<std::size_t>(count), 0);
    for (int v : outside.reshaped()) touched[at(v)] = 1;
    Indices places;
    for (std::size_t k = 0; k < fixed.size(); ++k) {
        if (touched[at(fixed[k])]) places.push_back(static_cast<int>(k));
    }
    return places;
}

// Whether normals (3 × k) at the rim are others than triangles outside show, detail included, at more than half of some
// vertices: then somebody chose them.
bool are_chosen(const Points& normals, const Indices& rim, const Points& positions, const Triangles& outside) {
    constexpr std::size_t most_samples = 12;
    constexpr double same = 2.0;  // standard errors
    constexpr double rounding = 1e-3;
    SurfaceFits fits(positions, outside, Centre::free);
    const std::size_t step = 1 + (rim.size() - 1) / most_samples;
    int agree = 0;
    for (std::size_t k = 0; k < rim.size(); k += step) {
        const auto fit = fits.at_vertex(rim[k]);
        if (!fit) continue;
        const double apart = (normals.col(static_cast<Eigen::Index>(k)) - fit->normal).norm();
        agree += apart <= same * fit->error + rounding ? 1 : -1;
    }
    return agree < 0;
}

}  // namespace

void KeptSkin::read(const ComponentData& data, double size, const Progress& progress) {
    const Points reference = gather(data.reference, patch_.to_input);
    if (skin_ && reference == read_off_) return;
    const Stopwatch watch;
    progress.here().report(0.0, "detail");
    warnings_.clear();
    skin_.reset();
    unit_ = normalise(reference.rightCols(reference.cols() - patch_.free_count));
    const Points old = unit_.to_unit(reference);
    if (old.allFinite() && !has_collapsed_fan(patch_, old)) {
        wavelength_ = size > 0.0 ? size : detail_wavelength(patch_, old);
        const Points outline = unit_.to_unit(low_pass_outline(data, data.reference).points);
        skin_ = Skin::read(patch_, {old, outline}, wavelength_, progress.here());
    }
    if (!skin_) warn_of_missing_detail(warnings_);
    read_off_ = reference;
    seconds_ = watch.seconds();
}

BaseOutline KeptSkin::low_pass_outline(const ComponentData& data, const Points& positions) const {
    const auto fixed = fixed_vertices(patch_);
    BaseOutline result{gather(positions, fixed), gather(data.normals, fixed)};
    const Indices places = places_at_rim(fixed, data.outside, positions.cols());
    if (places.empty() || !positions(Eigen::all, data.outside.reshaped()).allFinite()) return result;
    Indices rim;
    for (int k : places) rim.push_back(fixed[at(k)]);
    const double length = wavelength_ * normalise(result.points).diameter;
    const LowPass smooth = low_pass(positions, data.outside, rim, length);
    result.points(Eigen::all, places) = smooth.points;
    const bool keeps_normals =
        data.given_normals && are_chosen(result.normals(Eigen::all, places), rim, positions, data.outside);
    for (std::size_t k = 0; k < rim.size(); ++k) {
        if (!smooth.found[k]) continue;
        result.moved = true;
        auto normal = result.normals.col(places[k]);
        const Vector3 fitted = smooth.normals.col(static_cast<Eigen::Index>(k));
        if (keeps_normals || normal.isZero(0.0)) continue;
        normal = fitted.dot(normal) < 0.0 ? Vector3(-fitted) : fitted;  // the windings may differ
    }
    return result;
}

BaseOutline KeptSkin::outline(const ComponentData& data) const { return low_pass_outline(data, data.vertices); }

Dressed KeptSkin::put_back(const ComponentData& data, const Points& new_base) const {
    const int free = patch_.free_count;
    const auto fixed = fixed_vertices(patch_);
    const Points at_outline =
        gather(data.vertices, fixed) - new_base.rightCols(static_cast<Eigen::Index>(fixed.size()));
    Dressed result{new_base, Points::Zero(3, new_base.cols()), {}};
    VectorX weights = VectorX::Ones(new_base.cols());
    if (data.weights.size() > 0) {
        weights = data.weights(patch_.to_input);
        const Points old_base = skin_ ? unit_.from_unit(skin_->base()) : gather(data.vertices, patch_.to_input);
        result.base.leftCols(free) = (old_base + (new_base - old_base) * weights.asDiagonal()).leftCols(free);
    }
    if (!skin_) return result;
    Points all = Points::Zero(3, new_base.cols());
    all.leftCols(free) = unit_.diameter * skin_->detail_on(result.base, at_outline / unit_.diameter);
    all.rightCols(at_outline.cols()) = at_outline;
    result.turned_over = skin_->turned_over(result.base, result.base + all);
    result.detail.leftCols(free) = (all * weights.asDiagonal()).leftCols(free);
    result.base.leftCols(free) += all.leftCols(free) - result.detail.leftCols(free);
    return result;
}

}  // namespace fairing
