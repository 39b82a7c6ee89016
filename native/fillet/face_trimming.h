// The parts of a plane face between chains of its edges and sections.
#pragma once

#include <variant>

#include "fillet/end_faces.h"

namespace fairing {

// What is left of a face without these, for sections in one plane; vertices where its edges are crossed have numbers
// from `next` on. Or the place among the sections of one that leaves the face.
std::variant<FaceChange, std::size_t> trimmed(const EndFaces& faces, const std::vector<EndSection*>& sections,
                                              int next);

}  // namespace fairing
