#include "api/kept_skin.h"

#include "api/diagnose.h"
#include "base/columns.h"
#include "base/errors.h"
#include "base/stopwatch.h"
#include "boundary/boundary_fit.h"
#include "boundary/surrounding_fit.h"
#include "detail/low_pass.h"
#include "geometry/hard_edges.h"
#include "mesh/pieces.h"

namespace fairing {

namespace {

// The places in `fixed` of the vertices that triangles outside touch.
Indices places_at_rim(std::span<const int> fixed, const Triangles& outside, Eigen::Index count) {
    std::vector<char> touched(static_cast<std::size_t>(count), 0);
    for (int v : outside.reshaped()) touched[v] = 1;
    Indices places;
    for (std::size_t k = 0; k < fixed.size(); ++k) {
        if (touched[fixed[k]]) places.push_back(static_cast<int>(k));
    }
    return places;
}

// Whether normals (3 × k) at the rim are others than triangles outside show, detail included, at more than half of some
// vertices: then somebody chose them.
bool are_chosen(const Points& normals, const Indices& rim, SidedFits& outside) {
    constexpr std::size_t most_samples = 12;  // vertices of the rim
    constexpr double same = 2.0;              // standard errors
    constexpr double rounding = 1e-3;         // radians: an exact fit has no error to compare with
    const std::size_t step = 1 + (rim.size() - 1) / most_samples;
    int agree = 0;
    for (std::size_t k = 0; k < rim.size(); k += step) {
        const auto fit = outside.at_vertex(rim[k]);
        if (!fit) continue;
        const double apart = (normals.col(static_cast<Eigen::Index>(k)) - fit->normal).norm();
        agree += apart <= same * fit->error + rounding ? 1 : -1;
    }
    return agree < 0;
}

// Whether a normal given is that of another side of a hard edge than the triangles outside, whose winding may differ:
// these say nothing about the patch there.
bool is_other_side(const Vector3& given, const std::optional<SlopeFit>& outside) {
    constexpr double most_error = 0.04;  // radians: with noise of .1 edges slopes are known to .03
    const double least = std::cos(hard_bend * std::numbers::pi / 180.0);
    return outside && outside->error <= most_error && !given.isZero(0.0) &&
           std::abs(direction(given).dot(outside->normal)) < least;
}

}  // namespace

void KeptSkin::read(const ComponentData& data, double size, const Progress& progress) {
    const Stopwatch watch;
    just_read_.reset();
    const Points reference = gather(data.reference, patch_.to_input);
    if (skin_ && reference == read_off_) return;
    progress.here().report(0.0, "detail");
    warnings_.clear();
    skin_.reset();
    unit_ = normalise(reference.rightCols(reference.cols() - patch_.free_count));
    const Points old = unit_.to_unit(reference);
    if (old.allFinite() && !has_collapsed_fan(patch_, old)) {
        wavelength_ = size > 0.0 ? size : detail_wavelength(patch_, old);
        just_read_ = low_pass_boundary(data, data.reference);
        skin_ = Skin::read(patch_, {old, unit_.to_unit(just_read_->points)}, wavelength_, progress.here());
    }
    if (!skin_) warn_of_missing_detail(warnings_);
    read_off_ = reference;
    seconds_ += watch.seconds();
}

BaseBoundary KeptSkin::low_pass_boundary(const ComponentData& data, const View<Points>& given) const {
    const auto fixed = fixed_vertices(patch_);
    const Points positions = given;
    BaseBoundary result{gather(positions, fixed), data.normals.gather(fixed)};
    Indices places = places_at_rim(fixed, data.outside, positions.cols());
    if (places.empty() || !positions(Eigen::all, data.outside.reshaped()).allFinite()) return result;
    Indices rim;
    for (int k : places) rim.push_back(fixed[k]);
    bool keeps_normals = false;
    if (data.given_normals) {
        SidedFits fits(positions, data.outside, rim, {});
        keeps_normals = are_chosen(result.normals(Eigen::all, places), rim, fits);
        std::erase_if(places, [&](int k) { return is_other_side(result.normals.col(k), fits.at_vertex(fixed[k])); });
        rim.clear();
        for (int k : places) rim.push_back(fixed[k]);
    }
    const double length = wavelength_ * normalise(result.points).diameter;
    const LowPass smooth = low_pass(positions, data.outside, rim, length);
    result.points(Eigen::all, places) = smooth.points;
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

BaseBoundary KeptSkin::boundary(const ComponentData& data) {
    const std::optional<BaseBoundary> read = std::exchange(just_read_, std::nullopt);
    return read && data.reference == data.vertices ? *read : low_pass_boundary(data, data.vertices);
}

Dressed KeptSkin::put_back(const ComponentData& data, const Points& new_base) const {
    const int free = patch_.free_count;
    const auto fixed = fixed_vertices(patch_);
    const Points at_boundary =
        gather(data.vertices, fixed) - new_base.rightCols(static_cast<Eigen::Index>(fixed.size()));
    Dressed result{new_base, Points::Zero(3, new_base.cols()), {}};
    result.detail.leftCols(free) = unit_.diameter * skin_->detail_on(new_base, at_boundary / unit_.diameter);
    Points shown = new_base + result.detail;
    shown.rightCols(at_boundary.cols()) += at_boundary;
    result.turned_over = skin_->turned_over(new_base, shown);
    return result;
}

OldSurface::OldSurface(const MeshInput& input, const CheckedMesh& mesh, const Patch& component)
    : patch(component),
      unit(normalise(gather(input.vertices, fixed_vertices(component)))),
      points(unit.to_unit(gather(input.vertices, component.to_input))) {
    FaceGeometry faces(points, patch.triangles);
    normals = vertex_normals(patch, points, faces, mesh.normals.gather(fixed_vertices(patch)), NormalKind::fitted);
    fit_at_creases(mesh.roles.free_slope);
}

// At creases the normals are those of the patch's own side.
void OldSurface::fit_at_creases(const std::vector<char>& free_slope) {
    Indices creases;
    for (int v = 0; v < patch.vertex_count(); ++v) {
        if (free_slope[patch.to_input[v]]) creases.push_back(v);
    }
    if (!creases.empty()) normals(Eigen::all, creases) = surrounding_normals(points, patch.triangles, creases).normals;
}

VectorX OldSurface::lengths(const WantedLengths& wanted, const KeptEdges& kept) const {
    WantedLengths own{wanted.spacing / unit.diameter, wanted.least_count, wanted.spread};
    if (wanted.each.size() > 0) own.each = wanted.each(patch.to_input) / unit.diameter;
    return edge_lengths(patch, points, own, kept);
}

std::vector<Patch> patches_with_vertices(const CheckedMesh& mesh) {
    std::vector<Patch> patches = make_patches(mesh.cut, mesh.roles);
    std::erase_if(patches, [](const Patch& patch) { return patch.free_count == patch.vertex_count(); });
    if (!patches.empty()) return patches;
    throw MeshError({Code::no_free_vertices, "no vertex may move, or no vertex is held: check `fixed`", {}, {}, {}});
}

}  // namespace fairing
