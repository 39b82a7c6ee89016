#include "paper/collapse_legality.h"

namespace fairing {

bool keeps_topology(const DecimationInfo& info) {
    const SurfaceMesh& mesh = info.mesh;
    if (mesh.status(info.v0).locked() || mesh.status(info.v0v1).deleted()) return false;
    if (info.vl == info.vr || !info.vl.is_valid() || !info.vr.is_valid()) return false;
    for (const auto a : mesh.vv_range(info.v0)) {
        if (a == info.v1 || a == info.vl || a == info.vr) continue;
        for (const auto b : mesh.vv_range(info.v1)) {
            if (a == b) return false;
        }
    }
    return true;
}

}  // namespace fairing
