// Fields between a level and the next coarser one.
#pragma once

#include "multigrid/collapse_mesh.h"

namespace fairing {

// A field of `Rows` values at each vertex of a level, fixed ones included (where corrections are zero).
template <int Rows>
using Field = Eigen::Matrix<double, Rows, Eigen::Dynamic>;

struct Transfer {
    int fine_count = 0;         // vertices of the fine level
    int coarse_free_count = 0;  // of the coarse level, which come first
    Indices coarse_in_fine;     // coarse vertex → fine vertex
    Removals removals;          // free vertices, in fine numbers, in the order of their removal

    // Interpolation: removed vertices take the weighted mean of what was around them.
    template <int Rows>
    [[nodiscard]] Field<Rows> prolong(const Field<Rows>& coarse) const {
        Field<Rows> fine = Field<Rows>::Zero(Rows, fine_count);
        for (Eigen::Index c = 0; c < coarse.cols(); ++c) fine.col(coarse_in_fine[std::size_t(c)]) = coarse.col(c);
        for (int k = removals.size(); k-- > 0;) {
            Eigen::Matrix<double, Rows, 1> sum = Eigen::Matrix<double, Rows, 1>::Zero();
            for (int j = removals.begin[at(k)]; j < removals.begin[at(k) + 1]; ++j)
                sum += removals.weights[at(j)] * fine.col(removals.neighbours[at(j)]);
            fine.col(removals.vertex[at(k)]) = sum;
        }
        return fine;
    }

    // Its transpose; nothing arrives at fixed vertices.
    template <int Rows>
    [[nodiscard]] Field<Rows> restrict(Field<Rows> fine) const {
        for (int k = 0; k < removals.size(); ++k) {
            const Eigen::Matrix<double, Rows, 1> value = fine.col(removals.vertex[at(k)]);
            for (int j = removals.begin[at(k)]; j < removals.begin[at(k) + 1]; ++j)
                fine.col(removals.neighbours[at(j)]) += removals.weights[at(j)] * value;
        }
        Field<Rows> coarse(Rows, static_cast<Eigen::Index>(coarse_in_fine.size()));
        for (int c = 0; c < coarse_free_count; ++c) coarse.col(c) = fine.col(coarse_in_fine[at(c)]);
        coarse.rightCols(coarse.cols() - coarse_free_count).setZero();
        return coarse;
    }

    // Positions and normals (3 × vertices): means lifted as in `lifted_mean`. `fine` comes with the fixed vertices.
    void prolong_surface(const Points& coarse, const Points& coarse_normals, int fine_free_count, Points& fine,
                         Points& fine_normals) const;
};

// The weighted mean of points, lifted half-way to their tangent planes, which is exact on parabolas.
Vector3 lifted_mean(const Points& points, const Points& normals, const int* vertices, const double* weights, int count);

}  // namespace fairing
