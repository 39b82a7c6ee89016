#include "api/old_surface.h"

#include "base/errors.h"
#include "boundary/surrounding_fit.h"
#include "mesh/pieces.h"

namespace fairing {

OldSurface::OldSurface(const MeshInput& input, const CheckedMesh& mesh, const Patch& component)
    : patch(component),
      unit(normalise(gather(input.vertices, fixed_vertices(component)))),
      points(unit.to_unit(gather(input.vertices, component.to_input))) {
    FaceGeometry faces;
    faces.update(points, patch.triangles);
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
    return edge_lengths(patch, points, {wanted.spacing / unit.diameter, wanted.least_count, wanted.spread}, kept);
}

std::vector<Patch> patches_with_vertices(const CheckedMesh& mesh) {
    std::vector<Patch> patches = make_patches(mesh.cut, mesh.roles);
    std::erase_if(patches, [](const Patch& patch) { return patch.free_count == patch.vertex_count(); });
    if (!patches.empty()) return patches;
    throw MeshError({Code::no_free_vertices, "there is no vertex that may move, or none that holds them", {}, {}, {}});
}

}  // namespace fairing
