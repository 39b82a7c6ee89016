// The base of a faired patch and its surroundings, and a low-passed one for the band that fades out.
#pragma once

#include "api/input.h"
#include "base/progress.h"

namespace fairing {

struct FairedSurface {
    const MeshInput&
        mesh;  // the faired mesh with all its detail: patches, bands and their surroundings; free: what may move
    const Points& base;               // of the fair surfaces
    const std::vector<char>& faired;  // the vertices, among the free ones, that `base` belongs to
};

struct SoftBaseSizes {
    double detail = 0.0;    // share of the diameter, as in DetailOptions
    double diameter = 0.0;  // D of the faired part
    double width = 0.0;     // of the band
};

// 3 × vertices; where a vertex is fixed, and in patches without area, its place.
struct SoftBase {
    Points base;  // where faired the fair surface, elsewhere the low-pass surface (detail/skin)
    Points soft;  // `base` without waves shorter than two widths (D/2 at most): its join is round
};

// Throws what check_mesh throws, NO_BOUNDARY and Cancelled.
SoftBase soft_base(const FairedSurface& surface, const SoftBaseSizes& sizes, const ProgressCallback& callback);

}  // namespace fairing
