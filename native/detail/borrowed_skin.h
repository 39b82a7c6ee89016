// The skin of another place, for a surface that has none of its own.
#pragma once

#include <memory>

#include "base/progress.h"
#include "detail/bands.h"
#include "detail/skin_sample.h"

namespace fairing {

// Heights copied from a sample, with the sample's root mean square in each band of wavelengths.
class BorrowedSkin {
public:
    // `wavelength`: below which the sample's heights are. Null where its triangles have no area. Throws
    // std::invalid_argument where it is too narrow to cut discs out of it; Cancelled.
    static std::unique_ptr<BorrowedSkin> of(SkinSample sample, double wavelength, const Progress& progress);

    // The detail at the free vertices of a new base (3 × local vertices), in the sample's unit. At the fixed ones it is
    // `at_outline` (3 × k), towards which it turns within a few edges; where that is zero, nothing is known there.
    // Nothing where the base has degenerated. Throws Cancelled.
    [[nodiscard]] std::optional<Points> detail_on(const Patch& patch, const Points& base, const Points& at_outline,
                                                  const Progress& progress) const;

private:
    BorrowedSkin(SkinSample sample, double wavelength) : sample_(std::move(sample)), wavelength_(wavelength) {}
    [[nodiscard]] std::vector<double> band_ends() const;
    [[nodiscard]] double reach() const;
    [[nodiscard]] bool measure(const Progress& progress);
    void match(const Bands& bands, int free_count, VectorX& heights) const;

    SkinSample sample_;
    double wavelength_;
    VectorX heights_in_bands_;  // root mean squares
};

}  // namespace fairing
