#include "api/held_inside.h"

#include <string>

#include "base/errors.h"

namespace fairing {

std::vector<char> marks_of(const MeshInput& input, const Indices& vertices, const char* name) {
    const auto count = static_cast<int>(input.vertices.cols());
    std::vector<char> marks(count, 0);
    for (int v : vertices) {
        if (v < 0 || v >= count) {
            throw MeshError({Code::index_range,
                             std::string(name) + " names vertex " + std::to_string(v) + ", outside 0 … " +
                                 std::to_string(count - 1),
                             {v},
                             ElementKind::vertex,
                             {{"vertex", v}, {"vertices", count}}});
        }
        marks[v] = 1;
    }
    return marks;
}

void check_slopes(const GivenRoles& given, const VertexRoles& roles) {
    for (std::size_t v = 0; v < given.fixed.size(); ++v) {
        if (!given.crease[v] && !given.smooth[v]) continue;
        const std::string name = given.crease[v] ? "creases" : "smooth_curves";
        if (roles.used[v] && !roles.fixed[v])
            throw std::invalid_argument(name + " names vertex " + std::to_string(v) + ", which is not fixed");
        if (given.crease[v] && given.smooth[v])
            throw std::invalid_argument("vertex " + std::to_string(v) + " is named by creases and by smooth_curves");
    }
}

}  // namespace fairing
