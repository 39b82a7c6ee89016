#include "operators/outline_coupling.h"

namespace fairing {

OutlineCoupling::OutlineCoupling(const Patch& patch)
    : free_count_(patch.free_count), fixed_count_(patch.vertex_count() - patch.free_count) {
    for (int j = patch.free_count; j < patch.vertex_count(); ++j) {
        const RingView ring = patch.ring(j);
        for (std::size_t k = 0; k < ring.valence(); ++k) {
            if (patch.is_free(ring.vertices[k]))
                entries_.push_back({ring.vertices[k], j - patch.free_count, ring.spokes[k], 0.0});
        }
    }
}

void OutlineCoupling::update(const Stiffness& stiffness) {
    for (Entry& entry : entries_) entry.weight = stiffness.weights[entry.edge];
}

VectorX OutlineCoupling::spread(const OutlineRow& outline) const {
    VectorX field = VectorX::Zero(free_count_);
    for (const Entry& entry : entries_) field[entry.i] -= entry.weight * outline[entry.j];
    return field;
}

OutlineRow OutlineCoupling::gather(const VectorX& field) const {
    OutlineRow outline = OutlineRow::Zero(fixed_count_);
    for (const Entry& entry : entries_) outline[entry.j] -= entry.weight * field[entry.i];
    return outline;
}

Indices OutlineCoupling::beside() const {
    Indices vertices;
    for (const Entry& entry : entries_) vertices.push_back(entry.i);
    return vertices;
}

}  // namespace fairing
