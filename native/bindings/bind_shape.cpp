#include "api/judged.h"
#include "api/shape.h"
#include "bindings/bind.h"
#include "bindings/topics.h"
#include "shape/limits.h"
#include "shape/visible_join.h"

namespace fairing::bindings {

namespace {

py::object shown(const VisibleJoin& join) { return py::make_tuple(join.degrees, join.limit, join.seen); }

py::object shown(const Faults& faults) { return py::make_tuple(faults.folded, faults.crossing); }

}  // namespace

void bind_shape(py::module_& module) {
    using namespace py::literals;
    bind(
        module, "visible_join",
        [](const Points& vertices, const Triangles& inside, const Triangles& outside, const Indices& boundary) {
            return visible_join({vertices, inside, outside}, boundary);
        },
        [](const VisibleJoin& join) { return shown(join); });
    bind(
        module, "judged",
        [](const ProgressCallback& progress, const Points& vertices, const Triangles& surface, const Triangles& others,
           const Indices& held, const Indices& rim, const MaybePoints& before, const Triangles& old,
           const Indices& moved, const VertexPairs& marked, bool is_clear) {
            std::optional<JudgedBefore> was;
            if (before) was = JudgedBefore{*before, old, moved, marked};
            return judged({vertices, surface, others, held, rim}, was, is_clear, progress);
        },
        [](const Judged& found) {
            return py::dict("join"_a = shown(found.join), "now"_a = shown(found.now),
                            "before"_a = found.before ? shown(*found.before) : py::none(), "pierced"_a = found.pierced,
                            "rounded"_a = found.rounded, "blunt"_a = found.blunt, "seams"_a = found.seams);
        });
    // The limits of shape/limits.h that Python uses.
    module.attr("LIMITS") = py::dict("waist"_a = waist, "balloon"_a = balloon, "visible_kink"_a = visible_kink,
                                     "kink_share"_a = kink_share, "off_slope"_a = off_slope);
    bind(
        module, "girth",
        [](const Points& vertices, const Triangles& triangles, const MaybeIndices& fixed) {
            return girth({vertices, triangles, fixed, {}});
        },
        [](const std::optional<GirthRange>& found) -> py::object {
            if (!found) return py::none();
            return py::make_tuple(found->least, found->largest, found->thinnest, found->thickest);
        });
}

}  // namespace fairing::bindings
