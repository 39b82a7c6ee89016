#include "base/errors.h"

namespace fairing {

std::string_view code_name(Code code) {
    switch (code) {
        case Code::nonfinite: return "NONFINITE";
        case Code::index_range: return "INDEX_RANGE";
        case Code::nonmanifold_edge: return "NONMANIFOLD_EDGE";
        case Code::nonmanifold_vertex: return "NONMANIFOLD_VERTEX";
        case Code::not_orientable: return "NOT_ORIENTABLE";
        case Code::no_boundary: return "NO_BOUNDARY";
        case Code::no_free_vertices: return "NO_FREE_VERTICES";
        case Code::degenerate_face: return "DEGENERATE_FACE";
        case Code::inconsistent_winding: return "INCONSISTENT_WINDING";
        case Code::open_border_in_selection: return "OPEN_BORDER_IN_SELECTION";
        case Code::normals_from_patch: return "NORMALS_FROM_PATCH";
        case Code::normals_oppose_winding: return "NORMALS_OPPOSE_WINDING";
        case Code::pin_normal_ignored: return "PIN_NORMAL_IGNORED";
        case Code::sharp_boundary: return "SHARP_BOUNDARY";
        case Code::flipped_triangles: return "FLIPPED_TRIANGLES";
        case Code::folded: return "FOLDED";
        case Code::self_intersection: return "SELF_INTERSECTION";
        case Code::reference_unusable: return "REFERENCE_UNUSABLE";
        case Code::not_converged: return "NOT_CONVERGED";
        case Code::precision: return "PRECISION";
    }
    return "UNKNOWN";
}

}  // namespace fairing
