// C = S_IB: the part of the Laplace–Beltrami matrix between free and fixed vertices.
#pragma once

#include "geometry/face_geometry.h"

namespace fairing {

// A value for each fixed vertex, counted from the first one.
using OutlineRow = Eigen::RowVectorXd;

class OutlineCoupling {
public:
    explicit OutlineCoupling(const Patch& patch);

    void update(const Stiffness& stiffness);

    // C b, a value for each free vertex.
    [[nodiscard]] VectorX spread(const OutlineRow& outline) const;
    // Cᵀ a of a value for each free vertex.
    [[nodiscard]] OutlineRow gather(const VectorX& field) const;
    // Free vertices beside the boundary, with repetitions.
    [[nodiscard]] Indices beside() const;

private:
    // C_ij = −w of an edge.
    struct Entry {
        int i;  // free
        int j;  // fixed, counted from the first one
        int edge;
        double weight;  // w
    };

    int free_count_;
    int fixed_count_;
    std::vector<Entry> entries_;
};

}  // namespace fairing
