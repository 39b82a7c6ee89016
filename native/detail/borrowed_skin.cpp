#include "detail/borrowed_skin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/direction.h"
#include "detail/copied_heights.h"
#include "geometry/face_geometry.h"

namespace fairing {

namespace {

constexpr double disc_of_depth = 0.5;     // radius of a disc, of the greatest depth of the sample
constexpr double least_edges = 2.5;       // in the radius of a disc
constexpr double edge_effects = 0.25;     // wavelengths from the edge of a sample where it is not measured
constexpr double most_gain = 3.0;         // of a band: what a mesh can't carry is not forced on it
constexpr int passes = 6;                 // the bands overlap
constexpr double meeting_length = 0.125;  // wavelengths within which the detail turns into that of the outline

double root_mean_square(const Eigen::Ref<const VectorX>& values) {
    return values.size() > 0 ? std::sqrt(values.squaredNorm() / static_cast<double>(values.size())) : 0.0;
}

// What `at_fixed` (3 × k) fades to inside (3 × free count): (M + l² S/2) e = 0.
std::optional<Points> faded(const Patch& patch, const Points& base, const Points& at_fixed, double length,
                            const Progress& progress) {
    const SparseMatrix matrix = screened_laplacian(base, patch.triangles, length * length);
    const SparseMatrix inner = matrix.topLeftCorner(patch.free_count, patch.free_count);
    const SparseMatrix coupling = matrix.topRightCorner(patch.free_count, at_fixed.cols());
    SparseCholesky factor(base.leftCols(patch.free_count));
    if (!factor.factorise(inner.triangularView<Eigen::Lower>(), "detail", progress)) return std::nullopt;
    const Eigen::MatrixXd pulls = -(coupling * at_fixed.transpose());
    return Points(factor.solve(pulls).transpose());
}

}  // namespace

std::unique_ptr<BorrowedSkin> BorrowedSkin::of(SkinSample sample, double wavelength, const Progress& progress) {
    std::unique_ptr<BorrowedSkin> skin(new BorrowedSkin(std::move(sample), wavelength));
    if (skin->reach() < least_edges * skin->sample_.edge) {
        throw std::invalid_argument("detail_from: the sample is too narrow: its middle must lie " +
                                    std::to_string(static_cast<int>(std::ceil(least_edges / disc_of_depth))) +
                                    " edges from its border at least");
    }
    return skin->measure(progress) ? std::move(skin) : nullptr;
}

double BorrowedSkin::reach() const { return std::min(wavelength_, disc_of_depth * sample_.depth.maxCoeff()); }

std::vector<double> BorrowedSkin::band_ends() const { return {0.25 * wavelength_, 0.5 * wavelength_, wavelength_}; }

bool BorrowedSkin::measure(const Progress& progress) {
    const auto bands = Bands::of(sample_.base, sample_.triangles, band_ends(), progress);
    if (!bands) return false;
    const double depth = std::min(edge_effects * wavelength_, disc_of_depth * sample_.depth.maxCoeff());
    Indices deep;
    for (int v = 0; v < static_cast<int>(sample_.depth.size()); ++v) {
        if (sample_.depth[v] >= depth) deep.push_back(v);
    }
    const Eigen::MatrixXd parts = bands->split(sample_.heights)(deep, Eigen::all);
    heights_in_bands_.resize(parts.cols());
    for (Eigen::Index k = 0; k < parts.cols(); ++k) heights_in_bands_[k] = root_mean_square(parts.col(k));
    return true;
}

void BorrowedSkin::match(const Bands& bands, int free_count, VectorX& heights) const {
    for (int pass = 0; pass < passes; ++pass) {
        const Eigen::MatrixXd parts = bands.split(heights);
        heights.setZero();
        for (Eigen::Index k = 0; k < parts.cols(); ++k) {
            const double there = root_mean_square(parts.col(k).head(free_count));
            const double gain = there > 0.0 ? std::min(heights_in_bands_[k] / there, most_gain) : 1.0;
            heights += gain * parts.col(k);
        }
    }
}

std::optional<Points> BorrowedSkin::detail_on(const Patch& patch, const Points& base, const Points& at_outline,
                                              const Progress& progress) const {
    Points normals = summed_normals(base, patch.triangles);
    for (auto normal : normals.colwise()) normal = direction(normal);
    VectorX known = VectorX::Constant(base.cols(), std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index k = 0; k < at_outline.cols(); ++k) {
        const Eigen::Index v = patch.free_count + k;
        if (!at_outline.col(k).isZero(0.0)) known[v] = at_outline.col(k).dot(normals.col(v));
    }
    const auto bands = Bands::of(base, patch.triangles, band_ends(), progress);
    if (!bands) return std::nullopt;
    VectorX heights = copied_heights({base, normals, patch.triangles, known}, sample_, reach());
    match(*bands, patch.free_count, heights);
    const Points copied = normals * heights.asDiagonal();
    const Points gap = at_outline - copied.rightCols(at_outline.cols());
    const auto closing = faded(patch, base, gap, meeting_length * wavelength_, progress);
    if (!closing) return std::nullopt;
    return Points(copied.leftCols(patch.free_count) + *closing);
}

}  // namespace fairing
