// The finished mesh, numbered as a patch is: free vertices first.
#include "fill/equal_edge_mesh.h"

namespace fairing {

bool EqualEdgeMesh::fixed_in_patch(Vertex v) const {
    return v.idx() < patch_->vertex_count() && !patch_->is_free(v.idx());
}

EqualEdgeMesh::Result EqualEdgeMesh::result() const {
    Result result;
    Indices number(mesh_.n_vertices(), none);
    for (const Vertex v : mesh_.vertices()) {
        if (fixed_in_patch(v)) continue;
        number[v.idx()] = static_cast<int>(result.where.size());
        result.where.push_back(where_[v.idx()]);
        result.old.push_back(fixed(v) ? v.idx() : none);
    }
    const int free_count = static_cast<int>(result.where.size());
    for (int v = patch_->free_count; v < patch_->vertex_count(); ++v) number[v] = free_count + v - patch_->free_count;
    result.points.resize(3, free_count);
    for (const Vertex v : mesh_.vertices()) {
        if (!fixed_in_patch(v)) result.points.col(number[v.idx()]) = point(v);
    }
    result.triangles = triangles_of(mesh_, number);
    return result;
}

}  // namespace fairing
